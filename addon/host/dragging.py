"""An operator that follows the mouse: how far a pixel is, and the words in the header."""

from __future__ import annotations

from typing import Any

import bpy
from mathutils import Vector


def pixel_size(context: bpy.types.Context, place: Any) -> float:
    """Return the length of a pixel of the 3D view in world space, at the depth of a place."""
    view, region = context.region_data, context.region
    depth = (view.perspective_matrix @ Vector((*place, 1.0))).w
    return float(2.0 * abs(depth) / (region.width * view.window_matrix[0][0]))


def say(context: bpy.types.Context, text: str | None) -> None:
    """Show a line in the header of the area and in the status bar; None takes it away."""
    if context.area is not None:
        context.area.header_text_set(text)
        context.area.tag_redraw()
    context.workspace.status_text_set(text)
