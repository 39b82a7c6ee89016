"""Milliseconds of `Solver.solve` after a small move of the boundary, as Markdown.

    python benchmarks/repeated.py [--repeat 9] [--move 0.01]

Near one fixed vertex after the other the surface is dragged by `move` × D. Beside it: the whole `fair` call, and
one back-substitution of a linear fair (S M⁻¹ Sᵀ of the free vertices, three right-hand sides) with SciPy's SuperLU.
CPU time of one thread, the least and the median of the calls.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

import numpy as np
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import splu

import fairing
import shapes
from meshing import face_normals
from shapes import Patch

CASES = [("hemisphere", 2000), ("catenoid", 2000), ("hemisphere", 10000), ("catenoid", 10000)]


def milliseconds(calls: list[Callable[[], object]]) -> np.ndarray:
    """CPU time of each call."""
    spent = []
    for call in calls:
        begin = time.process_time()
        call()
        spent.append(1e3 * (time.process_time() - begin))
    return np.array(spent)


def dragged(patch: Patch, at: int, by: float) -> np.ndarray:
    """All vertices moved near one of the fixed ones, at most by `by` × D."""
    centre = patch.vertices[patch.fixed[at % len(patch.fixed)]]
    reach = np.linalg.norm(patch.vertices - centre, axis=1) / (0.2 * patch.diameter)
    return patch.vertices + by * patch.diameter * np.exp(-(reach**2))[:, None] * np.array([0.3, -0.5, 0.8])


def back_substitution(patch: Patch) -> Callable[[], object]:
    """One solve with the factorised clamped bi-Laplacian."""
    count = len(patch.vertices)
    rows, columns, values = fairing.cotan_laplacian(patch.vertices, patch.triangles)
    stiffness = coo_array((values, (rows, columns)), shape=(count, count)).tocsr()
    mass = np.zeros(count)
    area = np.linalg.norm(face_normals(patch.vertices, patch.triangles), axis=1) / 6
    np.add.at(mass, patch.triangles.ravel(), np.repeat(area, 3))
    operator = (stiffness[patch.free] @ diags_array(1 / mass) @ stiffness).tocsc()
    factor = splu(
        operator[:, patch.free].tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )  # fmt: skip
    load = -(operator[:, patch.fixed] @ patch.vertices[patch.fixed])
    return lambda: factor.solve(load)


def line(family: str, n_free: int, repeat: int, move: float) -> str:
    """One row of the table, default tolerance."""
    patch = shapes.FAMILIES[family](n_free)
    normals = patch.fixed_normals
    solver = fairing.Solver(patch.triangles, fixed=patch.fixed)
    first = milliseconds([lambda: solver.solve(patch.vertices, normals)])[0]
    moves = [dragged(patch, 7 * k, move) for k in range(repeat)]
    results: list[fairing.FairResult] = []
    repeated = milliseconds([lambda m=m: results.append(solver.solve(m, normals)) for m in moves])  # type: ignore[misc]
    single = milliseconds(
        [lambda m=m: fairing.fair(m, patch.triangles, fixed=patch.fixed, fixed_normals=normals) for m in moves[:3]]  # type: ignore[misc]
    )
    linear = milliseconds([back_substitution(patch)] * repeat)
    warm = sum("prediction" in result.seconds for result in results)
    iterations = [result.iterations for result in results]
    return (
        f"| {family} | {len(patch.free)} | {first:.0f} | {repeated.min():.1f} | {np.median(repeated):.1f} "
        f"| {min(iterations)}–{max(iterations)} | {warm} of {repeat} | {single.min():.0f} | {linear.min():.1f} |"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--repeat", type=int, default=9, help="solves of each case")
    parser.add_argument("--move", type=float, default=0.01, help="of the boundary, in units of D")
    arguments = parser.parse_args()
    print(
        "| case | free vertices | first solve | solve, least | median | iterations | from the last answer | fair "
        "| linear back-substitution |\n" + "| --- " * 9 + "|"
    )
    for family, n_free in CASES:
        print(line(family, n_free, arguments.repeat, arguments.move), flush=True)


if __name__ == "__main__":
    main()
