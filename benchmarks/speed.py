"""Seconds of a whole `fair` call beside one clamped bi-Laplacian solve of that size, as Markdown.

    python benchmarks/speed.py [--repeat 3]

The yardstick is one linear fair: S M⁻¹ Sᵀ x = b on the free vertices, factorised with SciPy's
SuperLU in its symmetric mode (minimum degree on Aᵀ + A), three right-hand sides. It stands in for
the Cholesky solvers of other tools until those are measured side by side.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

import numpy as np
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import splu

import fairing
import shapes
from meshing import face_normals
from shapes import Patch

CASES = [("hemisphere", 800), ("hemisphere", 10000), ("catenoid", 10000), ("hemisphere", 40000)]


def linear_fair(patch: Patch) -> np.ndarray:
    """Positions (n, 3) of the clamped bi-Laplacian with the cotangents and areas of the mesh."""
    count = len(patch.vertices)
    rows, columns, values = fairing.cotan_laplacian(patch.vertices, patch.triangles)
    stiffness = coo_array((values, (rows, columns)), shape=(count, count)).tocsr()
    mass = np.zeros(count)
    area = np.linalg.norm(face_normals(patch.vertices, patch.triangles), axis=1) / 6
    np.add.at(mass, patch.triangles.ravel(), np.repeat(area, 3))
    operator = (stiffness[patch.free] @ diags_array(1 / mass) @ stiffness).tocsc()
    load = -(operator[:, patch.fixed] @ patch.vertices[patch.fixed])
    solver = splu(
        operator[:, patch.free].tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )  # fmt: skip
    result = patch.vertices.copy()
    result[patch.free] = solver.solve(load)
    return result


def best_of(repeat: int, call: Callable[[], Any]) -> tuple[float, Any]:
    """Least wall-clock seconds of several calls, and the result of that call."""
    runs = []
    for _ in range(repeat):
        start = time.perf_counter()
        result = call()
        runs.append((time.perf_counter() - start, result))
    return min(runs, key=lambda run: run[0])


def line(family: str, n_free: int, repeat: int) -> str:
    """One row of the table: default tolerance, one thread."""
    patch = shapes.FAMILIES[family](n_free)
    start = shapes.start_from_nothing(patch)

    def call() -> fairing.FairResult:
        return fairing.fair(
            start, patch.triangles,
            fixed=patch.fixed, fixed_normals=patch.fixed_normals, threads=1,
        )  # fmt: skip

    whole, result = best_of(repeat, call)
    yardstick, _ = best_of(repeat, lambda: linear_fair(patch))
    inside = result.seconds.get("total", sum(result.seconds.values()))
    stages = ", ".join(f"{name} {value:.3f}" for name, value in result.seconds.items())
    return (
        f"| {family} | {len(patch.free)} | {whole:.3f} | {inside:.3f} | {yardstick:.3f} "
        f"| {whole / yardstick:.2f} | {result.iterations} | {stages} |"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--repeat", type=int, default=3, help="best of this many calls")
    repeat = parser.parse_args().repeat
    print(
        "| case | free vertices | whole call, s | inside the engine, s | one linear solve, s "
        "| ratio | iterations | stages |\n" + "| --- " * 8 + "|"
    )
    for family, n_free in CASES:
        print(line(family, n_free, repeat), flush=True)


if __name__ == "__main__":
    main()
