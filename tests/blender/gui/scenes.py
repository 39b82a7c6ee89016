"""What the story plays on: Suzanne's ear, and a sphere with many vertices."""

import sys
from itertools import pairwise
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


def keep_original() -> None:
    """Let the scene begin with the positions of now."""
    _original["positions"] = positions()


def contents() -> bytes:
    """Positions, selection and flags, as bytes."""
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    flags = [(f.select, f.hide, f.smooth) for f in bm.faces]
    return positions().tobytes() + repr(flags).encode()


def start(chosen: Any) -> int:
    """Enter edit mode with these polygons selected; return their number."""
    obj = bpy.context.object
    obj.data.shade_smooth()
    obj.data.edges.foreach_set("select", [False] * len(obj.data.edges))
    demo_scenes.select(obj, chosen)
    bpy.ops.ed.undo_push(message="scene")
    keep_original()
    return int(np.count_nonzero(chosen))


def clear() -> None:
    """Remove all objects, from whichever mode."""
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


def ear() -> int:
    """Suzanne, subdivided twice, an ear selected; return the number of faces selected."""
    clear()
    monkey = demo_scenes.suzanne()
    return start(demo_scenes.ear_faces(monkey.data))


def single_face() -> int:
    """Suzanne with one face selected: nothing is free to move."""
    clear()
    monkey = demo_scenes.suzanne()
    return start(np.arange(len(monkey.data.polygons)) == 700)


def _profile(points: list[tuple[float, float]], counts: list[int]) -> Any:
    """Points (k, 2) along a polyline, so many on each of its pieces."""
    pieces = [
        np.linspace(begin, end, count, endpoint=False)
        for (begin, end), count in zip(pairwise(points), counts, strict=True)
    ]
    return np.concatenate([*pieces, [points[-1]]])


def bottle(around: int = 96) -> int:
    """A bottle whose shoulder, some 2k free vertices between body and neck, is selected; return its faces' number."""
    clear()
    profile = _profile([(0.8, -1.3), (0.8, -0.2), (0.3, 0.6), (0.3, 1.3)], [40, 23, 30])
    turns = 2.0 * np.pi * np.arange(around) / around
    points = [(r * np.cos(a), r * np.sin(a), z) for r, z in profile for a in turns]
    faces = [
        (k * around + j, k * around + (j + 1) % around, (k + 1) * around + (j + 1) % around, (k + 1) * around + j)
        for k in range(len(profile) - 1)
        for j in range(around)
    ]
    add("Bottle", points, faces)
    rings = np.arange(len(faces)) // around
    return start((rings >= 40) & (rings < 63))


def hill(size: int = 100) -> int:
    """A plain of size × size quads with its middle selected, some 2k free vertices, the centre in the group "Pin"."""
    clear()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=size, y_subdivisions=size, size=3.0)
    obj = bpy.context.object
    centre = int(np.linalg.norm(demo_scenes.positions(obj.data), axis=1).argmin())
    obj.vertex_groups.new(name="Pin").add([centre], 1.0, "REPLACE")
    centres = np.array([polygon.center for polygon in obj.data.polygons])
    return start(np.linalg.norm(centres[:, :2], axis=1) < 0.8)


def add(name: str, points: Any, faces: Any) -> None:
    """Add a mesh object and make it the active one."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)


def select_vertices(chosen: Any) -> None:
    """Select exactly these vertices (n,) of the mesh in edit mode, and the faces between them."""
    _select((True, False, False), np.flatnonzero(chosen))


def select_faces(chosen: Any) -> None:
    """Select exactly these faces (k,) of the mesh in edit mode."""
    _select((False, False, True), chosen)


def _select(mode: tuple[bool, bool, bool], chosen: Any) -> None:
    bpy.context.tool_settings.mesh_select_mode = mode
    bpy.ops.mesh.select_all(action="DESELECT")
    mesh = bpy.context.object.data
    bm = bmesh.from_edit_mesh(mesh)
    table: Any = bm.verts if mode[0] else bm.faces
    table.ensure_lookup_table()
    for index in chosen.tolist():
        table[index].select = True
    bm.select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    bpy.ops.ed.undo_push(message="selection")


def hopeless(radius: float = 6.0) -> int:
    """150° of a thin torus: the engine looks for a fair surface for seconds, once for each radius."""
    clear()
    bpy.ops.mesh.primitive_torus_add(major_segments=96, minor_segments=24, major_radius=radius, minor_radius=1.0)
    centres = [polygon.center for polygon in bpy.context.object.data.polygons]
    return start(np.array([abs(np.arctan2(centre.y, centre.x)) < np.radians(75.0) for centre in centres]))


def large(subdivisions: int = 7) -> int:
    """A sphere with a dented upper half: 20k free vertices or, by one subdivision less, a fourth of them.

    Return the number of faces selected.
    """
    clear()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
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
    return start(upper[corners.reshape(-1, 3)].all(axis=1))
