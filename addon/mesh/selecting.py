"""What is selected in a mesh in edit mode."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Floats, Ints, Mask


def select_vertices(mesh: bpy.types.Mesh, vertices: Ints) -> None:
    """Select exactly these vertices; nothing else about the mesh changes. Needs vertex mode."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.select_mode = {"VERT"}
    bm.verts.ensure_lookup_table()
    deselect(bm)
    for vertex in vertices.tolist():
        bm.verts[vertex].select = True
    bm.select_flush_mode()
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def surroundings(mesh: bpy.types.Mesh, vertex: int) -> tuple[Floats, Floats, float]:
    """Return the position and the normal (3,) of a vertex in edit mode, and the mean length of its edges."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    table: Any = bm.verts
    found = table[vertex]
    lengths = [edge.calc_length() for edge in found.link_edges]
    return np.array(found.co), np.array(found.normal), float(np.mean(lengths)) if lengths else 0.0


def select_faces(mesh: bpy.types.Mesh, faces: Ints) -> None:
    """Select exactly these faces, as far as they are visible. Needs face mode."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.select_mode = {"FACE"}
    bm.faces.ensure_lookup_table()
    deselect(bm)
    table: Any = bm.faces
    for face in faces.tolist():
        table[face].select_set(not table[face].hide)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def selected_edges(mesh: bpy.types.Mesh) -> Mask:
    """Return the (e,) mask of the selected edges of a mesh in edit mode."""
    return np.array([edge.select for edge in bmesh.from_edit_mesh(mesh).edges], dtype=bool)


def deselect(bm: Any) -> None:
    """Take every vertex, edge and face out of the selection."""
    for element in (*bm.faces, *bm.edges, *bm.verts):
        element.select = False


def select_new_faces(bm: Any, faces: list[Any]) -> None:
    """Select exactly these faces of a bmesh."""
    deselect(bm)
    bm.select_history.clear()
    for face in faces:
        face.select_set(True)


def face_count(mesh: bpy.types.Mesh) -> int:
    return len(bmesh.from_edit_mesh(mesh).faces)


def places(mesh: bpy.types.Mesh, vertices: Ints) -> Floats | None:
    """Return the positions (k, 3) of some vertices in whichever mode, without a copy; None where one is missing."""
    if vertices.max(initial=-1) >= (count(mesh)):
        return None
    if mesh.is_editmode:
        bm = bmesh.from_edit_mesh(mesh)
        bm.verts.ensure_lookup_table()
        table: Any = bm.verts
    else:
        table = mesh.vertices
    return np.array([table[vertex].co for vertex in vertices.tolist()], dtype=np.float64).reshape(-1, 3)


def count(mesh: bpy.types.Mesh) -> int:
    return len(bmesh.from_edit_mesh(mesh).verts) if mesh.is_editmode else len(mesh.vertices)
