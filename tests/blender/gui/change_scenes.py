"""What changes in the redo panel are played on, beside Fair Region's: holes, edges to round, wires, roughness."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

import scenes


def _edit(mode: tuple[bool, bool, bool]) -> Any:
    bpy.context.tool_settings.mesh_select_mode = mode
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    return bmesh.from_edit_mesh(bpy.context.object.data)


def _begin(bm: Any) -> None:
    bm.select_flush_mode()
    bmesh.update_edit_mesh(bpy.context.object.data)
    bpy.ops.ed.undo_push(message="scene")
    scenes.keep_original()


def hole(subdivisions: int) -> None:
    """A ball without a cap, the border selected: 5: some 600 new vertices, 6: 2,400, 7: 10,000."""
    scenes.clear()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    bm = _edit((True, False, False))
    bmesh.ops.delete(bm, geom=[vertex for vertex in bm.verts if vertex.co.z > 0.5], context="VERTS")
    for vertex in bm.verts:
        vertex.select = vertex.is_boundary
    _begin(bm)


def block() -> None:
    """A cube, all edges selected."""
    scenes.clear()
    bpy.ops.mesh.primitive_cube_add()
    bm = _edit((False, True, False))
    for edge in bm.edges:
        edge.select_set(True)
    _begin(bm)


def rings(count: int) -> None:
    """Three circles of so many edges that cross, without faces, all selected."""
    scenes.clear()
    angles = 2.0 * np.pi * np.arange(count) / count
    a, b, nought = np.cos(angles), np.sin(angles), 0.0 * angles
    mesh = bpy.data.meshes.new("Rings")
    obj = bpy.data.objects.new("Rings", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    bm = _edit((False, True, False))
    known: dict[tuple[float, ...], Any] = {}
    for ring in ((a, b, nought), (nought, a, b), (b, nought, a)):
        places = [tuple(np.round(place, 6) + 0.0) for place in np.stack(ring, axis=1)]
        vertices = [known.get(place) or known.setdefault(place, bm.verts.new(place)) for place in places]
        for tail, head in zip(vertices, [*vertices[1:], vertices[0]], strict=True):
            bm.edges.new((tail, head)).select_set(True)
    _begin(bm)


def rough_ball(subdivisions: int) -> None:
    """A ball with noise along the normals, its upper half selected: 6: 5,000 free vertices, 7: 20,000."""
    scenes.clear()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    bm = _edit((False, False, True))
    rng = np.random.default_rng(4)
    for vertex in bm.verts:
        vertex.co *= 1.0 + 0.005 * float(rng.normal())
    for face in bm.faces:
        face.select_set(face.calc_center_median().z > 0.0)
    _begin(bm)
