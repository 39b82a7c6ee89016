"""What a fillet would look like while the mouse is followed; the mesh itself stays as it is."""

from __future__ import annotations

from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..host.status import redraw_views
from . import operator as fillet
from .rounding import Rounded

_COLOUR = np.array([0.95, 0.62, 0.25])  # lit from the upper left of the world
_LIGHT = np.array([0.4, -0.5, 0.77])
_batches: list[Any] = []
_handles: list[Any] = []


def register() -> None:
    """Draw what runs by the mouse come to."""
    fillet.previews.append(_take)
    if not bpy.app.background:
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW"))


def unregister() -> None:
    """Draw nothing any more."""
    fillet.previews.remove(_take)
    _batches.clear()
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")


def colours(points: Any, triangles: Any) -> Any:
    """Return (3 m, 4): one shade for each triangle."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    light = 0.55 + 0.45 * np.clip(normals @ _LIGHT, -1.0, 1.0)
    shades = np.column_stack([light[:, None] * _COLOUR, np.ones(len(light))])
    return np.repeat(shades, 3, axis=0).astype(np.float32)


def _take(outcomes: list[Rounded]) -> None:
    _batches.clear()
    if _handles:
        shader = gpu.shader.from_builtin("FLAT_COLOR")
        for outcome in outcomes:
            points, triangles = outcome.surface
            places = points[triangles].reshape(-1, 3).astype(np.float32)
            _batches.append(batch_for_shader(shader, "TRIS", {"pos": places, "color": colours(points, triangles)}))
    redraw_views(bpy.context)


def _draw() -> None:
    """In front of the old edge, which the fillet takes away: its far sides are left out instead."""
    if not _batches:
        return
    gpu.state.depth_test_set("NONE")
    gpu.state.face_culling_set("BACK")
    shader = gpu.shader.from_builtin("FLAT_COLOR")
    for batch in _batches:
        batch.draw(shader)
    gpu.state.face_culling_set("NONE")
