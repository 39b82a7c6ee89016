# mypy: disable-error-code="valid-type"
"""Live for the user: the switch, and the operators that select and forget its region.

No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

import bpy
from bpy.props import BoolProperty

from ..host.context import edited_objects
from ..host.polling import require, require_edit_mode
from ..mesh import live_mesh
from ..overlay.signals import live_changed
from ..words.words import said


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
        said("no_live_region_here"),
    )


class MESH_OT_fair_live_forget(bpy.types.Operator):
    """Forget the live region of the meshes being edited; their shape stays as it is"""

    bl_idname = "mesh.fair_live_forget"
    bl_label = "Clear Live Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _require_region(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        for obj in edited_objects(context):
            live_mesh.forget_region(obj.data)
        return {"FINISHED"}
