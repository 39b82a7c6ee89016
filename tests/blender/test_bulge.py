"""The bulge slider: the same dome whatever the disc's size and orientation."""

from __future__ import annotations

from typing import Any

import bpy
import meshes
import numpy as np
import pytest
from mathutils import Euler, Matrix

RINGS, SECTORS = 14, 36
# The radial equation of a loaded disc gives this share of its radius (tests/test_equations.py);
# linear theory says 0.25.
LIFT = 0.3127


def disc(size: float) -> tuple[bpy.types.Object, meshes.Mask]:
    """Flat rings of quads around a fan of triangles, and which of its faces lie within radius `size`."""
    angles = np.linspace(0.0, 2 * np.pi, SECTORS, endpoint=False)
    ring = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(SECTORS)])
    points = np.vstack([np.zeros((1, 3)), *(ring * (size * (k + 1) / 10) for k in range(RINGS))])

    def at(k: int, j: int) -> int:
        return 1 + k * SECTORS + j % SECTORS

    fan = [[0, at(0, j), at(0, j + 1)] for j in range(SECTORS)]
    quads = [[at(k, j), at(k + 1, j), at(k + 1, j + 1), at(k, j + 1)] for k in range(RINGS - 1) for j in range(SECTORS)]
    obj = meshes.add(points, fan + quads, "Disc")
    return obj, meshes.faces_where(obj, lambda centre: centre.length < size)


@pytest.mark.parametrize(("size", "bulge"), [(1.0, 1.0), (1.0, -1.0), (250.0, 1.0), (0.02, 1.0)])
def test_bulge_of_one_lifts_a_disc_of_any_size(size: float, bulge: float) -> None:
    obj, faces = disc(size)
    obj.matrix_world = Matrix.LocRotScale((3.0, 1.0, -2.0), Euler((0.4, 1.0, -0.7)), (1.0, 1.0, 1.0))
    bpy.context.view_layer.update()
    meshes.fair(obj, faces, equation="CONSTANT", bulge=bulge)
    assert meshes.report().converged
    height: Any = meshes.positions(obj)[:, 2] / size
    peak = height[np.abs(height).argmax()]
    assert peak == pytest.approx(bulge * LIFT, abs=0.025)  # ten rings: second order, 0.020 off


def test_no_bulge_is_harmonic() -> None:
    obj, faces = disc(1.0)
    meshes.fair(obj, faces, equation="CONSTANT", bulge=0.0)
    assert np.abs(meshes.positions(obj)[:, 2]).max() < 1e-6


def test_a_bulge_that_no_surface_has_is_explained() -> None:
    obj = meshes.sphere(48)
    faces = meshes.faces_where(obj, lambda centre: centre.z > 0.0)
    with pytest.raises(RuntimeError, match="of its bulge"):
        meshes.fair(obj, faces, equation="CONSTANT", bulge=0.3)
    assert not meshes.report().converged
    assert "no surface with a bulge of 0.3" in meshes.report().warnings
