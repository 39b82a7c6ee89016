"""Where faces lie on a UV map."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..arrays.types import Floats
from ..remesh.uv_overlap import meeting
from .columns import column


def triangles_near(bm: Any, layer: str, box: Floats) -> Floats:
    """Return (t, 3, 2): the triangles on a UV map of all faces of a bmesh whose boxes there meet this one, (2, 2)."""
    copy = bpy.data.meshes.new("fairing texture")
    try:
        bm.to_mesh(copy)  # a million corners are read at once there, and one by one here
        return _triangles(copy, layer, box)
    finally:
        bpy.data.meshes.remove(copy)


def _triangles(mesh: bpy.types.Mesh, layer: str, box: Floats) -> Floats:
    places = column(mesh.uv_layers[layer].uv, "vector", 2, np.float32).astype(np.float64)
    near = meeting(places, column(mesh.polygons, "loop_start", 1, np.int32), box)
    if not near.any():
        return np.empty((0, 3, 2))
    mesh.calc_loop_triangles()
    of = column(mesh.loop_triangles, "polygon_index", 1, np.int32)
    corners = column(mesh.loop_triangles, "loops", 3, np.int32)
    found: Floats = places[corners[near[of]]]
    return found
