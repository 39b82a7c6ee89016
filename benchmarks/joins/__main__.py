"""Joins that continue the curvature against tangent ones: errors and cost of docs/joins.md.

python benchmarks/joins [exact | fitted | cost …]
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "accuracy"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import exact_joins
import fairing
import shapes


def _timed(patch: shapes.Patch, **options: Any) -> tuple[fairing.FairResult, float]:
    """The result, and seconds of CPU on one thread."""
    begin = time.process_time()
    result = fairing.fair(
        shapes.start_from_nothing(patch), patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        threads=1, **options,
    )  # fmt: skip
    return result, time.process_time() - begin


def _both(patch: shapes.Patch) -> list[tuple[fairing.FairResult, float]]:
    curvatures = patch.mean_curvature[patch.fixed]
    return [_timed(patch), _timed(patch, continuity="G2", fixed_curvatures=curvatures)]


def _jump(patch: shapes.Patch, result: fairing.FairResult) -> float:
    """Root mean square error of H at the free vertices beside the outline."""
    ring = patch.triangles[np.isin(patch.triangles, patch.fixed).any(axis=1)]
    first = np.setdiff1d(ring, patch.fixed)
    return float(np.sqrt(np.mean((result.mean_curvature[first] - patch.mean_curvature[first]) ** 2)))


def exact() -> None:
    """Exact H: largest errors over D for 250 to 16,000 free vertices, the error of H beside the outline, steps."""
    for name, make in exact_joins.FAMILIES.items():
        errors, jumps, steps = [], [], []
        for n_free in (250, 1000, 4000, 16000):
            patch = make(n_free)
            (tangent, _), (curved, _) = _both(patch)
            errors.append(patch.error(curved.vertices))
            jumps.append((_jump(patch, tangent), _jump(patch, curved)))
            steps.append(curved.iterations)
        told = " / ".join(f"{error:.1e}" for error in errors)
        last = f"{jumps[2][0]:.2g} → {jumps[2][1]:.2g}"
        print(f"| {name} | {patch.error(tangent.vertices):.1e} | {told} | {last} | {max(steps)} |", flush=True)


def cost() -> None:
    """Seconds of CPU, tangent and curvature."""
    for n_free in (1000, 10000, 100000):
        for name in ("torus", "cubic cylinder"):
            (_, tangent), (result, curved) = _both(exact_joins.FAMILIES[name](n_free))
            print(f"| {name}, {n_free} | {tangent:.2f} | {curved:.2f} | {curved / tangent:.2f} | {result.iterations} |")


def fitted() -> None:
    """H fitted to the surroundings: largest distances to the surface over D, tangent, curvature, with exact H."""
    for name in exact_joins.CHARTS:
        for noise in (0.0, 0.002, 0.02, 0.1):
            rows = [exact_joins.fitted(name, seed, noise) for seed in range(3)]
            cells = " | ".join(f"{np.mean([row[k] for row in rows]):.1e}" for k in range(3))
            kept = sum(row[3] for row in rows)
            print(f"| {name} | {noise} | {cells} | {kept} of 3 |", flush=True)


TABLES: dict[str, Callable[[], None]] = {"exact": exact, "fitted": fitted, "cost": cost}


def main() -> None:
    for name in sys.argv[1:] or TABLES:
        TABLES[name]()


if __name__ == "__main__":
    main()
