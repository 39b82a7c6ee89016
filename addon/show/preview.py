"""Triangles over the mesh: what a brush has painted so far, what a fillet would look like. The mesh stays as it is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..arrays.types import Floats, Ints
from ..host.status import redraw_views

COLOUR = (0.95, 0.62, 0.25)
_LIGHT = np.array([0.4, -0.5, 0.77])  # from the upper left of the world

_batches: list[Any] = []
_handles: list[Any] = []


def register() -> None:
    if not bpy.app.background:
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW"))


def unregister() -> None:
    _batches.clear()
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")


def show(surfaces: Sequence[tuple[Floats, Ints, Floats]]) -> None:
    """Show these alone: places (n, 3) in world space, triangles (t, 3), and how opaque they are at the places (n,)."""
    _batches.clear()
    for places, triangles, weights in surfaces if _handles else ():
        corners = places[triangles]
        colours = np.column_stack([shades(corners), weights[triangles.ravel()]]).astype(np.float32)
        content = {"pos": corners.reshape(-1, 3).astype(np.float32), "color": colours}
        _batches.append(batch_for_shader(gpu.shader.from_builtin("SMOOTH_COLOR"), "TRIS", content))
    redraw_views(bpy.context)


def shades(corners: Floats) -> Floats:
    """Return the colours (3 t, 3) of the corners of triangles (t, 3, 3): one shade for each triangle."""
    a, b, c = (corners[:, k] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    light = 0.55 + 0.45 * np.clip(normals @ _LIGHT, -1.0, 1.0)
    found: Floats = np.repeat(np.outer(light, COLOUR), 3, axis=0)
    return found


def _draw() -> None:
    """In front of the surface, or of an old edge that is to go: far sides are left out instead."""
    if not _batches:
        return
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("NONE")
    gpu.state.face_culling_set("BACK")
    for batch in _batches:
        batch.draw(gpu.shader.from_builtin("SMOOTH_COLOR"))
    gpu.state.face_culling_set("NONE")
    gpu.state.blend_set("NONE")
