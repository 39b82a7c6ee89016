"""CPU seconds for the levels of jittered grids, as Markdown: the goal is 2 s for 100k vertices, near-linear.

python benchmarks/hierarchy.py
"""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

import fairing


def grid(n: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """n² vertices on a gently curved sheet."""
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n)))
    jitter = np.random.default_rng(0).uniform(-0.3, 0.3, (2, n * n)) * 2 / n
    points = np.column_stack([u + jitter[0], v + jitter[1], 0.2 * np.cos(3 * u) * v])
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return points, np.vstack(
        [np.column_stack([corner, corner + 1, corner + n + 1]), np.column_stack([corner, corner + n + 1, corner + n])]
    )


def main() -> None:
    """Prints the table."""
    print("| vertices | levels | s | µs per vertex |\n| --- | --- | --- | --- |")
    for n in (100, 158, 316, 500):
        points, triangles = grid(n)
        seconds = []
        for _ in range(3):
            start = time.process_time()
            levels = fairing.hierarchy(points, triangles)
            seconds.append(time.process_time() - start)
        print(f"| {n * n} | {len(levels)} | {min(seconds):.2f} | {1e6 * min(seconds) / n**2:.1f} |")


if __name__ == "__main__":
    main()
