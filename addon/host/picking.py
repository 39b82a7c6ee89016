"""What lies under the mouse in a 3D view, and operators that wait for a click on it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import bpy
from bpy_extras import view3d_utils

from ..translations import translated
from .handlers import hear_events

if TYPE_CHECKING:
    from collections.abc import Callable


class Picks:
    """An operator that waits for one click: `_picked` takes it; Esc and the right button end it."""

    if TYPE_CHECKING:
        _picked: Callable[[bpy.types.Context, bpy.types.Event], set[str]]

    def pick(self, context: bpy.types.Context, text: str) -> set[str]:
        """Begin to wait; text: what is to be clicked."""
        context.window.cursor_modal_set("EYEDROPPER")
        context.workspace.status_text_set(f"{translated(text)}    [Esc] {translated('Cancel')}")
        hear_events(context, self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in {"ESC", "RIGHTMOUSE"}:
            _end(context)
            return {"CANCELLED"}
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"} if event.type.startswith(("MIDDLE", "WHEEL", "NUMPAD")) else {"RUNNING_MODAL"}
        _end(context)
        return self._picked(context, event)

    def cancel(self, context: bpy.types.Context) -> None:
        """Wait no more; Blender calls this where it ends the operator, maybe without a window."""
        _end(context)


def _end(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        window.cursor_modal_restore()
        window.workspace.status_text_set(None)


def face_under_mouse(context: bpy.types.Context, event: bpy.types.Event, obj: bpy.types.Object) -> int | None:
    """Return the face of the object under the mouse; None where there is none, or no 3D view."""
    for origin, direction in rays(context, event, obj):
        found, _, _, face = obj.ray_cast(origin, direction)
        return int(face) if found else None
    return None


def rays(context: bpy.types.Context, event: bpy.types.Event, obj: bpy.types.Object) -> Iterator[tuple[Any, Any]]:
    """Yield origin and direction of the ray under the mouse, in the object's own coordinates; none outside of views."""
    for area in context.window.screen.areas:
        for region in area.regions if area.type == "VIEW_3D" else ():
            x, y = event.mouse_x - region.x, event.mouse_y - region.y
            if region.type == "WINDOW" and 0 <= x < region.width and 0 <= y < region.height:
                yield _ray(area.spaces.active.region_3d, region, (x, y), obj)


def place_at(context: bpy.types.Context, at: tuple[float, float], obj: bpy.types.Object) -> Any:
    """Return where the object is hit at these pixels of the context's region, in its own coordinates; None: nowhere."""
    found, place, _, _ = obj.ray_cast(*_ray(context.region_data, context.region, at, obj))
    return place if found else None


def _ray(
    view: bpy.types.RegionView3D, region: bpy.types.Region, at: tuple[float, float], obj: bpy.types.Object
) -> tuple[Any, Any]:
    inverse = obj.matrix_world.inverted_safe()
    origin = inverse @ view3d_utils.region_2d_to_origin_3d(region, view, at)
    ahead = inverse @ (
        view3d_utils.region_2d_to_origin_3d(region, view, at) + view3d_utils.region_2d_to_vector_3d(region, view, at)
    )
    return origin, (ahead - origin).normalized()
