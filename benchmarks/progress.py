"""How long a solve goes without asking whether to stop, and how evenly its progress moves, as Markdown.

python benchmarks/progress.py            # hemispheres of 10k, 100k and 256k free vertices
python benchmarks/progress.py 1000000    # that many; 6 GB of memory, and some minutes for the mesh
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

import numpy as np

import fairing
import shapes

SIZES = (10_000, 100_000, 256_000)


def row(n_free: int) -> str:
    """One solve: seconds, the largest gap between two calls of the callback, the largest lag of the fraction."""
    patch = shapes.cap(n_free)
    start = shapes.start_from_nothing(patch, "point")
    asked: list[tuple[float, float]] = []

    def progress(fraction: float, stage: str) -> bool:
        asked.append((time.perf_counter(), fraction))
        return True

    begin = time.perf_counter()
    fairing.fair(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, progress=progress)
    end = time.perf_counter()
    times = (np.array([begin, *(when for when, _ in asked), end]) - begin) / (end - begin)
    fractions = np.array([0.0, *(fraction for _, fraction in asked)])
    lag = np.abs(fractions - times[1:]).max()
    return f"| {len(patch.free)} | {end - begin:.2f} | {np.diff(times).max() * (end - begin):.3f} | {lag:.2f} |"


def main() -> None:
    """Prints the table."""
    print("| free vertices | s | longest without a question, s | fraction ahead of or behind the time |")
    print("| --: | --: | --: | --: |")
    for size in [int(word) for word in sys.argv[1:]] or SIZES:
        print(row(size))


if __name__ == "__main__":
    main()
