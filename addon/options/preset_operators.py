# mypy: disable-error-code="valid-type"
"""Presets: those of the add-on (options/presets.py), and one's own, which are files that set every option.

In the redo panel they change the last run; beside the sidebar's button each of the add-on's is a run of its own.
No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

import bpy
from bl_operators.presets import AddPresetBase
from bpy.props import StringProperty

from .presets import PRESETS
from .table import table


class MESH_OT_fair_preset(bpy.types.Operator):
    """Give the last run these options, and the defaults for all others"""

    bl_idname = "mesh.fair_preset"
    bl_label = "Use Preset"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    operator: StringProperty(options={"HIDDEN"})
    preset: StringProperty(options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Set them."""
        give(self.operator, self.preset, context.active_operator.properties)
        return {"FINISHED"}


def give(operator: str, preset: str, properties: Any) -> None:
    """Set the options of a preset, and all others to their defaults."""
    _reset(operator, properties)
    for name, value in PRESETS[operator][1][preset].items():
        setattr(properties, name, value)


def _reset(operator: str, properties: Any) -> None:
    for option in table(PRESETS[operator][0]):
        properties.property_unset(option.name)


class _Runs:
    operator = ""

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw a button for each preset that runs the operator with it."""
        for preset, options in PRESETS[self.operator][1].items():
            button = self.layout.operator(self.operator, text=preset)  # type: ignore[attr-defined]
            for name, value in options.items():
                setattr(button, name, value)


class MESH_MT_fair_region_runs(_Runs, bpy.types.Menu):
    """Fair Region as it is mostly needed"""

    bl_label = "Fair Region Presets"
    operator = "mesh.fair_region"


class MESH_MT_fair_fill_runs(_Runs, bpy.types.Menu):
    """Fair Fill as it is mostly needed"""

    bl_label = "Fair Fill Presets"
    operator = "mesh.fair_fill"


def draw_own(menu: Any) -> None:
    """Draw a button for each preset of the add-on's that changes the last run."""
    for preset in PRESETS[menu.operator][1]:
        button = menu.layout.operator(MESH_OT_fair_preset.bl_idname, text=preset)
        button.operator, button.preset = menu.operator, preset


class _Presets:
    """The menu of the redo panel."""

    preset_operator = "script.execute_preset"
    preset_subdir = ""
    operator = ""

    def draw(self, context: bpy.types.Context) -> None:
        """Draw those of the add-on, then one's own."""
        draw_own(self)
        if bpy.utils.preset_paths(self.preset_subdir):
            bpy.types.Menu.draw_preset(self, context)

    @classmethod
    def reset_cb(cls, context: bpy.types.Context, _filepath: str = "") -> None:
        """Begin with the defaults: a preset of an earlier version may leave options out."""
        _reset(cls.operator, context.active_operator.properties)


class MESH_MT_fair_region_presets(_Presets, bpy.types.Menu):
    """What Fair Region is mostly needed for"""

    bl_label = "Presets"
    operator = "mesh.fair_region"
    preset_subdir = "operator/mesh.fair_region"


class MESH_MT_fair_fill_presets(_Presets, bpy.types.Menu):
    """What Fair Fill is mostly needed for"""

    bl_label = "Presets"
    operator = "mesh.fair_fill"
    preset_subdir = "operator/mesh.fair_fill"


class _Adds(AddPresetBase):
    bl_label = "Add Preset"
    preset_defines = ("op = bpy.context.active_operator",)


def _values(operator: str) -> list[str]:
    return [f"op.{option.name}" for option in table(PRESETS[operator][0])]


class MESH_OT_fair_region_preset_add(_Adds, bpy.types.Operator):
    """Add or remove a preset of Fair Region"""

    bl_idname = "mesh.fair_region_preset_add"
    preset_menu = "MESH_MT_fair_region_presets"
    preset_subdir = "operator/mesh.fair_region"
    preset_values = _values("mesh.fair_region")


class MESH_OT_fair_fill_preset_add(_Adds, bpy.types.Operator):
    """Add or remove a preset of Fair Fill"""

    bl_idname = "mesh.fair_fill_preset_add"
    preset_menu = "MESH_MT_fair_fill_presets"
    preset_subdir = "operator/mesh.fair_fill"
    preset_values = _values("mesh.fair_fill")


CLASSES = (
    MESH_OT_fair_preset,
    MESH_MT_fair_region_runs,
    MESH_MT_fair_fill_runs,
    MESH_MT_fair_region_presets,
    MESH_MT_fair_fill_presets,
    MESH_OT_fair_region_preset_add,
    MESH_OT_fair_fill_preset_add,
)
