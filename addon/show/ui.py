"""The sidebar's panels."""

from typing import Any

import bpy

from ..fair.masked import MESH_OT_fair_masked
from ..fair.operator import MESH_OT_fair_region
from ..fill.operator import MESH_OT_fair_fill
from ..host.status import draw_progress
from ..host.text import SidebarPanel, draw_text, pair
from ..live.live import live
from ..live.operators import MESH_OT_fair_live_forget
from ..live.start import MESH_OT_fair_live_region
from ..options.preset_operators import MESH_MT_fair_fill_runs, MESH_MT_fair_region_runs
from ..overlay.overlay import overlay
from ..run.compare import MESH_OT_fair_compare
from ..selection.panel import VIEW3D_PT_fairing_counts, VIEW3D_PT_fairing_selection
from ..selection.tools import draw_select
from ..translations import translated
from ..verdict.panel import VIEW3D_PT_fairing_details, VIEW3D_PT_fairing_report


class VIEW3D_PT_fairing(SidebarPanel, bpy.types.Panel):
    """The operator, or how far it is"""

    bl_label = "Intrinsic Fairing"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        if context.window_manager.fairing_progress.running:
            draw_progress(layout, context)
            return
        if context.window_manager.fairing_progress.following:
            draw_progress(layout, context)
        column = layout.column(align=True)
        column.scale_y = 1.3
        if context.mode == "EDIT_MESH":
            _draw_button(column, MESH_OT_fair_region, "MOD_SMOOTH", MESH_MT_fair_region_runs)
            _draw_button(column, MESH_OT_fair_fill, "MESH_ICOSPHERE", MESH_MT_fair_fill_runs)
        else:
            _draw_masked(column, context)
        layout.operator(MESH_OT_fair_compare.bl_idname, icon="ARROW_LEFTRIGHT")


class VIEW3D_PT_fairing_live(SidebarPanel, bpy.types.Panel):
    """A region that follows its surroundings"""

    bl_label = "Live"
    bl_parent_id = "VIEW3D_PT_fairing"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.window_manager.fairing_live, "on", text="")

    def draw(self, context: bpy.types.Context) -> None:
        row = self.layout.row(align=True)
        row.operator(MESH_OT_fair_live_region.bl_idname)
        draw_select(row, "LIVE", text="", icon="RESTRICT_SELECT_OFF")
        row.operator(MESH_OT_fair_live_forget.bl_idname, text="", icon="X")
        column = self.layout.column(align=True)
        for name, session in live.sessions.items():
            column.label(text=name, icon="MESH_DATA", translate=False)
            pair(column, "Free Vertices", str(len(session.region.free)), "BLANK1")
            pair(column, "Seconds", f"{session.seconds:.3f}", "BLANK1")
        if live.message:
            draw_text(self.layout, translated(live.message), "ERROR")


class VIEW3D_PT_fairing_overlay(SidebarPanel, bpy.types.Panel):
    """Reflection lines and curvature colours"""

    bl_label = "Quality Overlay"
    bl_parent_id = "VIEW3D_PT_fairing"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.window_manager.fairing_overlay, "show", text="")

    def draw(self, context: bpy.types.Context) -> None:
        _draw_overlay(self.layout, context.window_manager.fairing_overlay)


def _draw_button(column: Any, operator: Any, icon: str, presets: Any) -> None:
    row = column.row(align=True)
    row.operator(operator.bl_idname, icon=icon)
    row.menu(presets.__name__, text="", icon="PRESET")


def _draw_masked(column: Any, context: bpy.types.Context) -> None:
    """Draw what can be faired outside edit mode."""
    sources = {"MASK": "Fair Masked", "FACE_SET": "Fair Face Set"}
    if context.mode != "SCULPT":
        sources = {"VERTEX_GROUP": "Fair Vertex Group", "LIVE": "Fair Live Region"}
    for source, text in sources.items():
        column.operator(MESH_OT_fair_masked.bl_idname, text=text, icon="MOD_SMOOTH").source = source


def _draw_overlay(layout: Any, settings: Any) -> None:
    layout.use_property_split = True
    column = layout.column()
    column.active = settings.show
    column.prop(settings, "mode")
    column.prop(settings, "scope")
    if settings.mode == "ZEBRA":
        column.prop(settings, "stripes")
        column.prop(settings, "axis")
    else:
        column.prop(settings, "automatic")
        row = column.row()
        row.active = not settings.automatic
        row.prop(settings, "range", text="Tolerance" if settings.mode == "DEVIATION" else "Range")
    column.prop(settings, "opacity")
    if overlay.message:
        draw_text(layout, overlay.message, "ERROR")


PANELS = (
    VIEW3D_PT_fairing,
    VIEW3D_PT_fairing_selection,
    VIEW3D_PT_fairing_counts,
    VIEW3D_PT_fairing_report,
    VIEW3D_PT_fairing_details,
    VIEW3D_PT_fairing_live,
    VIEW3D_PT_fairing_overlay,
)
