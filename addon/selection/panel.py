"""What is selected, and what would be refused."""

from __future__ import annotations

from typing import Any

import bpy

from ..host.text import SidebarPanel, draw_text, pair
from ..run import last_run
from ..translations import translated
from .inspection import Inspection
from .tools import draw_select
from .watch import MESH_OT_fair_inspect, is_large, request, watch


class VIEW3D_PT_fairing_selection(SidebarPanel, bpy.types.Panel):
    """What is selected, and what would be refused"""

    bl_label = "Selection"
    bl_parent_id = "VIEW3D_PT_fairing"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.mode == "EDIT_MESH")

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what the last look found; never look here."""
        request(context)
        if watch.stale and is_large(context):
            self.layout.operator(MESH_OT_fair_inspect.bl_idname, icon="VIEWZOOM")
            return
        for found in watch.found:
            _draw_inspection(self.layout, found, len(watch.found) > 1)
        if last_run.has_spots() and not last_run.has_regions():  # of a refusal
            draw_select(self.layout, "SPOTS", icon="VIEWZOOM")


class VIEW3D_PT_fairing_counts(SidebarPanel, bpy.types.Panel):
    """What the selection consists of"""

    bl_label = "Details"
    bl_parent_id = "VIEW3D_PT_fairing_selection"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw(self, _context: bpy.types.Context) -> None:
        for found in watch.found:
            column = self.layout.column(align=True)
            pair(column, "Faces", str(found.faces))
            pair(column, "Free Vertices", str(found.free_vertices))
            if not found.refusal:
                pair(column, "Boundary Loops", str(found.loops))
                pair(column, "Islands", str(found.islands))


def _draw_inspection(layout: Any, found: Inspection, named: bool) -> None:
    if named:
        layout.label(text=found.object_name, icon="OBJECT_DATA", translate=False)
    if found.refusal:
        draw_text(layout, translated(found.refusal), "CANCEL")
        return
    for note in found.notes:
        draw_text(layout, note, "INFO")
    if found.left_out:
        draw_select(layout, "LEFT_OUT", icon="ADD")
    if len(found.bad):
        pair(layout.column(align=True), "Bad Vertices", str(len(found.bad)), "ERROR")
        draw_select(layout, "BAD")
    if not (found.notes or found.left_out or len(found.bad)):
        layout.label(text="Ready", icon="CHECKMARK")
