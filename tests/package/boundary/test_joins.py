"""`continuity="G2"`: surfaces that continue the curvature of their surroundings (Δ_B² H = 0)."""

from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import curves
import fairing
import shapes
from curves import FloatArray
from domains import Domain
from grids import corners, halves, numbered
from meshing import IntArray
from shapes import Patch
from solving import codes, fair_patch
from surfaces import Extrusion


def cubic_cylinder(n_free: int) -> Patch:
    """An extrusion with H a cubic function of the arc length: Δ_B² H = 0 but Δ_B H ≠ 0."""
    curve = curves.OdeCurve(-1.0, 1.0, (0.0, 0.0, 0.0), lambda s, _: 0.4 + 0.5 * s + 0.6 * s**2 - 2.0 * s**3)
    return shapes.on_domain(Domain(Extrusion(curve, 1), "oval", 0.0, 1.6), n_free)


MAKERS = {"torus": shapes.torus, "cubic": cubic_cylinder}


@lru_cache(maxsize=16)
def joined(family: str, n_free: int) -> tuple[Patch, fairing.FairResult, fairing.FairResult]:
    """A patch, the surface that meets positions and slopes of its boundary, and the one that meets H as well."""
    patch = MAKERS[family](n_free)
    tangent = fair_patch(patch, tolerance=1e-6)
    return patch, tangent, with_curvature(patch, patch.mean_curvature[patch.fixed])


def with_curvature(patch: Patch, curvatures: FloatArray, **options: Any) -> fairing.FairResult:
    return fair_patch(patch, tolerance=1e-6, continuity="G2", fixed_curvatures=curvatures, **options)


def reported(result: fairing.FairResult) -> set[str]:
    """The figures of the one warning, G2_NOT_MET."""
    (warning,) = result.warnings
    assert warning.code == "G2_NOT_MET"
    return set(warning.figures)


@pytest.mark.parametrize(("family", "goal"), [("cubic", 1e-4), ("torus", 3e-5)])
def test_surfaces_that_tangent_joins_miss(family: str, goal: float) -> None:
    patch, tangent, curved = joined(family, 4000)
    assert curved.continuity == "G2"
    assert curved.converged
    assert not codes(curved)
    assert patch.error(tangent.vertices) > 2e-3
    assert patch.error(curved.vertices) < goal


def both_joins(vertices: FloatArray, triangles: IntArray, within: Any) -> list[fairing.FairResult]:
    """The triangles within, faired from what those outside say: tangent, and with their curvature, met everywhere."""
    boundary = np.intersect1d(triangles[within], triangles[~within])
    fits = fairing.surrounding_normals(vertices, triangles[~within], boundary)
    options = {"fixed": boundary, "fixed_normals": fits.normals, "outside": triangles[~within]}
    results = []
    for continuity in ("G1", "G2"):
        results.append(fairing.fair(vertices, triangles[within], continuity=continuity, **options))
        assert results[-1].continuity == continuity
        assert not codes(results[-1])
    return results


@pytest.mark.parametrize("size", [60, 72])
def test_a_boundary_in_steps_is_met_in_its_curvature(size: int) -> None:
    """A barrel whose curvature changes; the boundary of an oval runs in steps along the grid."""
    x, y = (part.ravel() for part in np.meshgrid(*2 * [np.linspace(-1, 1, size + 1)], indexing="ij"))
    height = np.sqrt(4 - x**2) - 2 - 0.3 * y**2 + 0.15 * y**3
    vertices = np.column_stack([x, y, height])
    triangles = halves(numbered(size + 1, size + 1))
    middle = np.tile(vertices[corners(numbered(size + 1, size + 1)), :2].mean(axis=1), (2, 1))
    within = (middle[:, 0] / 0.62) ** 2 + (middle[:, 1] / 0.5) ** 2 < 1
    off = []
    for result in both_joins(vertices, triangles, within):
        off.append(np.abs(result.vertices[:, 2] - height).max())
    assert off[1] < 0.75 * off[0]


def test_tangent_join_where_no_surface_has_the_curvature() -> None:
    """H of the other sign and ten times as large: the answer with tangent joins comes back, bit for bit."""
    patch, tangent, _ = joined("cubic", 1000)
    curved = with_curvature(patch, np.full(len(patch.fixed), -300.0))
    assert curved.continuity == "G1"
    assert reported(curved) == {"not_found", "vertices", "outline_vertices"}
    np.testing.assert_array_equal(curved.vertices, tangent.vertices)


def test_unknown_curvature_is_left_to_the_surface() -> None:
    patch, tangent, _ = joined("cubic", 1000)
    nothing = with_curvature(patch, np.full(len(patch.fixed), np.nan))
    assert reported(nothing) == {"vertices", "outline_vertices"}
    np.testing.assert_array_equal(nothing.vertices, tangent.vertices)
    part = patch.mean_curvature[patch.fixed].copy()
    order = np.argsort(patch.vertices[patch.fixed] @ [0.0, 0.0, 1.0])
    part[order[: len(part) // 5]] = np.nan  # one end of the oval
    partly = with_curvature(patch, part)
    assert partly.continuity == "G2"
    (warning,) = partly.warnings
    assert warning.code == "G2_NOT_MET"
    assert warning.figures == {"vertices": np.isnan(part).sum(), "outline_vertices": len(part)}
    assert f"{np.isnan(part).sum()} of {len(part)} boundary vertices" in str(warning)
    assert set(warning.elements) == set(patch.fixed[np.isnan(part)])
    assert patch.error(partly.vertices) < 0.2 * patch.error(tangent.vertices)


def test_noise_is_not_followed() -> None:
    patch, tangent, _ = joined("torus", 1000)
    noise = np.random.default_rng(4).normal(0.0, 0.5, len(patch.fixed))
    rough = with_curvature(patch, patch.mean_curvature[patch.fixed] + noise)
    assert reported(rough) == {"smooth_share", "vertices", "outline_vertices"}
    assert rough.warnings[0].figures["smooth_share"] < 1 / 3
    assert f"all {len(patch.fixed)} boundary vertices" in str(rough.warnings[0])
    np.testing.assert_array_equal(rough.vertices, tangent.vertices)


WRONG = [
    ({"continuity": "G3"}, "continuity"),
    ({"continuity": "G2", "equation": "soap_film"}, "continuity"),
    ({"continuity": "G2", "method": "paper"}, "continuity"),
    ({"continuity": "G2", "fixed_curvatures": [1.0, 2.0]}, "fixed_curvatures"),
    ({"continuity": "G2"}, "outside"),  # no curvature and nothing to read it off
    ({"fixed_curvatures": [0.0]}, "fixed_curvatures"),  # asked for nothing that reads them
]


@pytest.mark.parametrize(("options", "named"), WRONG)
def test_wrong_options_are_refused(options: dict[str, Any], named: str) -> None:
    patch, _, _ = joined("torus", 1000)
    with pytest.raises(ValueError, match=named):
        fair_patch(patch, **options)
