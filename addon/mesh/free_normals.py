"""Free custom normals, which Blender 5 keeps as plain vectors: new faces and moved ones get their own surface's.

Those kept as two angles turn with the surface by themselves, and new corners have none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Floats, Ints
from .columns import column, elements_of

NAME = "custom_normal"

# What Blender shades with, by the sequence that has the attribute.
_SHADING = {"verts": "vertex_normals", "faces": "polygon_normals", "loops": "corner_normals"}
_DOMAINS = {"POINT": "verts", "FACE": "faces", "CORNER": "loops"}


def renew(bm: Any, vertices: Sequence[Any], faces: Sequence[Any]) -> None:
    """Give these vertices, or faces, or their corners the normals that the surface has without any custom ones."""
    found = _layer(bm)
    if found is not None:
        _write(bm, found, (vertices, faces), _shaded(bm, found[0]))


def renew_at(bm: Any, moved: Ints) -> None:
    """Do so for vertices (k,) that have moved, and the faces at them; their lookup table is up to date."""
    if _layer(bm) is not None:
        vertices = elements_of(bm.verts, moved)
        renew(bm, vertices, _faces_at(vertices))


def put_at(bm: Any, moved: Ints, values: Floats) -> None:
    """Write the free normals (n, 3) that the mesh had before these vertices (k,) were moved."""
    found = _layer(bm)
    if found is not None:
        vertices = elements_of(bm.verts, moved)
        _write(bm, found, (vertices, _faces_at(vertices)), values)


def free_normals(mesh: bpy.types.Mesh) -> Floats | None:
    """Return the (n, 3) free normals of a mesh in whichever mode; None where it has none."""
    attribute = mesh.attributes.get(NAME)
    if attribute is None or attribute.data_type != "FLOAT_VECTOR":
        return None
    if not mesh.is_editmode:
        normals: Floats = column(attribute.data, "vector", 3, np.float32)
        return normals
    with _copied(bmesh.from_edit_mesh(mesh)) as copy:
        return free_normals(copy)


def renew_mesh(mesh: bpy.types.Mesh, moved: Ints) -> None:
    """Do as `renew_at` in a mesh in object mode, by the numbers of the vertices."""
    attribute = mesh.attributes.get(NAME)
    if attribute is None or attribute.data_type != "FLOAT_VECTOR" or attribute.domain not in _DOMAINS:
        return
    touched = np.zeros(len(mesh.vertices), dtype=bool)
    touched[moved] = True
    sizes = column(mesh.polygons, "loop_total", 1, np.int32)
    faces = np.zeros(len(sizes), dtype=bool)
    faces[np.repeat(np.arange(len(sizes)), sizes)[touched[column(mesh.loops, "vertex_index", 1, np.int32)]]] = True
    chosen = {"verts": touched, "faces": faces, "loops": np.repeat(faces, sizes)}[_DOMAINS[attribute.domain]]
    normals = column(attribute.data, "vector", 3, np.float32)
    copy = mesh.copy()
    try:
        normals[chosen] = _shading_of(copy, _DOMAINS[attribute.domain])[chosen]
    finally:
        bpy.data.meshes.remove(copy)
    mesh.attributes[NAME].data.foreach_set("vector", normals.ravel())


def _faces_at(vertices: Sequence[Any]) -> list[Any]:
    """Return the faces at some vertices of a bmesh, each once."""
    return list(dict.fromkeys(face for vertex in vertices for face in vertex.link_faces))


def _layer(bm: Any) -> tuple[str, Any] | None:
    """Return the sequence whose elements have the attribute, and its layer."""
    for sequence in _SHADING:
        layer = getattr(bm, sequence).layers.float_vector.get(NAME)
        if layer is not None:
            return sequence, layer
    return None


def _write(bm: Any, found: tuple[str, Any], of: tuple[Sequence[Any], Sequence[Any]], values: Floats) -> None:
    """Write to these vertices, or faces, or their corners what the values of all elements (n, 3) say."""
    sequence, layer = found
    vertices, faces = of
    for table in (bm.verts, bm.faces):
        table.index_update()
    elements: list[Any]
    if sequence == "loops":
        starts = np.cumsum([0, *(len(face.verts) for face in bm.faces)]).tolist()
        elements = [corner for face in faces for corner in face.loops]
        numbers = [starts[face.index] + k for face in faces for k in range(len(face.verts))]
    else:
        elements = list(vertices if sequence == "verts" else faces)
        numbers = [element.index for element in elements]
    for element, normal in zip(elements, values[numbers].tolist(), strict=True):
        element[layer] = normal


def _shaded(bm: Any, sequence: str) -> Floats:
    """Return the (n, 3) normals of all elements."""
    with _copied(bm) as copy:
        return _shading_of(copy, sequence)


def _shading_of(copy: bpy.types.Mesh, sequence: str) -> Floats:
    """Return them for a mesh in object mode, which loses its own."""
    copy.attributes.remove(copy.attributes[NAME])
    normals: Floats = column(getattr(copy, _SHADING[sequence]), "vector", 3, np.float32)
    return normals


@contextmanager
def _copied(bm: Any) -> Iterator[bpy.types.Mesh]:
    copy = bpy.data.meshes.new("fairing shading")
    try:
        bm.to_mesh(copy)
        yield copy
    finally:
        bpy.data.meshes.remove(copy)
