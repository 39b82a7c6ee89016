"""Regions of scans against clean patches of the same size: seconds, the way taken, how well the outline is met.

    python benchmarks/scans                    # writes scans.csv; prints the table
    python benchmarks/scans --sizes 3000 10000
    python benchmarks/scans --at ict_head:700 demosthenes-low-res:2700 --calls 1 --page docs/performance.md

A head and a bust of shared/data, their triangles cut in four two and three times, noise of 0, 0.1 and ¼ of an edge on
all vertices; discs grown round a seed vertex. The clean patch is a jittered half sphere. Both run in turns, one
thread, processor time; the ratio is that of the medians. `--page` writes the summary between two marks of a page.
"""

from __future__ import annotations

import argparse
import csv
import statistics
import sys
import time
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import fairing
import measures
import shapes
from polygons import read_polygons, triangles_of
from real_meshes import DATA
from tetrathing import subdivided

ROOT = Path(__file__).resolve().parents[2]
GOAL = 2.0  # times a clean patch
REGIONS = ["ict_head:2752", "demosthenes-low-res:3323"]  # meshes and seed vertices, which subdivision keeps
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


@dataclass(frozen=True)
class Region:
    """vertices (n, 3), triangles (m, 3), fixed (k,) and their normals (k, 3), fitted to the faces outside."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray


@lru_cache(maxsize=2)
def scan(name: str, times: int) -> tuple[FloatArray, IntArray]:
    """The mesh, subdivided so many times."""
    vertices, polygons = read_polygons(DATA / f"{name}.obj")
    triangles = np.asarray(triangles_of(polygons), dtype=np.int64)
    for _ in range(times):
        triangles, ends = subdivided(triangles, len(vertices))
        vertices = np.vstack([vertices, 0.5 * (vertices[ends[:, 0]] + vertices[ends[:, 1]])])
    return vertices, triangles


def shaken(vertices: FloatArray, triangles: IntArray, noise: float) -> FloatArray:
    """All vertices moved at random, by `noise` mean edges (standard deviation of each coordinate)."""
    ends = measures.edges(triangles)
    edge = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1).mean()
    return np.asarray(vertices + noise * edge * np.random.default_rng(7).normal(size=vertices.shape) / np.sqrt(3))


def region(vertices: FloatArray, triangles: IntArray, seed: int, wanted: int) -> Region:
    """The triangles whose corners are the `wanted` vertices nearest to the seed along edges."""
    ends = measures.edges(triangles)
    lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    graph = coo_array((lengths, (ends[:, 0], ends[:, 1])), shape=(len(vertices),) * 2).tocsr()
    away = dijkstra(graph, directed=False, indices=seed)
    chosen = (away <= np.sort(away)[wanted])[triangles].all(axis=1)
    chosen = _without_pinches(triangles, chosen)
    inside, outside = triangles[chosen], triangles[~chosen]
    used = np.unique(inside)
    number = np.full(len(vertices), -1)
    number[used] = np.arange(len(used))
    held = np.zeros(len(vertices), dtype=bool)
    held[outside] = True
    held[measures.border_edges(triangles)] = True
    fixed = used[held[used]]
    normals = np.array(fairing.surrounding_normals(vertices, outside, fixed).normals)
    missing = np.linalg.norm(normals, axis=1) < 0.5
    normals[missing] = fairing.vertex_normals(vertices, triangles)[fixed[missing]]
    return Region(vertices[used], number[inside], number[fixed], normals)


def _without_pinches(triangles: IntArray, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Drops triangles at vertices where the region meets itself in a point."""
    while True:
        border = measures.border_edges(triangles[chosen])
        often = np.flatnonzero(np.bincount(np.ravel(border)) > 2)
        if not len(often):
            return chosen
        chosen = chosen & ~np.isin(triangles, often).any(axis=1)


def timed(vertices: FloatArray, triangles: IntArray, options: dict[str, Any]) -> tuple[fairing.FairResult, float]:
    """The result and its processor time."""
    start = time.process_time()
    result = fairing.fair(vertices, triangles, threads=1, **options)
    return result, time.process_time() - start


def measured(place: str, noise: float, wanted: int, calls: int) -> Row:
    """One row: scan and clean patch in turns."""
    name, seed = place.split(":")
    vertices, triangles = scan(name, 2 if wanted <= 10000 else 3)  # whichever has regions of that size
    patch = region(shaken(vertices, triangles, noise), triangles, int(seed), wanted)
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
    places = ", ".join(dict.fromkeys(row.region for row in rows))
    return "\n".join(
        [*lines, "", f"Median (worst) × clean; within {GOAL:g} ×, polished, converged of all. Regions:", f"{places}."]
    )


def cell(rows: list[Row]) -> str:
    """Of one size and noise."""
    if not rows:
        return "not run"
    ratios = [row.ratio for row in rows]
    counts = [sum(ratio <= GOAL for ratio in ratios), sum(r.polished for r in rows), sum(r.converged for r in rows)]
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
    parser.add_argument("--page", type=Path, help="a page that holds the two marks")
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
    if options.page:
        written(options.page, summary(rows))
    return int(any(row.ratio > GOAL or not row.polished for row in rows))


if __name__ == "__main__":
    raise SystemExit(main())
