"""X mirror: a symmetric selection gives an exactly symmetric result."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix

import meshes


def symmetric_dome() -> tuple[bpy.types.Object, meshes.Mask]:
    """A grid whose outside is symmetric to the bit and whose inside is not."""
    obj = meshes.grid(12)
    points = meshes.positions(obj)
    x, y = points[:, 0].copy(), points[:, 1].copy()
    points[:, 2] = 0.3 * np.cos(2.0 * np.abs(x)) + 0.1 * np.sin(4.0 * y) + 0.05 * y**2
    points[:, 0] = np.sign(x) * np.abs(x)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    free = meshes.free_vertices(obj, faces)
    points[free] += np.random.default_rng(5).normal(0.0, 0.05, (int(free.sum()), 3))
    meshes.move(obj, _even(points, free))
    return obj, faces


def _even(points: Any, free: Any) -> Any:
    """Make the fixed vertices exactly symmetric; rows of the grid run along x."""
    rows = points.astype(np.float32).astype(np.float64).reshape(13, 13, 3)
    mirrored = rows[:, ::-1] * (-1.0, 1.0, 1.0)
    columns = np.arange(13)
    even = np.where((columns > 6)[None, :, None], mirrored, rows)
    even[:, 6, 0] = 0.0
    return np.where(free[:, None], points, even.reshape(-1, 3))


def asymmetry(obj: bpy.types.Object) -> float:
    rows = meshes.positions(obj).reshape(13, 13, 3)
    return float(np.abs(rows - rows[:, ::-1] * (-1.0, 1.0, 1.0)).max())


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (2.0, 0.5, 1.0), (-1.0, 1.0, 1.0)])
def test_result_is_symmetric_to_the_bit(scale: tuple[float, float, float]) -> None:
    obj, faces = symmetric_dome()
    obj.matrix_world = Matrix.LocRotScale((1.0, 2.0, 3.0), Euler((0.3, 0.4, 0.5)), scale)
    bpy.context.view_layer.update()
    obj.data.use_mirror_x = True
    assert asymmetry(obj) > 0.05
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert asymmetry(obj) == 0.0
    assert "mirror" not in meshes.report().warnings
