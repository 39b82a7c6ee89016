"""Surfaces from random networks of wires: whether each has one, how long that takes, and the worst kink at a wire.

python benchmarks/wires [FIRST_SEED [COUNT]]
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

import fairing
import wire_networks as networks
from fairing._new_mesh import FromCurvesResult


def worst_kink(points: networks.Floats, result: FromCurvesResult) -> float:
    """The largest angle at a wire between two cells that exceeds what is usual beside it (fairing.visible_join)."""
    all_points = np.concatenate([points, result.vertices])
    sides = np.concatenate([np.column_stack([loop, np.roll(loop, -1)]) for loop in result.cells])
    edges, uses = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
    outer = np.unique(edges[uses == 1])
    worst = 0.0
    for k, loop in enumerate(result.cells):
        mine = result.cell == k
        within = np.setdiff1d(loop, outer)
        if len(within):
            join = fairing.visible_join(all_points, result.triangles[mine], result.triangles[~mine], within)
            worst = max(worst, float(join.degrees.max()))
    return worst


def main() -> None:
    """Print a line for each network, and the share that has a surface."""
    given = [int(word) for word in sys.argv[1:]]
    first, count = given + [100, 20][len(given) :]
    solved = 0
    for seed in range(first, first + count):
        kind, (points, wires) = networks.random(seed)
        begin, processor = time.perf_counter(), time.process_time()
        try:
            result = fairing.surface_from_curves(points, wires)
        except (fairing.MeshError, fairing.SolverError) as error:
            print(f"{seed:5d} {kind:10s} {error}")
            continue
        seconds, busy = time.perf_counter() - begin, time.process_time() - processor
        solved += result.converged
        folds = [warning.code for warning in result.warnings]
        print(
            f"{seed:5d} {kind:10s} {len(result.cells):3d} cells {len(result.triangles):6d} triangles "
            f"{'' if result.converged else 'NOT '}solved {seconds:6.2f} s, processor {busy:5.2f} s, kink "
            f"{worst_kink(points, result):5.1f}° {' '.join(folds)} {[name for name, _ in result.way]}",
            flush=True,
        )
    print(f"{solved} of {count} solved")


if __name__ == "__main__":
    main()
