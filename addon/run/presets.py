"""Presets: files that set every option, those of the add-on (core/presets.py) and one's own.

In the redo panel they change the last run; beside the sidebar's button each is a run of its own.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
from bl_operators.presets import AddPresetBase

from ..core.option_table import Table
from ..core.presets import PRESETS

_ACTIVE = "op = bpy.context.active_operator"


def read(path: Path) -> dict[str, Any]:
    """Return the options that a preset's file sets."""
    found = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        name, _, value = line.partition(" = ")
        if name.startswith("op."):
            found[name.removeprefix("op.")] = ast.literal_eval(value)
    return found


def files(operator: str) -> Iterator[Path]:
    """Yield the files of an operator's presets, the add-on's first and in their order."""
    folders = [Path(folder) for folder in bpy.utils.preset_paths(f"operator/{operator}")]
    found = sorted(path for folder in folders for path in folder.glob("*.py"))
    own = [name.replace(" ", "_") for name in PRESETS[operator][1]]
    yield from sorted(found, key=lambda path: own.index(path.stem) if path.stem in own else len(own))


def draw_runs(layout: Any, operator: str) -> None:
    """Draw a button for each preset that runs the operator with it."""
    for path in files(operator):
        button = layout.operator(operator, text=bpy.path.display_name(path.stem, title_case=False))
        for name, value in read(path).items():
            setattr(button, name, value)


class _Runs:
    operator = ""

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw a button for each."""
        draw_runs(self.layout, self.operator)  # type: ignore[attr-defined]


class MESH_MT_fair_region_runs(_Runs, bpy.types.Menu):
    """Fair Region as it is mostly needed"""

    bl_label = "Fair Region Presets"
    operator = "mesh.fair_region"


class MESH_MT_fair_fill_runs(_Runs, bpy.types.Menu):
    """Fair Fill as it is mostly needed"""

    bl_label = "Fair Fill Presets"
    operator = "mesh.fair_fill"


class _Presets:
    """The menu of the redo panel."""

    preset_operator = "script.execute_preset"
    draw = bpy.types.Menu.draw_preset
    operator = ""

    @classmethod
    def reset_cb(cls, context: bpy.types.Context, _filepath: str = "") -> None:
        """Begin with the defaults: a preset of an earlier version may leave options out."""
        for option in PRESETS[cls.operator][0]:
            context.active_operator.properties.property_unset(option.name)


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


def _values(table: Table) -> list[str]:
    return [f"op.{option.name}" for option in table]


class MESH_OT_fair_region_preset_add(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of Fair Region"""

    bl_idname = "mesh.fair_region_preset_add"
    bl_label = "Add Preset"
    preset_menu = "MESH_MT_fair_region_presets"
    preset_subdir = "operator/mesh.fair_region"
    preset_defines = (_ACTIVE,)
    preset_values = _values(PRESETS["mesh.fair_region"][0])


class MESH_OT_fair_fill_preset_add(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of Fair Fill"""

    bl_idname = "mesh.fair_fill_preset_add"
    bl_label = "Add Preset"
    preset_menu = "MESH_MT_fair_fill_presets"
    preset_subdir = "operator/mesh.fair_fill"
    preset_defines = (_ACTIVE,)
    preset_values = _values(PRESETS["mesh.fair_fill"][0])


CLASSES = (
    MESH_MT_fair_region_runs,
    MESH_MT_fair_fill_runs,
    MESH_MT_fair_region_presets,
    MESH_MT_fair_fill_presets,
    MESH_OT_fair_region_preset_add,
    MESH_OT_fair_fill_preset_add,
)
