"""Before and after by holding a key: the shape before shows as long as the key is down."""

from __future__ import annotations

import bpy

from ..host.polling import require, require_edit_mode
from ..translations import translated
from . import compare


class MESH_OT_fair_peek(bpy.types.Operator):
    """Show the shape before the last fairing as long as the key is held"""

    bl_idname = "mesh.fair_peek"
    bl_label = "Peek at Before"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    _key = ""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must be something to compare, in edit mode."""
        return require_edit_mode(cls, context) and require(cls, compare.is_available(), "Nothing has been faired yet")

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Show the other of the two."""
        try:
            compare.toggle(context)
        except compare.Changed as change:
            self.report({"ERROR"}, translated(str(change)))
            return {"CANCELLED"}
        self._key = event.type
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Look around meanwhile; show what was shown when the key is let go."""
        if event.type == self._key and event.value == "RELEASE":
            self.cancel(context)
            return {"FINISHED"}
        looks = event.type in {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "NDOF_MOTION"}
        return {"PASS_THROUGH"} if looks else {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Bring back what was shown; Blender calls this too, when it closes a window."""
        compare.toggle(context)
