"""Half an object with a Mirror modifier: selections that its plane cuts are faired with their image."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix

import meshes


def half_dome() -> tuple[bpy.types.Object, meshes.Mask]:
    """The half x ≤ 0 of a dome on a grid, crumpled where it is selected, with a Mirror modifier."""
    steps = np.linspace(-1.0, 1.0, 13)
    points = np.array([(x, y, 0.0) for y in steps for x in steps[:7]])
    x, y = points[:, 0].copy(), points[:, 1].copy()
    points[:, 2] = np.sqrt(4.0 - x**2 - y**2)
    faces = [(k, k + 1, k + 8, k + 7) for k in range(12 * 7) if k % 7 < 6]
    obj = meshes.add(points, faces)
    chosen = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    inside = np.maximum(np.abs(x), np.abs(y)) < 0.6
    points[inside] += np.random.default_rng(5).normal(0.0, 0.03, (int(inside.sum()), 3))
    points[x == 0.0, 0] = 0.0
    meshes.move(obj, points)
    modifier = obj.modifiers.new("Mirror", "MIRROR")
    modifier.use_axis = (True, False, False)
    return obj, chosen


def off_sphere(obj: bpy.types.Object) -> float:
    return float(np.abs(np.linalg.norm(meshes.positions(obj), axis=1) - 2.0).max())


def on_plane(obj: bpy.types.Object) -> Any:
    return meshes.positions(obj).reshape(13, 7, 3)[:, 6]


def test_the_dome_comes_back_over_the_seam() -> None:
    obj, faces = half_dome()
    seam = on_plane(obj)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert off_sphere(obj) < 1e-4
    np.testing.assert_array_equal(on_plane(obj)[:, 0], 0.0)
    np.testing.assert_array_equal(on_plane(obj)[[0, 1, 11, 12]], seam[[0, 1, 11, 12]])
    assert (meshes.report().verdict, meshes.report().free_vertices) == ("GOOD", 4 * 7)


@pytest.mark.parametrize("setting", ["show_viewport", "use_mirror_merge", "use_axis"])
def test_without_a_modifier_that_joins_the_halves_the_seam_stays(setting: str) -> None:
    obj, faces = half_dome()
    setattr(obj.modifiers[0], setting, (False, True, False) if setting == "use_axis" else False)
    seam = on_plane(obj)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    np.testing.assert_array_equal(on_plane(obj), seam)


def test_the_plane_may_be_another_objects() -> None:
    obj, faces = half_dome()
    other = bpy.data.objects.new("Plane", None)
    bpy.context.collection.objects.link(other)
    other.matrix_world = obj.matrix_world = Matrix.LocRotScale((1.0, 2.0, 3.0), Euler((0.3, 0.4, 0.5)), (1.0, 1.0, 1.0))
    obj.modifiers[0].mirror_object = other
    bpy.context.view_layer.update()
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert off_sphere(obj) < 1e-4
    np.testing.assert_allclose(on_plane(obj)[:, 0], 0.0, atol=1e-6)


def test_scripts_get_the_half() -> None:
    obj, faces = half_dome()
    from bl_ext.user_default.intrinsic_fairing import fair_mesh

    result = fair_mesh(obj.data, np.flatnonzero(faces).tolist())
    assert off_sphere(obj) < 1e-4
    corners = {vertex for face in np.flatnonzero(faces) for vertex in obj.data.polygons[face].vertices}
    assert len(result.vertices) == len(corners)


def test_a_new_mesh_tells_of_the_plane() -> None:
    obj, faces = half_dome()
    assert meshes.fair(obj, faces, mesh="NEW") == {"FINISHED"}
    assert "Mirror modifier" in meshes.report().warnings
    assert "open borders" not in meshes.report().warnings
