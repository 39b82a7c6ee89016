"""`fairing.mean_curvature`: sign, exactness on spheres, consistency on irregular meshes."""

from __future__ import annotations

import numpy as np
import pytest

import fairing
import measures
import shapes
from bad_inputs import ball_of_meridians
from curves import FloatArray
from shapes import Patch, Style

STYLES = {
    "jittered": Style(),
    "valence 3": Style(valence3=0.2),
    "flipped": Style(flips=0.2),
    "random": Style(layout="random"),
}


def curvature(patch: Patch, **options: str) -> FloatArray:
    return fairing.mean_curvature(
        patch.vertices, patch.triangles,
        fixed=patch.fixed, fixed_normals=patch.fixed_normals, **options,
    )  # fmt: skip


def typical_error(patch: Patch, **options: str) -> float:
    """Exceeded at a tenth of the free vertices, relative to the largest exact curvature.

    Not the maximum: a few rings of three or four slivers have errors that do not shrink.
    """
    error = np.abs(curvature(patch, **options) - patch.mean_curvature)[patch.free]
    return float(np.quantile(error, 0.9) / np.abs(patch.mean_curvature).max())


@pytest.mark.parametrize("style", STYLES)
def test_exact_on_spheres_at_every_vertex(style: str) -> None:
    """Max's normal is exact there, so is every κ_j; 1e-9 is the regularisation of the fit."""
    patch = shapes.cap(500, STYLES[style], radius=2.0)
    assert np.abs(curvature(patch) + 0.5).max() < 1e-7


def test_zero_on_planes() -> None:
    assert np.abs(curvature(shapes.plane(300))).max() < 1e-12


def test_sign_follows_the_side_of_the_normals() -> None:
    patch = shapes.cylinder(500)
    inward = fairing.mean_curvature(
        patch.vertices, patch.triangles[:, ::-1],
        fixed=patch.fixed, fixed_normals=-patch.fixed_normals,
    )  # fmt: skip
    assert curvature(patch).mean() == pytest.approx(-0.5, abs=0.02)
    assert np.abs(inward + curvature(patch)).max() < 1e-9


def test_scales_with_the_inverse_length() -> None:
    patch = shapes.catenoid(300)
    larger = fairing.mean_curvature(
        1e3 * patch.vertices, patch.triangles,
        fixed=patch.fixed, fixed_normals=patch.fixed_normals,
    )  # fmt: skip
    assert np.abs(1e3 * larger - curvature(patch)).max() < 1e-9


@pytest.mark.parametrize("exponent", [-460, -40, 40, 460])
def test_the_smallest_and_the_largest_meshes_have_the_same_bits(exponent: int) -> None:
    """Scaled by a power of two, by up to 1e-138 and 1e138: squares of areas are no numbers there."""
    vertices, triangles = ball_of_meridians(12, 8)
    scale = 2.0**exponent
    np.testing.assert_array_equal(
        fairing.mean_curvature(scale * vertices, triangles) * scale, fairing.mean_curvature(vertices, triangles)
    )


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("name", ["cylinder", "unduloid", "linear_flux", "torus", "clothoid"])
def test_error_falls_with_the_edge_length(name: str, style: str) -> None:
    """First order, second where H is constant along a ruling; averaged normals: order 0."""
    coarse, fine = (getattr(shapes, name)(n, STYLES[style]) for n in (500, 4000))
    errors = typical_error(coarse), typical_error(fine)
    order = measures.observed_order((len(coarse.free), len(fine.free)), errors)
    assert order > (1.6 if name == "cylinder" else 0.8)
    assert errors[1] < 0.02
