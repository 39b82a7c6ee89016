"""What is odd about an outline is reported, with the largest angle."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import meshes
from test_restoration import BOUND, off_sphere, spoil, upper_half


def warnings_of(obj: bpy.types.Object, faces: Any) -> str:
    assert meshes.fair(obj, faces, accept="ALL") == {"FINISHED"}
    return str(meshes.report().warnings)


def centre(obj: bpy.types.Object, half: float = 0.7) -> Any:
    return meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < half)


def test_nothing_odd_about_a_flat_grid() -> None:
    obj = meshes.grid()
    assert warnings_of(obj, centre(obj)) == ""


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
    assert "48 outline edges" in text
    # and the surface is the right one all the same
    assert off_sphere(meshes.positions(obj)) < BOUND[48]
