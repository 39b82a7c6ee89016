"""`fairing.vertex_normals`: the averaged kind by definition, the fitted kind by its accuracy."""

from __future__ import annotations

import numpy as np
import pytest

import fairing
import measures
import shapes
from curves import FloatArray
from meshing import face_normals
from shapes import Patch, Style


def angle_errors(patch: Patch, kind: str, rings: int = 0) -> FloatArray:
    """Angles to the exact normals further than this many rings from the border, radians."""
    normals = fairing.vertex_normals(patch.vertices, patch.triangles, normals=kind)
    cross = np.cross(normals, patch.normals)
    return np.asarray(np.arcsin(np.minimum(np.linalg.norm(cross, axis=1), 1.0)))[
        measures.beyond_rings(patch.triangles, patch.fixed, rings)
    ]


@pytest.mark.parametrize("kind", ["fitted", "averaged"])
def test_unit_length_and_side(kind: str) -> None:
    patch = shapes.torus(500)
    normals = fairing.vertex_normals(patch.vertices, patch.triangles, normals=kind)
    assert normals.shape == patch.vertices.shape
    assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 1e-12
    assert (normals * patch.normals).sum(axis=1).min() > 0.9
    turned = fairing.vertex_normals(patch.vertices, patch.triangles[:, ::-1], normals=kind)
    assert np.abs(turned + normals).max() < 1e-9


def test_averaged_is_the_normalised_sum_of_cross_products() -> None:
    patch = shapes.torus(500)
    total = np.zeros_like(patch.vertices)
    for corner in range(3):
        np.add.at(total, patch.triangles[:, corner], face_normals(patch.vertices, patch.triangles))
    expected = total / np.linalg.norm(total, axis=1)[:, None]
    result = fairing.vertex_normals(patch.vertices, patch.triangles, normals="averaged")
    assert np.abs(result - expected).max() < 1e-12


@pytest.mark.parametrize("style", [Style(), Style(valence3=0.2), Style(layout="random")])
def test_fitted_is_exact_on_spheres(style: Style) -> None:
    """Away from the border, whose own normals are one-sided fits that neighbours may use."""
    assert angle_errors(shapes.cap(500, style), "fitted", rings=2).max() < 1e-8


@pytest.mark.parametrize("name", ["cylinder", "catenoid", "torus", "clothoid"])
def test_fitted_is_of_second_order(name: str) -> None:
    """Order above 1.5 in the rms; averaged normals reach 1 on irregular meshes."""
    coarse, fine = (getattr(shapes, name)(n) for n in (500, 4000))
    errors = [float(np.sqrt((angle_errors(p, "fitted") ** 2).mean())) for p in (coarse, fine)]
    order = measures.observed_order((len(coarse.free), len(fine.free)), (errors[0], errors[1]))
    assert order > 1.5
    averaged = float(np.sqrt((angle_errors(fine, "averaged") ** 2).mean()))
    assert errors[1] < 0.2 * averaged


def test_border_normals_are_on_the_right_side() -> None:
    patch = shapes.cap(1000)
    normals = fairing.vertex_normals(patch.vertices, patch.triangles)
    cosine = (normals * patch.normals).sum(axis=1)[patch.fixed]
    assert cosine.min() > np.cos(np.radians(10))
