"""Nothing breaks the engine: positions without area or length, needles, spikes, scales."""

from __future__ import annotations

import numpy as np
import pytest

import bad_inputs
import fairing
import hard_inputs
import shapes
from curves import FloatArray
from hard_inputs import WAYS, Input
from solving import codes

CAP = shapes.cap(60)
CLEAN = hard_inputs.of_patch(CAP)
D = CAP.diameter
in_all_ways = pytest.mark.parametrize(("method", "kind"), WAYS, ids=["-".join(way) for way in WAYS])


def off_the_sphere(vertices: FloatArray) -> float:
    """Largest distance of a vertex from the unit sphere: a share of its radius."""
    return float(np.abs(np.linalg.norm(vertices, axis=1) - 1).max())


@in_all_ways
def test_outlines_without_length_or_area_do_no_harm(method: str, kind: str) -> None:
    """Two outline vertices at one place; an ear of three in a line, whose middle dents the sphere by 0.014."""
    edge = hard_inputs.collapsed_outline_edge(CAP).fair(method=method, inner_fairness=kind)
    ear = hard_inputs.flat_ear(CAP).fair(method=method, inner_fairness=kind)
    limit = 4e-2 if method == "paper" else 5e-6
    assert off_the_sphere(edge.vertices) < limit
    assert off_the_sphere(ear.vertices[CAP.free]) < (4e-2 if method == "paper" else 1.4e-2)
    for result in (edge, ear):
        assert "DEGENERATE_FACE" in codes(result)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_surroundings_with_a_corner_at_infinity(value: float) -> None:
    """Triangles that reach there say nothing about the outline: as if they weren't there."""
    vertices, triangles, equator = bad_inputs.closed_ball(60)
    below = triangles[vertices[triangles].mean(axis=1)[:, 2] < 0]
    far = below[~np.isin(below, equator).any(axis=1)][0, 0]
    spoilt = vertices.copy()
    spoilt[far] = value
    normals, fitted = fairing.surrounding_normals(spoilt, below, equator)
    expected, _ = fairing.surrounding_normals(vertices, below[(below != far).all(axis=1)], equator)
    assert fitted.any()
    assert np.array_equal(normals, expected)


@in_all_ways
@pytest.mark.parametrize("scale", [1e-9, 1e9])
def test_scale_and_offset(scale: float, method: str, kind: str) -> None:
    control = CLEAN.fair(method=method, inner_fairness=kind)
    scaled = CLEAN.changed(vertices=scale * CAP.vertices, reference=scale * CAP.vertices)
    result = scaled.fair(method=method, inner_fairness=kind)
    assert np.abs(result.vertices / scale - control.vertices).max() < 1e-6 * D
    assert codes(result) == codes(control)
    moved = CLEAN.changed(vertices=CAP.vertices + 1e6, reference=CAP.vertices + 1e6)
    result = moved.fair(method=method, inner_fairness=kind)
    assert np.abs(result.vertices - 1e6 - control.vertices).max() < 1e-6 * D
    assert codes(result) == codes(control)


@pytest.mark.parametrize("method", ["global", "paper"])
@pytest.mark.parametrize("scale", [1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300])
def test_scales_whose_squares_are_no_numbers(scale: float, method: str) -> None:
    """H of the result included, in units of 1/scale."""
    control = CLEAN.fair(method=method)
    result = CLEAN.changed(vertices=scale * CAP.vertices, reference=None).fair(method=method)
    assert np.abs(result.vertices / scale - control.vertices).max() < 1e-6 * D
    assert result.converged
    assert codes(result) == codes(control)


@pytest.mark.parametrize("method", ["global", "paper"])
def test_coordinates_whose_sums_are_no_numbers_are_refused(method: str) -> None:
    with pytest.raises(fairing.MeshError) as caught:
        CLEAN.changed(vertices=1e308 * CAP.vertices, reference=None).fair(method=method)
    assert caught.value.code == "NONFINITE"
    assert set(caught.value.elements) == set(CAP.fixed)


def squeezed(ratio: float) -> Input:
    """A plane's patch stretched along x: slivers of the given aspect, outline included."""
    patch = shapes.plane(150)
    long = int(np.argmax(np.ptp(patch.vertices, axis=0)))
    stretch = np.ones(3)
    stretch[long] = ratio
    vertices = patch.vertices * stretch
    return Input(vertices, patch.triangles, patch.fixed, patch.fixed_normals, vertices)


@in_all_ways
@pytest.mark.parametrize("ratio", [1e2, 1e4])
def test_slivers_all_over(ratio: float, method: str, kind: str) -> None:
    """A plane of slivers: the plane, or it says that it isn't."""
    item = squeezed(ratio)
    result = item.fair(method=method, inner_fairness=kind)
    flat = int(np.argmin(np.ptp(item.vertices, axis=0)))
    assert np.ptp(result.vertices[:, flat]) < 1e-9 * ratio or not result.converged
    assert result.converged or method == "paper"
    assert ("NOT_CONVERGED" in codes(result)) == (not result.converged)


@in_all_ways
@pytest.mark.parametrize("ratio", [1e2, 1e4, 1e8])
def test_needles_in_the_reference(ratio: float, method: str, kind: str) -> None:
    """One edge of M0 shorter than its neighbours by that ratio: the published iteration may not bear its weights."""
    result = hard_inputs.needle(CAP, ratio).fair(method=method, inner_fairness=kind)
    if method == "global":
        assert result.converged
        assert off_the_sphere(result.vertices) < 5e-6
    assert not result.converged or off_the_sphere(result.vertices) < 4e-2
    assert ("NOT_CONVERGED" in codes(result)) == (not result.converged)


@in_all_ways
def test_a_creased_outline_is_reported(method: str, kind: str) -> None:
    """Normals that jump by 140° where the outline crosses a crease: which vertices, and how well they were met."""
    result = hard_inputs.creased(shapes.plane(150)).fair(method=method, inner_fairness=kind)
    (warning,) = (w for w in result.warnings if w.code == "SHARP_BOUNDARY")
    assert "140°" in warning.message
    assert len(warning.elements) == 4
    assert np.isfinite(result.boundary_angle).all()
    assert result.boundary_angle.max() > 1.0
