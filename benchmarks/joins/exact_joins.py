"""Exact surfaces for joins: patches with exact H, and patches within meshes of the same surfaces."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import fairing
import outlines
import shapes
import test_joins
from engine import FloatArray
from outlines import Chart

FAMILIES: dict[str, Callable[[int], shapes.Patch]] = {
    "sphere": test_joins.MAKERS["hemisphere"],
    "cylinder": test_joins.MAKERS["cylinder"],
    "cubic cylinder": test_joins.MAKERS["cubic"],
    "torus": test_joins.MAKERS["torus"],
    "ellipsoid": test_joins.MAKERS["ellipsoid"],
}
CHARTS = ("sphere", "torus", "inner torus", "ellipsoid", "cubic")


def _distance(chart: Chart, near: FloatArray, points: FloatArray) -> float:
    """Largest distance of points from a chart's surface; near: (s, t) to begin with."""
    place, step = near.copy(), 1e-5
    for _ in range(12):
        s, t = place.T
        along = (chart(s + step, t) - chart(s - step, t)) / (2 * step)
        across = (chart(s, t + step) - chart(s, t - step)) / (2 * step)
        slopes = np.stack([along, across], -1)
        rhs = np.einsum("nki,nk->ni", slopes, points - chart(s, t))
        place += np.linalg.solve(np.einsum("nki,nkj->nij", slopes, slopes), rhs[..., None])[..., 0]
    return float(np.linalg.norm(points - chart(*place.T), axis=1).max())


def _mean_curvature(chart: Chart, s: FloatArray, t: FloatArray) -> FloatArray:
    """H by central differences of 1e-3, on the side of the charts' normals."""
    h = 1e-3
    here = chart(s, t)
    along, across = (chart(s + h, t) - chart(s - h, t)) / (2 * h), (chart(s, t + h) - chart(s, t - h)) / (2 * h)
    normal = outlines.exact_normals(chart, s, t)
    twice = [(chart(s + a * h, t + b * h) - 2 * here + chart(s - a * h, t - b * h)) / h**2 for a, b in ((1, 0), (0, 1))]
    mixed = [chart(s + a * h, t + b * h) for a, b in ((1, 1), (-1, -1), (1, -1), (-1, 1))]
    twist = (mixed[0] + mixed[1] - mixed[2] - mixed[3]) / (4 * h**2)
    first = [(one * other).sum(axis=1) for one, other in ((along, along), (along, across), (across, across))]
    second = [(part * normal).sum(axis=1) for part in (twice[0], twist, twice[1])]
    mixed_terms = first[0] * second[2] - 2 * first[1] * second[1] + first[2] * second[0]
    return np.asarray(mixed_terms / (2 * (first[0] * first[2] - first[1] ** 2)))


def fitted(name: str, seed: int, noise: float) -> tuple[float, float, float, bool]:
    """Largest distances over D: tangent, with fitted H, with exact H; and whether the fitted H was met."""
    chart, case = outlines.SURFACES[name], outlines.make_case(name, 30 + seed, noise)
    normals = fairing.surrounding_normals(case.noisy, case.outside, case.outline).normals
    rim = case.noisy[case.outline]
    diameter = 2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max()
    exact = _mean_curvature(chart, *case.places[case.outline].T)
    used = np.setdiff1d(case.inside, case.outline)
    errors, met = [], False
    for options in ({}, {"continuity": "G2"}, {"continuity": "G2", "fixed_curvatures": exact}):
        result = fairing.fair(
            case.noisy, case.inside, fixed=case.outline, fixed_normals=normals, outside=case.outside, threads=1,
            **options,
        )  # fmt: skip
        errors.append(_distance(chart, case.places[used], result.vertices[used]) / diameter)
        met = met or (len(errors) == 2 and result.continuity == "G2")
    return errors[0], errors[1], errors[2], met
