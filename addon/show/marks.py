"""Marks in the 3D view: bad vertices of a selection's boundary, and what Live has to say."""

from __future__ import annotations

from typing import Any

import blf
import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..arrays.types import Floats
from ..live.live import live
from ..selection.watch import watch
from ..translations import translated

BAD = (1.0, 0.0, 0.8, 1.0)  # magenta: Blender selects in orange
SAID = (1.0, 1.0, 1.0, 1.0)
SIZE = 9.0  # pixels

Mark = tuple[Floats, tuple[float, float, float, float]]


class _Marks:
    def __init__(self) -> None:
        self.handles: list[Any] = []


_marks = _Marks()


def shown(context: bpy.types.Context) -> list[Mark]:
    """Return points (k, 3) in world space with their colours; none of a selection that has changed since the look."""
    if context.mode != "EDIT_MESH":
        return []
    return [] if watch.stale else [(found.bad, BAD) for found in watch.found if len(found.bad)]


def draw(context: bpy.types.Context) -> None:
    """Draw them over everything, so that none hides behind the mesh."""
    marks = shown(context)
    if not marks:
        return
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    gpu.state.point_size_set(SIZE)
    gpu.state.depth_test_set("NONE")
    for points, colour in marks:
        shader.bind()
        shader.uniform_float("color", colour)
        batch_for_shader(shader, "POINTS", {"pos": points.astype(np.float32)}).draw(shader)
    gpu.state.point_size_set(1.0)


def draw_message(context: bpy.types.Context) -> None:
    """Write what Live has to say into the 3D view, whichever panels are open; none lies over its top."""
    if context.mode != "EDIT_MESH" or not live.message:
        return
    scale = context.preferences.system.ui_scale
    blf.size(0, 13.0 * scale)
    blf.color(0, *SAID)
    blf.position(0, 70.0 * scale, context.region.height - 150.0 * scale, 0.0)  # below the name of the view
    blf.draw(0, translated(live.message))


def _draw() -> None:
    draw(bpy.context)


def _draw_message() -> None:
    draw_message(bpy.context)


def register() -> None:
    if not bpy.app.background:
        add = bpy.types.SpaceView3D.draw_handler_add
        _marks.handles = [add(_draw, (), "WINDOW", "POST_VIEW"), add(_draw_message, (), "WINDOW", "POST_PIXEL")]


def unregister() -> None:
    while _marks.handles:
        bpy.types.SpaceView3D.draw_handler_remove(_marks.handles.pop(), "WINDOW")
