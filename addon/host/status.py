"""Progress where the user looks: mouse pointer, status bar, sidebar."""

from typing import Any

import bpy
from mathutils import Vector

from ..translations import translated
from .text import TAB

CANCEL = "mesh.fair_cancel"
ASKEW = 0.5  # cosine between the view and a surface's normal, below which little can be seen of the surface


def show_progress(context: bpy.types.Context, fraction: float, stage: str) -> None:
    """Show how far a run is; the pointer's counter must have begun."""
    progress = context.window_manager.fairing_progress
    progress.running, progress.fraction, progress.stage = True, fraction, stage
    context.window_manager.progress_update(fraction)
    context.workspace.status_text_set(_draw_status)
    redraw_sidebars(context)


def show_following(context: bpy.types.Context, fraction: float) -> None:
    """Show in the sidebar how far a search is that Blender doesn't wait for."""
    progress = context.window_manager.fairing_progress
    progress.following, progress.fraction = True, fraction
    redraw_sidebars(context)


def hide_following(context: bpy.types.Context) -> None:
    context.window_manager.fairing_progress.following = False
    redraw_sidebars(context)


def draw_progress(layout: Any, context: bpy.types.Context) -> None:
    """Draw how far the run is, and the button that cancels it."""
    fraction = context.window_manager.fairing_progress.fraction
    layout.progress(factor=fraction, text=f"{translated('Solving…')} {fraction:.0%}")
    layout.operator(CANCEL, icon="CANCEL")


def over_buttons(context: bpy.types.Context, event: Any) -> bool:
    """Return whether the mouse is over the status bar, or over our tab: what is clicked there is no edit."""
    window, x, y = context.window, getattr(event, "mouse_x", None), getattr(event, "mouse_y", None)
    if window is None or x is None or y is None:
        return False
    for area in window.screen.areas:
        if area.x <= x < area.x + area.width and area.y <= y < area.y + area.height:
            return area.type == "VIEW_3D" and any(_is_ours(region, x, y) for region in area.regions)
    return bool(y < min(area.y for area in window.screen.areas))


def _is_ours(region: Any, x: int, y: int) -> bool:
    inside = region.x <= x < region.x + region.width and region.y <= y < region.y + region.height
    return inside and region.type == "UI" and getattr(region, "active_panel_category", "") == TAB


def _draw_status(header: Any, context: bpy.types.Context) -> None:
    row = header.layout.row(align=True)
    row.ui_units_x = 16
    draw_progress(row, context)
    # The key's picture is wider than an icon, and the word began under it.
    header.layout.label(text=f"  {translated('Cancel')}", icon="EVENT_ESC", translate=False)


def hide_progress(context: bpy.types.Context) -> None:
    """Take the signs away again, in all windows: where a file is opened or a timer runs, the context has none."""
    context.window_manager.fairing_progress.running = False
    for window in context.window_manager.windows:
        window.workspace.status_text_set(None)
    redraw_sidebars(context)


def redraw_sidebars(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def redraw_views(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def look_at(context: bpy.types.Context, place: Any, normal: Any, size: float) -> None:
    """Turn the 3D view in use, or else the window's first one, to a place in world space, and go near it.

    normal: points to where it can be seen from. size: what is to be in sight at least.
    """
    areas = [area for area in context.window.screen.areas if area.type == "VIEW_3D"] if context.window else []
    area = context.area if context.area in areas else next(iter(areas), None)
    if area is None:
        return
    view = area.spaces.active.region_3d
    towards_us = view.view_rotation @ Vector((0.0, 0.0, 1.0))
    away = Vector(normal)
    if away.length > 0.0 and away.normalized().dot(towards_us) < ASKEW:
        view.view_rotation = away.to_track_quat("Z", "Y")
    view.view_location = place
    view.view_distance = min(view.view_distance, size)
    area.tag_redraw()
