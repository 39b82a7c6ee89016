"""Numbers of vertices and faces as attributes of the mesh."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Floats, Ints, Mask
from ..words.words import said

SCULPT_MASK, FACE_SET = ".sculpt_mask", ".sculpt_face_set"  # Blender's own names of what sculpt mode paints


def values(mesh: bpy.types.Mesh, name: str, dtype: Any) -> Any:
    """Return the values of an attribute of a mesh in object mode; None where there is none."""
    attribute = mesh.attributes.get(name)
    if attribute is None:
        return None
    found = np.empty(len(attribute.data), dtype=dtype)
    attribute.data.foreach_get("value", found)
    return found


def faces_within(mesh: bpy.types.Mesh, vertices: Mask) -> Ints:
    """Return the faces of a mesh in object mode with all vertices in the (n,) mask."""
    starts = np.empty(len(mesh.polygons), dtype=np.int32)
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    mesh.loops.foreach_get("vertex_index", corners)
    if not len(starts):
        return np.empty(0, dtype=np.int64)
    return np.flatnonzero(np.logical_and.reduceat(vertices[corners], starts))


def write_attribute(mesh: bpy.types.Mesh, name: str, values: Floats) -> None:
    """Write one number per vertex (n,) to the vertex attribute `name`, in whichever mode.

    Raises ValueError where the mesh has an attribute of that name for something else.
    """
    present = mesh.attributes.get(name)
    if present is not None and (present.data_type, present.domain) != ("FLOAT", "POINT"):
        raise ValueError(said("other_attribute", name=name))
    if mesh.is_editmode:
        _write_edit_attribute(mesh, name, values)
        return
    layer = present or mesh.attributes.new(name, "FLOAT", "POINT")
    layer.data.foreach_set("value", values.astype(np.float32))
    mesh.update()


def _write_edit_attribute(mesh: bpy.types.Mesh, name: str, values: Floats) -> None:
    bm = bmesh.from_edit_mesh(mesh)
    layers = bm.verts.layers.float
    layer = layers.get(name) or layers.new(name)
    for vertex, value in zip(bm.verts, values.tolist(), strict=True):
        vertex[layer] = value
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
