# mypy: disable-error-code="valid-type"
"""Live for the user: the switch, and the operators that set and forget its region.

No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

import bpy
from bpy.props import BoolProperty

from ..core.engine import REFUSALS
from ..core.signals import live_changed
from ..host.context import edited_objects
from ..host.polling import NO_FACE, SELECT_FACES, require, require_edit_mode
from ..mesh import live_mesh
from ..translations import translated
from .inspection import last_options
from .live import live


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
        return require_edit_mode(cls, context, SELECT_FACES)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take the selection of every object in edit mode that has one, and turn Live on."""
        context.view_layer.update()
        options = last_options(context)
        chosen = [obj for obj in edited_objects(context) if obj.data.total_face_sel]
        if not chosen:
            self.report({"ERROR"}, translated(NO_FACE))
            return {"CANCELLED"}
        for obj in chosen:
            try:
                live.take(obj, options)
            except REFUSALS as cause:
                self.report({"ERROR"}, f"{obj.name}: {cause}")
                return {"CANCELLED"}
        context.window_manager.fairing_live.on = True
        return {"FINISHED"}


def _require_region(operator: Any, context: bpy.types.Context) -> bool:
    return require_edit_mode(operator, context) and require(
        operator,
        any(live_mesh.has_region(obj.data) for obj in edited_objects(context)),
        "There is no live region",
    )


class MESH_OT_fair_live_select(bpy.types.Operator):
    """Select the faces of the live region, to see which they are"""

    bl_idname = "mesh.fair_live_select"
    bl_label = "Select Live Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must be a region."""
        return _require_region(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select in face mode: the other modes would select faces between the region's vertices too."""
        context.tool_settings.mesh_select_mode = (False, False, True)
        for obj in edited_objects(context):
            live_mesh.select_region(obj.data)
        return {"FINISHED"}


class MESH_OT_fair_live_forget(bpy.types.Operator):
    """Forget the live region of the meshes being edited; their shape stays as it is"""

    bl_idname = "mesh.fair_live_forget"
    bl_label = "Forget Live Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must be a region."""
        return _require_region(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Forget them all."""
        for obj in edited_objects(context):
            live_mesh.forget_region(obj.data)
        return {"FINISHED"}
