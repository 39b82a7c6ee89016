"""What lies under the mouse in a 3D view."""

from __future__ import annotations

from typing import Any

import bpy
from bpy_extras import view3d_utils


def face_under_mouse(context: bpy.types.Context, event: bpy.types.Event, obj: bpy.types.Object) -> int | None:
    """Return the face of the object under the mouse; None where there is none, or no 3D view."""
    for area in context.window.screen.areas:
        for region in area.regions if area.type == "VIEW_3D" else ():
            x, y = event.mouse_x - region.x, event.mouse_y - region.y
            if region.type == "WINDOW" and 0 <= x < region.width and 0 <= y < region.height:
                found, _, _, face = obj.ray_cast(*_ray(area.spaces.active.region_3d, region, (x, y), obj))
                return int(face) if found else None
    return None


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
