"""What the equation on the mesh given adds to the surface that a mesh of the engine's own found: method/polish."""

import pytest

import fairing
import graded
import shapes
from shapes import Patch, Style


def solved(patch: Patch, weights: str = "uniform") -> fairing.FairResult:
    """From its outline, to many digits."""
    return fairing.fair(
        shapes.start_from_nothing(patch), patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        reference=patch.vertices, inner_fairness=weights, tolerance=1e-10,
    )  # fmt: skip


@pytest.mark.parametrize("half_angle", [130.0, 140.0])
def test_deep_caps_are_polished(half_angle: float) -> None:
    """Their vertices slide by .1 to .2 D along the sphere and end on it to eight digits; placed ones are 1e-5 off."""
    for seed in range(3):
        cap = shapes.cap(1500, Style(seed=seed), half_angle=half_angle)
        result = solved(cap)
        assert result.converged
        assert cap.error(result.vertices) < 1e-8


@pytest.mark.parametrize("weights", ["conformal", "shape_preserving"])
def test_graded_meshes_do_not_overrule_a_finer_one(weights: str) -> None:
    """On the mesh given the catenoid is off by 2.8e-4, on an even one by 3e-5 and 4e-5."""
    catenoid = graded.regraded(shapes.catenoid(60), 1000)
    result = solved(catenoid, weights)
    assert result.converged
    assert not result.polished
    assert catenoid.error(result.vertices) < 1e-4
