"""What lies under the mouse in a 3D view."""

from __future__ import annotations

import bpy
from bpy_extras import view3d_utils


def face_under_mouse(context: bpy.types.Context, event: bpy.types.Event, obj: bpy.types.Object) -> int | None:
    """Return the face of the object under the mouse; None where there is none, or no 3D view."""
    for area in context.window.screen.areas:
        for region in area.regions if area.type == "VIEW_3D" else ():
            x, y = event.mouse_x - region.x, event.mouse_y - region.y
            if region.type == "WINDOW" and 0 <= x < region.width and 0 <= y < region.height:
                return _face_at(area.spaces.active.region_3d, region, (x, y), obj)
    return None


def _face_at(
    view: bpy.types.RegionView3D, region: bpy.types.Region, at: tuple[int, int], obj: bpy.types.Object
) -> int | None:
    inverse = obj.matrix_world.inverted_safe()
    origin = inverse @ view3d_utils.region_2d_to_origin_3d(region, view, at)
    ahead = inverse @ (
        view3d_utils.region_2d_to_origin_3d(region, view, at) + view3d_utils.region_2d_to_vector_3d(region, view, at)
    )
    found, _, _, face = obj.ray_cast(origin, (ahead - origin).normalized())
    return int(face) if found else None
