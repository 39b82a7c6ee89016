"""Where a surface comes from is reported, whatever else is asked for."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
import tubes
from test_eased import rough_cap
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
    """A vertex in the middle stays where it is, or on the sphere that the caps are cut from."""
    vertices, triangles, fixed, normals, options = case
    free = np.setdiff1d(np.unique(triangles), fixed)
    pin = free[np.argmin(np.linalg.norm(vertices[free] - vertices[free].mean(axis=0), axis=1))]
    return vertices, triangles, np.append(fixed, pin), np.vstack([normals, [0.0, 0.0, 1.0]]), options


def solve(case: Case, weights: str, continuity: str, detail: float) -> fairing.FairResult:
    vertices, triangles, fixed, normals, options = case
    if continuity == "G2":
        options = {**options, "fixed_curvatures": np.full(len(fixed), -1.0)}
    return fairing.fair(
        vertices, triangles, fixed=fixed, fixed_normals=normals, inner_fairness=weights, continuity=continuity,
        detail=detail, threads=1, **options,
    )  # fmt: skip


def leaves_its_normals(result: fairing.FairResult) -> bool:
    """Whether a tenth of the boundary is met at 20° from the normals prescribed, which no surface of an equation is."""
    angles = result.boundary_angle[result.boundary_angle > 0]
    return len(angles) > 0 and bool(np.quantile(angles, 0.9) > 20)


@pytest.mark.parametrize("origin", ORIGINS)
def test_every_origin_is_reported_with_every_option(origin: str) -> None:
    for pin, weights, continuity, detail in itertools.product(
        (False, True), ("uniform", "conformal"), ("G1", "G2"), (0.0, 0.5)
    ):
        case = ORIGINS[origin]()
        result = solve(pinned(case) if pin else case, weights, continuity, detail)
        combination = (pin, weights, continuity, detail)
        assert result.converged, combination
        if not pin:
            assert result.provenance == origin, combination
        reports = [warning.figures for warning in result.warnings if warning.code == "NO_SOLUTION"]
        assert len(reports) == (result.provenance != "equation"), combination
        if not reports:
            assert not leaves_its_normals(result), combination
            continue
        (figures,) = reports
        assert ("distance" in figures) == result.provenance.startswith("low_passed"), combination
        assert ("loft" in figures) == (result.provenance in ("loft", "low_passed_loft", "swept_tube")), combination
        assert ("smoothed" in figures) == (result.provenance == "old_shape"), combination


def test_a_pin_does_not_hide_that_the_surface_lies_beside_its_boundary() -> None:
    """The log of what was tried ends with the pins then: it is no evidence."""
    result = solve(pinned(of_patch(rough_cap(0.8, 1.0, 0))), "uniform", "G1", 0.0)
    assert result.provenance == "low_passed"
    assert leaves_its_normals(result)
    (warning,) = [warning for warning in result.warnings if warning.code == "NO_SOLUTION"]
    assert 0.01 < warning.figures["distance"] < 0.1
