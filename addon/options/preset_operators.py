"""The add-on's presets, each a run of its own next to the sidebar's button. One's own are Blender's: see PRESET."""

from typing import Any

import bpy

from .presets import PRESETS


class _Runs:
    operator = ""

    def draw(self, _context: bpy.types.Context) -> None:
        for preset, options in PRESETS[self.operator][1].items():
            button: Any = self.layout.operator(self.operator, text=preset)  # type: ignore[attr-defined]
            for name, value in options.items():
                setattr(button, name, value)


class MESH_MT_fair_region_runs(_Runs, bpy.types.Menu):
    """Presets for Fair Region"""

    bl_label = "Fair Region Presets"
    operator = "mesh.fair_region"


class MESH_MT_fair_fill_runs(_Runs, bpy.types.Menu):
    """Presets for Fair Fill"""

    bl_label = "Fair Fill Presets"
    operator = "mesh.fair_fill"
