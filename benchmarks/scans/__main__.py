"""Regions of scans against clean patches of the same size: seconds, the way taken, how well the outline is met.

    python benchmarks/scans                    # writes scans.csv; prints the table
    python benchmarks/scans --sizes 3000 10000
    python benchmarks/scans --at ict_head:700 demosthenes-low-res:2700 --calls 1 \
        --page docs/dev/performance_log.md benchmarks/peers/log.md

A head and a bust of shared/data, their triangles cut in four two and three times, noise of 0, 0.1 and ¼ of an edge on
all vertices; discs grown round a seed vertex. The clean patch is a jittered half sphere. Both run in turns, one
thread, processor time; the ratio is that of the medians. `--page` writes the summary between two marks of a page.
"""

from __future__ import annotations

import argparse
import csv
import statistics
import sys
import textwrap
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import fairing
import shapes
from real_meshes import DATA
from scan_regions import MESHES, scan_region

ROOT = Path(__file__).resolve().parents[2]
GOAL = 2.0  # times a clean patch
REGIONS = [f"{name}:{seed}" for name, seed in MESHES.items()]
BEGIN, END = "<!-- scans: begin -->", "<!-- scans: end -->"  # of the summary in a page
FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Row:
    """One region; cpu in seconds, ratio to the clean patch of the same size."""

    region: str
    noise: float
    wanted: int
    free: int
    way: str
    converged: bool
    polished: bool
    cpu: float
    ratio: float
    angle: float


def timed(vertices: FloatArray, triangles: IntArray, options: dict[str, Any]) -> tuple[fairing.FairResult, float]:
    """The result and its processor time."""
    start = time.process_time()
    result = fairing.fair(vertices, triangles, threads=1, **options)
    return result, time.process_time() - start


def measured(place: str, noise: float, wanted: int, calls: int) -> Row:
    """One row: scan and clean patch in turns."""
    name, seed = place.split(":")
    patch = scan_region(name, noise, wanted, int(seed))
    free = len(patch.vertices) - len(patch.fixed)
    clean = shapes.cap(free)
    pairs = [
        (timed(patch.vertices, patch.triangles, {"fixed": patch.fixed, "fixed_normals": patch.normals}),
         timed(clean.vertices, clean.triangles, {"fixed": clean.fixed, "fixed_normals": clean.fixed_normals}))
        for _ in range(calls)
    ]  # fmt: skip
    result = pairs[0][0][0]
    cpu, cpu_clean = (statistics.median(pair[k][1] for pair in pairs) for k in (0, 1))
    return Row(place, noise, wanted, free, "+".join(way for way, _ in result.way), result.converged, result.polished,
               cpu, cpu / cpu_clean, float(np.median(result.boundary_angle)))  # fmt: skip


def summary(rows: list[Row]) -> str:
    """Sizes by noise: median and worst ratio, and how many are within the goal, polished, converged."""
    noises = sorted({row.noise for row in rows})
    lines = [f"| free | {' | '.join(f'noise {noise:g}' for noise in noises)} |", "| --: " * (len(noises) + 1) + "|"]
    for wanted in sorted({row.wanted for row in rows}):
        cells = [cell([row for row in rows if (row.wanted, row.noise) == (wanted, noise)]) for noise in noises]
        lines.append(f"| {wanted} | {' | '.join(cells)} |")
    note = f"Median (worst) × clean; converged within {GOAL:g} ×, polished, converged of all."
    return "\n".join([*lines, "", textwrap.fill(note, 120, break_on_hyphens=False)])


def cell(rows: list[Row]) -> str:
    """Of one size and noise."""
    if not rows:
        return "not run"
    ratios = [row.ratio for row in rows]
    counts = [
        sum(r.converged and r.ratio <= GOAL for r in rows),
        sum(r.polished for r in rows),
        sum(r.converged for r in rows),
    ]
    return f"{statistics.median(ratios):.1f} ({max(ratios):.1f}); {', '.join(map(str, counts))} of {len(rows)}"


def written(page: Path, text: str) -> None:
    """The summary in its place in a page."""
    before, rest = page.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    page.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}", encoding="utf-8")


def main() -> int:
    """Print the table; 1 if a region takes longer than the goal or isn't polished, 2 without meshes."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[3000, 10000, 30000, 60000])
    parser.add_argument("--noise", type=float, nargs="+", default=[0.0, 0.1, 0.25], help="in edges")
    parser.add_argument("--at", nargs="+", default=REGIONS, help="mesh:vertex")
    parser.add_argument("--page", type=Path, nargs="+", default=[], help="pages that hold the two marks")
    parser.add_argument("--calls", type=int, default=3)
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "scans", help="folder for the CSV")
    options = parser.parse_args()
    if not DATA.exists():
        print("the meshes of shared/data are missing", file=sys.stderr)
        return 2
    print("| region | noise | free | way | ended | polished | CPU s | ÷ clean | angle, median ° |")
    print("| --- | --: | --: | --- | --- | --- | --: | --: | --: |")
    rows = []
    for wanted in options.sizes:
        for place in options.at:
            for noise in options.noise:
                row = measured(place, noise, wanted, options.calls)
                rows.append(row)
                print(f"| {place} | {noise:g} | {row.free} | {row.way} | {'yes' if row.converged else 'no'} | "
                      f"{'yes' if row.polished else 'no'} | {row.cpu:.2f} | {row.ratio:.2f} | {row.angle:.1f} |",
                      flush=True)  # fmt: skip
    options.out.mkdir(parents=True, exist_ok=True)
    with (options.out / "scans.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(asdict(rows[0])))
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)
    print(f"\n{summary(rows)}")
    for page in options.page:
        written(page, summary(rows))
    return int(any(row.ratio > GOAL or not row.polished for row in rows))


if __name__ == "__main__":
    raise SystemExit(main())
