"""What is odd about an outline is reported, with the largest angle."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import meshes
import numpy as np
from test_restoration import BOUND, off_sphere, spoil, upper_half


def warnings_of(obj: bpy.types.Object, faces: Any) -> str:
    assert meshes.fair(obj, faces, accept="ALL") == {"FINISHED"}
    return str(meshes.report().warnings)


def centre(obj: bpy.types.Object, half: float = 0.7) -> Any:
    return meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < half)


def test_nothing_odd_about_a_flat_grid() -> None:
    obj = meshes.grid()
    assert warnings_of(obj, centre(obj)) == ""


def test_sharp_edge_along_the_outline() -> None:
    """A table's top whose sides hang down at 80°."""
    obj = meshes.grid()
    points = meshes.positions(obj)
    size = np.abs(points[:, :2]).max(axis=1)
    beyond = np.maximum(size - 0.5, 0.0)
    drop = np.radians(80.0)
    shrink = np.where(beyond > 0.0, (0.5 + beyond * np.cos(drop)) / np.maximum(size, 0.5), 1.0)
    points[:, :2] *= shrink[:, None]
    points[:, 2] = -beyond * np.sin(drop)
    meshes.move(obj, points)
    faces = np.array([max(abs(points[v, :2]).max() for v in p.vertices) < 0.51 for p in obj.data.polygons])
    text = warnings_of(obj, faces)
    assert "edge of up to 80°" in text


def test_folded_faces_around_the_outline() -> None:
    obj = meshes.grid()
    points = meshes.positions(obj)
    far = points[:, 0] > 0.9
    points[far, 0] = 0.3  # the outermost column lies under the next one
    points[far, 2] = -0.02
    meshes.move(obj, points)
    assert "folded over by up to 17" in warnings_of(obj, centre(obj))


def test_hole_of_a_single_face() -> None:
    obj = meshes.grid(9)
    hole = meshes.faces_where(obj, lambda c: c.length < 0.05)
    assert hole.sum() == 1
    assert "1 single face is left out" in warnings_of(obj, centre(obj) & ~hole)


def flip_lower_half(obj: bpy.types.Object) -> None:
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bmesh.ops.reverse_faces(bm, faces=[f for f in bm.faces if f.calc_center_median().z < 0.0])
    bm.to_mesh(obj.data)
    bm.free()


def test_surroundings_wound_the_other_way_round() -> None:
    obj = meshes.sphere()
    upper = upper_half(obj)
    spoil(obj, upper)
    flip_lower_half(obj)
    text = warnings_of(obj, upper)
    assert "wound against each other" in text
    assert "48 boundary edges" in text
    # and the surface is the right one all the same
    assert off_sphere(meshes.positions(obj)) < BOUND[48]
