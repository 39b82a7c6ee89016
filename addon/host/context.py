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


def active_object(context: bpy.types.Context) -> Any:
    """Return the active object, None where there is none: without a window that is the rule."""
    return getattr(context, "active_object", None)
