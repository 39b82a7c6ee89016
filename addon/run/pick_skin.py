"""The eyedropper for *Detail From*: the skin of the face set that is clicked comes onto the region of the last run."""

from __future__ import annotations

from dataclasses import replace

import bpy

from ..host.picking import Picks, rays
from ..host.polling import require, require_edit_mode
from ..mesh import painted
from ..translations import translated
from . import last_run


class MESH_OT_fair_pick_skin(Picks, bpy.types.Operator):
    """Click a face set in the 3D view: its skin is put on the faces that the last run has faired"""

    bl_idname = "mesh.fair_pick_skin"
    bl_label = "Detail From Face Set"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must have been a run."""
        return require_edit_mode(cls, context) and require(cls, last_run.has_regions(), "Nothing has been faired yet")

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Wait for the click."""
        return self.pick(context, "Click the face set whose skin is to be copied")

    def _picked(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take the face set under the mouse."""
        obj = context.edit_object
        found = [painted.edited_face_set_at(obj.data, *ray) for ray in rays(context, event, obj)]
        number = found[0] if found else 0
        if not number:
            self.report({"INFO"}, translated("There is no face set under the mouse: make one in sculpt mode"))
            return {"CANCELLED"}
        return run_with_skin_of(context, number)


def run_with_skin_of(context: bpy.types.Context, face_set: int) -> set[str]:
    """Fair the region of the last run once more with the skin of a face set; raises last_run.Changed, RuntimeError."""
    options = last_run.options()
    changed = replace(options, detail=options.detail or 1.0, detail_face_set=face_set, detail_from="", feather=0.0)
    last_run.select_region(context)
    bpy.ops.ed.undo_push(message="Select Region")  # what the redo panel goes back to
    how = "EXEC_DEFAULT" if bpy.app.background or context.window is None else "INVOKE_DEFAULT"
    status: set[str] = bpy.ops.mesh.fair_region(how, True, **changed.chosen)
    return {"CANCELLED"} if "CANCELLED" in status else {"FINISHED"}
