"""What the story plays on: Suzanne's ear, and a sphere with many vertices."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "scripts"))

import demo_scenes

_original: dict[str, Any] = {}


def positions() -> Any:
    """The positions of the mesh in edit mode."""
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    return np.array([v.co for v in bm.verts])


def original() -> Any:
    """The positions that the scene began with."""
    return _original["positions"]


def contents() -> bytes:
    """Positions, selection and flags, as bytes."""
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    flags = [(f.select, f.hide, f.smooth) for f in bm.faces]
    return positions().tobytes() + repr(flags).encode()


def _start(chosen: Any) -> int:
    """Enter edit mode with these polygons selected; return their number."""
    obj = bpy.context.object
    obj.data.shade_smooth()
    obj.data.edges.foreach_set("select", [False] * len(obj.data.edges))
    demo_scenes.select(obj, chosen)
    bpy.ops.ed.undo_push(message="scene")
    _original["positions"] = positions()
    return int(np.count_nonzero(chosen))


def _clear() -> None:
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


def ear() -> int:
    """Suzanne, subdivided twice, an ear selected; return the number of faces selected."""
    _clear()
    monkey = demo_scenes.suzanne()
    return _start(demo_scenes.ear_faces(monkey.data))


def single_face() -> int:
    """Suzanne with one face selected: nothing is free to move."""
    _clear()
    monkey = demo_scenes.suzanne()
    return _start(np.arange(len(monkey.data.polygons)) == 700)


def large() -> int:
    """A sphere of 98k faces with a dented upper half; return the number of faces selected."""
    _clear()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7)
    mesh = bpy.context.object.data
    points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3)
    points[points[:, 2] > 0.3, 2] *= 0.6
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.update()
    upper = points[:, 2] > 0.01
    corners = np.empty(3 * len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("vertices", corners)
    return _start(upper[corners.reshape(-1, 3)].all(axis=1))
