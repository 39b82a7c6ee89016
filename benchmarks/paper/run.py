"""Table 1, Figs. 1 and 2 in numbers, and the accuracy of method "paper", as Markdown.

    python benchmarks/paper/run.py [--iterations 200]

Ear and face patches need `shared/data/ict_head.obj` beside the checkout; without it they are left
out.
"""

from __future__ import annotations

import argparse
import sys
import time
from itertools import combinations
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

import cases
import numpy as np
from cases import Case, FloatArray
from scipy.sparse import diags_array
from scipy.sparse.linalg import spsolve

import fairing
import measures
import shapes


def fair(case: Case, **options: Any) -> tuple[fairing.FairResult, float]:
    """Result and seconds."""
    start = time.perf_counter()
    result = fairing.fair(
        case.vertices, case.triangles,
        fixed=case.fixed, fixed_normals=case.normals, **{**case.options, **options},
    )  # fmt: skip
    return result, time.perf_counter() - start


def furthest(case: Case, one: fairing.FairResult, other: fairing.FairResult) -> float:
    """Largest distance between vertices of the same number, over D."""
    return float(np.linalg.norm(one.vertices - other.vertices, axis=1).max() / case.diameter)


def table_one(iterations: int) -> None:
    """The columns of Table 1 with ours beside them."""
    print("| case | vertices | triangles | base | paper s | + hierarchy | global s | 2001 s "
          "| residual | angle | ended | from global, averaged | from global, fitted |")  # fmt: skip
    print("|" + " --- |" * 13)
    for case in cases.all_cases():
        result, seconds = fair(case, method="paper", max_iterations=iterations)
        averaged, _ = fair(case, normals="averaged")
        fitted, fast = fair(case)
        without = seconds - result.seconds["hierarchy"]
        print(
            f"| {case.name} | {len(case.vertices)} | {len(case.triangles)} | {result.levels[0]} "
            f"| {without:.2f} | {seconds:.2f} | {fast:.2f} | {case.seconds:g} "
            f"| {result.residual:.2g} | {result.boundary_angle.max():.2g}° "
            f"| {result.termination}, global {fitted.termination} "
            f"| {furthest(case, result, averaged):.1e} | {furthest(case, result, fitted):.1e} |"
        )


def linear_bilaplacian(case: Case, weights: str) -> FloatArray:
    """Δ²q = 0 with positions met; λ uniform or conformal to the mesh that is given."""
    count = len(case.vertices)
    if weights == "uniform":
        matrix = shapes.uniform_laplacian(case.triangles, count).tocsr()
    else:
        rows, columns, values = fairing.cotan_laplacian(case.vertices, case.triangles)
        matrix = shapes.uniform_laplacian(case.triangles, count).tocsr()
        matrix = type(matrix)((values, (rows, columns)), shape=(count, count))
    scaled = diags_array(1.0 / matrix.diagonal()) @ matrix
    free = np.setdiff1d(np.arange(count), case.fixed)
    squared = (scaled[free][:, free] @ scaled[free]).tocsr()
    result = case.vertices.copy()
    result[free] = spsolve(squared[:, free].tocsc(), -(squared[:, case.fixed] @ case.vertices[case.fixed]))
    return result


def sensitivity() -> None:
    """Two resolutions and two parameterisations of the blend, each pair's two-sided distance."""
    meshes = {"coarse": cases.cylinder_blend(0.6, 3, 700), "fine": cases.cylinder_blend(0.0, 0, 1600)}
    linear, ours = {}, {}
    for size, case in meshes.items():
        for weights in ("uniform", "conformal"):
            linear[size, weights] = (linear_bilaplacian(case, weights), case.triangles)
            result, _ = fair(case, method="paper", max_iterations=2000, inner_fairness=weights)
            ours[size, weights] = (result.vertices, case.triangles)
    print("| pair | linear bilaplacian | paper | ratio |\n| --- | --- | --- | --- |")
    diameter = meshes["fine"].diameter
    for one, other in combinations(linear, 2):
        far = measures.two_sided_distance(linear[one], linear[other]) / diameter
        near = measures.two_sided_distance(ours[one], ours[other]) / diameter
        print(f"| {' '.join(one)}, {' '.join(other)} | {far:.2e} | {near:.2e} | {far / near:.1f} |")


def accuracy() -> None:
    """Largest distance to exact surfaces over D: averaged normals against fitted ones."""
    print("| surface, jittered | free vertices | paper | updates | global, fitted |")
    print("| --- | --- | --- | --- | --- |")
    for family in ("cylinder", "catenoid", "unduloid", "linear_flux", "clothoid"):
        for size in (500, 1000, 4000):
            patch = shapes.FAMILIES[family](size)
            start = shapes.start_from_nothing(patch)
            boundary = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals}
            ours = fairing.fair(start, patch.triangles, method="paper", max_iterations=2000, **boundary)
            best = fairing.fair(start, patch.triangles, **boundary)
            updates = f"{ours.iterations}{'' if ours.converged else ' (not converged)'}"
            print(
                f"| {family} | {len(patch.free)} | {patch.error(ours.vertices):.1e} | {updates} "
                f"| {patch.error(best.vertices):.1e} |"
            )


def main() -> None:
    """Prints all tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--iterations", type=int, default=200, help="updates of the finest mesh")
    iterations = parser.parse_args().iterations
    print("## Table 1\n")
    table_one(iterations)
    print("\n## Figs. 1 and 2: how far the mesh shows through\n")
    sensitivity()
    print("\n## Distance to exact surfaces\n")
    accuracy()


if __name__ == "__main__":
    main()
