"""Faces chosen by what is painted on a mesh in object mode: a mask, face sets, a vertex group, the live region."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from ..arrays.types import Floats, Ints
from ..words.words import said
from .columns import FACE_SET, SCULPT_MASK, column, faces_within, indices, values, write_attribute
from .live_mesh import LAYER
from .weights import group_weights

HALF = 0.5  # of the mask, from which on a vertex is masked


def positions(mesh: bpy.types.Mesh) -> Floats:
    found: Floats = column(mesh.vertices, "co", 3, np.float32).astype(np.float64)
    return found


def masked_faces(mesh: bpy.types.Mesh) -> Ints:
    """Return the faces that are masked by half or more at all corners."""
    mask = values(mesh, SCULPT_MASK, np.float32)
    return np.empty(0, dtype=np.int64) if mask is None else faces_within(mesh, mask >= HALF)


def triangles(mesh: bpy.types.Mesh) -> Ints:
    """Return the triangles (t, 3) that Blender makes of the faces."""
    mesh.calc_loop_triangles()
    return indices(mesh.loop_triangles, "vertices", 3)


def protected(mesh: bpy.types.Mesh) -> Floats:
    """Return how much of each vertex (n,) the mask leaves to brushes."""
    mask = values(mesh, SCULPT_MASK, np.float32)
    return np.ones(len(mesh.vertices)) if mask is None else 1.0 - np.clip(mask.astype(np.float64), 0.0, 1.0)


@contextmanager
def masked_by(mesh: bpy.types.Mesh, weights: Floats) -> Iterator[None]:
    """Give the mesh in object mode this mask (n,) for a while."""
    before = values(mesh, SCULPT_MASK, np.float32)
    write_attribute(mesh, SCULPT_MASK, weights)
    try:
        yield
    finally:
        if before is None:
            mesh.attributes.remove(mesh.attributes[SCULPT_MASK])
        else:
            write_attribute(mesh, SCULPT_MASK, before)


def face_set(mesh: bpy.types.Mesh, number: int) -> Ints:
    sets = values(mesh, FACE_SET, np.int32)
    return np.empty(0, dtype=np.int64) if sets is None else np.flatnonzero(sets == number)


def face_set_at(mesh: bpy.types.Mesh, face: int) -> int:
    """Return the number of the face set that a face is in; 0 without face sets."""
    sets = values(mesh, FACE_SET, np.int32)
    return 0 if sets is None else int(sets[face])


def only_visible_face_set(mesh: bpy.types.Mesh) -> int:
    """Return the number of the face set that all visible faces are in; 0 where they are in several."""
    sets = values(mesh, FACE_SET, np.int32)
    if sets is None:
        return 0
    shown = np.unique(sets[~column(mesh.polygons, "hide", 1, bool)])
    return int(shown[0]) if len(shown) == 1 else 0


def group_faces(obj: bpy.types.Object, name: str) -> Ints:
    """Return the faces with all vertices in a vertex group; raises ValueError where there is none of that name."""
    if name not in obj.vertex_groups:
        raise ValueError(said("no_group", name=name))
    return faces_within(obj.data, group_weights(obj.data, obj.vertex_groups[name].index) > 0.0)


def live_faces(mesh: bpy.types.Mesh) -> Ints:
    region = values(mesh, LAYER, np.int32)
    return np.empty(0, dtype=np.int64) if region is None else np.flatnonzero(region)
