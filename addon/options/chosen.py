# mypy: disable-error-code="valid-type"
"""What the last runs had instead of the defaults: shown beside the button, with a cross that resets it.

A click on the button means the defaults; Live goes by the last run.
No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

import bpy
from bpy.props import StringProperty

from ..fair.operator import MESH_OT_fair_region
from .options import FairOptions
from .table import Option, differing, named


def last_chosen(context: bpy.types.Context) -> dict[str, Any]:
    """Return the options of the last Fair Region that are not the defaults."""
    last = context.window_manager.operator_properties_last(MESH_OT_fair_region.bl_idname)
    return {} if last is None else differing(FairOptions, last)


def shown_value(option: Option, value: Any) -> str:
    if isinstance(option.default, bool):
        return "on" if value else "off"
    if option.items:
        return next(label for identifier, label, _ in option.items if identifier == value)
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def draw(layout: Any, context: bpy.types.Context) -> None:
    chosen = last_chosen(context)
    if not chosen:
        return
    column = layout.box().column(align=True)
    for name, value in chosen.items():
        option = named(FairOptions, name)
        assert option is not None
        row = column.row()
        row.label(text=option.label)
        row.label(text=shown_value(option, value))
        row.operator(MESH_OT_fair_reset.bl_idname, text="", icon="X", emboss=False).option = name
    button = column.operator(MESH_OT_fair_region.bl_idname, text="Fair with These", icon="LOOP_BACK")
    for name, value in chosen.items():
        setattr(button, name, value)


class MESH_OT_fair_reset(bpy.types.Operator):
    """Go back to the default; Live Region takes it, too"""

    bl_idname = "mesh.fair_reset"
    bl_label = "Reset Option"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    option: StringProperty()

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Reset what is remembered of the last run; that run itself stays."""
        last = context.window_manager.operator_properties_last(MESH_OT_fair_region.bl_idname)
        if last is not None and named(FairOptions, self.option) is not None:
            last.property_unset(self.option)
        return {"FINISHED"}
