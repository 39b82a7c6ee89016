"""Where a surface comes from is reported, whatever else is asked for."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
import tubes
from test_low_passed import rough_cap
from test_otherwise import wing

Case = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]  # vertices, triangles, fixed, normals


def of_patch(patch: shapes.Patch, **options: Any) -> Case:
    return patch.vertices, patch.triangles, patch.fixed, patch.fixed_normals, options


def of_tube(tube: tubes.Tube, **options: Any) -> Case:
    return tube.vertices, tube.triangles, tube.fixed, tube.normals, options


def scattered(tube: tubes.Tube) -> tubes.Tube:
    """No shape before that could be smoothed."""
    inside = np.setdiff1d(np.arange(len(tube.vertices)), tube.fixed)
    tube.vertices[inside] *= np.random.default_rng(0).uniform(-1.0, 1.0, (len(inside), 3))
    return tube


ORIGINS: dict[str, Callable[[], Case]] = {
    "equation": lambda: of_patch(shapes.cap(400)),
    "low_passed": lambda: of_patch(rough_cap(0.8, 1.0, 0)),
    "least_variation": lambda: of_tube(tubes.pipe(5.0, 5.0, seed=3)),
    "loft": lambda: of_tube(scattered(wing())),
    "old_shape": lambda: of_tube(tubes.pipe(8.0), start="smoothed"),
}


def pinned(case: Case) -> Case:
    """The highest vertex inside is held: on the unit sphere of the caps, on a tube where it lies."""
    vertices, triangles, fixed, normals, options = case
    free = np.setdiff1d(np.unique(triangles), fixed)
    pin = free[np.argmax(vertices[free, 2] - vertices[fixed, 2].max())]
    moved = vertices.copy()
    if np.ptp(vertices[fixed, 2]) < 0.5:
        moved[pin] = [0.0, 0.0, 1.0]
    return moved, triangles, np.append(fixed, pin), np.vstack([normals, [0.0, 0.0, 1.0]]), options


def solve(case: Case, weights: str, continuity: str, detail: float) -> fairing.FairResult:
    vertices, triangles, fixed, normals, options = case
    if continuity == "G2":
        options = {**options, "fixed_curvatures": np.full(len(fixed), -1.0)}
    return fairing.fair(
        vertices, triangles, fixed=fixed, fixed_normals=normals, inner_fairness=weights, continuity=continuity,
        detail=detail, threads=1, **options,
    )  # fmt: skip


@pytest.mark.parametrize("origin", ORIGINS)
def test_every_origin_is_reported_with_every_option(origin: str) -> None:
    for pin, weights, continuity, detail in itertools.product(
        (False, True), ("uniform", "conformal"), ("G1", "G2"), (0.0, 0.5)
    ):
        case = ORIGINS[origin]()
        result = solve(pinned(case) if pin else case, weights, continuity, detail)
        combination = (pin, weights, continuity, detail)
        found = {warning.code: warning.figures for warning in result.warnings}
        if not result.converged:  # a pin may leave nothing that fits
            assert pin and "NOT_CONVERGED" in found, combination
            continue
        assert pin or result.provenance == origin, combination
        assert ("NO_SOLUTION" in found) == (result.provenance != "equation"), combination
        figures = found.get("NO_SOLUTION", {})
        assert ("distance" in figures) == (result.provenance == "low_passed"), combination
        assert ("loft" in figures) == (result.provenance == "loft"), combination
        assert ("smoothed" in figures) == (result.provenance == "old_shape"), combination


def test_a_pin_does_not_hide_that_the_surface_lies_beside_its_boundary() -> None:
    """The log of what was tried ends with the pins then: it is no evidence."""
    case = of_patch(rough_cap(0.8, 1.0, 0))
    plain = solve(case, "uniform", "G1", 0.0)
    result = solve(pinned(case), "uniform", "G1", 0.0)
    for each in (plain, result):
        assert each.provenance == "low_passed"
        (warning,) = [warning for warning in each.warnings if warning.code == "NO_SOLUTION"]
        assert warning.figures["distance"] == pytest.approx(0.0383, abs=1e-3)
