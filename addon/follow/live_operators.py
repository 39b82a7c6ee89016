# mypy: disable-error-code="valid-type"
"""Live for the user: the switch, and the operators that select and forget its region.

No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty

from ..core.options import FairOptions
from ..core.selection import far_sides
from ..core.signals import live_changed
from ..host.context import edited_objects
from ..host.polling import require, require_edit_mode
from ..mesh import live_mesh, mesh_io, selecting
from ..translations import translated


class FairLive(bpy.types.PropertyGroup):
    """The switch, on the window manager: undo leaves it alone"""

    on: BoolProperty(
        name="Live",
        description="Make the live region fair again whenever something around it or a pinned vertex is moved, "
        "while it is being dragged too",
        default=False,
        update=live_changed,
    )


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


class MESH_OT_fair_live_far_side(bpy.types.Operator):
    """Select everything beyond the live region, so that it can be dragged at once.
    Once more: the other side"""

    bl_idname = "mesh.fair_live_far_side"
    bl_label = "Select Far Side"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must be a region."""
        return _require_region(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select the smallest side, or the one after the side that is selected already."""
        found = False
        for obj in edited_objects(context):
            if not live_mesh.has_region(obj.data):
                continue
            sides = far_sides(mesh_io.read_edit_mesh(obj, FairOptions(), live_mesh.LAYER))
            if len(sides) > 1:
                found = True
                now = selecting.selected_faces(obj.data)
                at = next((k + 1 for k, side in enumerate(sides) if np.array_equal(side, now)), 0)
                context.tool_settings.mesh_select_mode = (False, False, True)
                selecting.select_faces(obj.data, sides[at % len(sides)])
        if not found:
            self.report({"INFO"}, translated("The live region cuts nothing off: there is no far side"))
            return {"CANCELLED"}
        return {"FINISHED"}


class MESH_OT_fair_live_forget(bpy.types.Operator):
    """Forget the live region of the meshes being edited; their shape stays as it is"""

    bl_idname = "mesh.fair_live_forget"
    bl_label = "Clear Live Region"
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
