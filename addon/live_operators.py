# mypy: disable-error-code="valid-type"
"""Live for the user: the switch, and the operators that set and forget its region.

No postponed annotations here: Blender reads them as property definitions.
"""

import bpy
from bpy.props import BoolProperty

from . import live_mesh
from .engine import REFUSALS
from .inspection import last_options
from .live import live
from .signals import live_changed


class FairLive(bpy.types.PropertyGroup):
    """The switch, on the window manager: undo leaves it alone"""

    on: BoolProperty(
        name="Live",
        description="Make the live region fair again whenever something around it or a pinned vertex is moved, "
        "while it is being dragged too",
        default=False,
        update=live_changed,
    )


class MESH_OT_fair_live_region(bpy.types.Operator):
    """Make the selected faces the live region of their mesh, fair now and after every change around them.
    The options are those of the last Fair Region; the region is saved with the mesh"""

    bl_idname = "mesh.fair_live_region"
    bl_label = "Live Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode has a selection."""
        if context.mode != "EDIT_MESH":
            cls.poll_message_set("Select faces of a mesh in edit mode")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take the selection of every object in edit mode that has one, and turn Live on."""
        context.view_layer.update()
        options = last_options(context)
        chosen = [obj for obj in context.objects_in_mode_unique_data if obj.data.total_face_sel]
        if not chosen:
            self.report({"ERROR"}, "No face is selected")
            return {"CANCELLED"}
        for obj in chosen:
            try:
                live.take(obj, options)
            except REFUSALS as cause:
                self.report({"ERROR"}, f"{obj.name}: {cause}")
                return {"CANCELLED"}
        context.window_manager.fairing_live.on = True
        return {"FINISHED"}


class MESH_OT_fair_live_forget(bpy.types.Operator):
    """Forget the live region of the meshes being edited; their shape stays as it is"""

    bl_idname = "mesh.fair_live_forget"
    bl_label = "Forget Live Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must be a region."""
        if context.mode != "EDIT_MESH":
            cls.poll_message_set("Only in edit mode")
            return False
        if not any(live_mesh.has_region(obj.data) for obj in context.objects_in_mode_unique_data):
            cls.poll_message_set("There is no live region")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Forget them all."""
        for obj in context.objects_in_mode_unique_data:
            live_mesh.forget_region(obj.data)
        return {"FINISHED"}
