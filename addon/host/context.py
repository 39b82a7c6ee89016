"""What a context holds, be it a window's or one that a script has put together without a window."""

from __future__ import annotations

from typing import Any

import bpy


def edited_objects(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Return one object for each mesh in edit mode.

    Without a window: of what the script has named as `objects_in_mode` or, alone, as `edit_object`.
    """
    found = getattr(context, "objects_in_mode_unique_data", None)
    if found is None:
        edited = getattr(context, "edit_object", None)
        named = getattr(context, "objects_in_mode", None) or ([edited] if edited is not None else [])
        found = {obj.data: obj for obj in named if obj.mode == "EDIT" and obj.type == "MESH"}.values()
    return list(found)


def in_view(window: int) -> dict[str, Any] | None:
    """Return what `temp_override` is given for the header of a 3D view of the window with this pointer; or None.

    Not the 3D view itself: the end of a modal operator there ends what is pulled in it.

    A window may be gone by the time that a timer looks for it; then another one does.
    """
    windows = sorted(bpy.context.window_manager.windows, key=lambda each: each.as_pointer() != window)
    for each in windows:
        for area in each.screen.areas:
            region = next((region for region in area.regions if region.type == "HEADER"), None)
            if area.type == "VIEW_3D" and region is not None:
                return {"window": each, "screen": each.screen, "area": area, "region": region}
    return None


def active_object(context: bpy.types.Context) -> Any:
    """Return the active object, None where there is none: without a window that is the rule."""
    return getattr(context, "active_object", None)
