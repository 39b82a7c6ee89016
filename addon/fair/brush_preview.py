"""What a brush has painted so far, over the surface."""

from __future__ import annotations

from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..arrays.types import Floats, Ints

COLOUR = (0.95, 0.62, 0.25)
FULL = 0.6  # opacity where all is painted

_batches: list[Any] = []
_handles: list[Any] = []


def register() -> None:
    if not bpy.app.background:
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW"))


def unregister() -> None:
    _batches.clear()
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")


def show(places: Floats, triangles: Ints, weights: Floats) -> None:
    """Show places (n, 3) in world space, triangles (t, 3), weights (n,); no triangles: nothing any more."""
    _batches.clear()
    if _handles and len(triangles):
        colours = np.column_stack([np.tile(COLOUR, (len(weights), 1)), FULL * weights]).astype(np.float32)
        content = {"pos": places.astype(np.float32), "color": colours}
        shader = gpu.shader.from_builtin("SMOOTH_COLOR")
        _batches.append(batch_for_shader(shader, "TRIS", content, indices=triangles.astype(np.int32)))


def _draw() -> None:
    if not _batches:
        return
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    for batch in _batches:
        batch.draw(gpu.shader.from_builtin("SMOOTH_COLOR"))
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")
