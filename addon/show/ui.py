"""Where everything is found: sidebar panels, Face menu, context menu."""

from typing import Any

import bpy

from ..core.report import GRADE_NAMES
from ..follow.copies import OBJECT_OT_fair_copies_update, OBJECT_OT_fair_copy
from ..follow.inspection import Inspection
from ..follow.live import live
from ..follow.live_operators import (
    MESH_OT_fair_live_far_side,
    MESH_OT_fair_live_forget,
    MESH_OT_fair_live_select,
)
from ..follow.taking import MESH_OT_fair_live_region
from ..follow.watch import MESH_OT_fair_inspect, is_large, request, watch
from ..host.text import draw_text
from ..run.again import WAY_NAMES, MESH_OT_fair_again, MESH_OT_fair_reselect, MESH_OT_fair_spots
from ..run.compare import MESH_OT_fair_compare
from ..run.curvature import MESH_OT_fair_curvature
from ..run.fill import MESH_OT_fair_fill
from ..run.fillet import MESH_OT_fair_fillet
from ..run.masked import MESH_OT_fair_masked
from ..run.operators import MESH_OT_fair_region
from ..run.selection_tools import (
    MESH_OT_fair_add_left_out,
    MESH_OT_fair_grow,
    MESH_OT_fair_select_bad,
    MESH_OT_fair_smooth_outline,
)
from ..translations import translated
from .overlay import overlay

_GRADE_ICONS = {"GOOD": "CHECKMARK", "LOOK": "ERROR", "UNUSABLE": "CANCEL"}
_ICONS = {"MET": "CHECKMARK", "MISSED": "ERROR", "TOLD": "BLANK1"}


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fairing"


class VIEW3D_PT_fairing(_Panel, bpy.types.Panel):
    """The operator, or how far it is"""

    bl_label = "Intrinsic Fairing"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the button and the progress."""
        layout = self.layout
        progress = context.window_manager.fairing_progress
        if progress.running:
            layout.progress(factor=progress.fraction, text=f"{progress.fraction:.0%}  {progress.stage}")
            layout.label(text="cancels", icon="EVENT_ESC")
            return
        column = layout.column(align=True)
        column.scale_y = 1.3
        if context.mode == "EDIT_MESH":
            column.operator(MESH_OT_fair_region.bl_idname, icon="MOD_SMOOTH")
            column.operator(MESH_OT_fair_fill.bl_idname, icon="MESH_ICOSPHERE")
        else:
            _draw_masked(column, context)
        layout.operator(MESH_OT_fair_compare.bl_idname, icon="ARROW_LEFTRIGHT")


class VIEW3D_PT_fairing_selection(_Panel, bpy.types.Panel):
    """What is selected, and what would be refused"""

    bl_label = "Selection"
    bl_parent_id = "VIEW3D_PT_fairing"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Only edit mode has a selection."""
        return bool(context.mode == "EDIT_MESH")

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what the last look found; never look here."""
        request(context)
        if watch.stale and is_large(context):
            self.layout.operator(MESH_OT_fair_inspect.bl_idname, icon="VIEWZOOM")
            return
        for found in watch.found:
            _draw_inspection(self.layout, found, len(watch.found) > 1)
        if not any(found.faces for found in watch.found) and MESH_OT_fair_reselect.poll(context):
            self.layout.operator(MESH_OT_fair_reselect.bl_idname, icon="FILE_REFRESH")


class VIEW3D_PT_fairing_report(_Panel, bpy.types.Panel):
    """What the last run did"""

    bl_label = "Last Run"
    bl_parent_id = "VIEW3D_PT_fairing"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must have been one, it must stand, and so must one of its objects."""
        report = context.window_manager.fairing_report
        names = (report.objects, *report.objects.split(", "))
        return bool(report.free_vertices and not report.undone and any(name in bpy.data.objects for name in names))

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the verdict, what may help, and the figures; what the panel Selection says isn't said again."""
        report = context.window_manager.fairing_report
        _draw_verdict(self.layout, report)
        said = {note for found in watch.found for note in found.notes} if context.mode == "EDIT_MESH" else set()
        _draw_figures(self.layout, report, said)


class VIEW3D_PT_fairing_details(_Panel, bpy.types.Panel):
    """Figures for those who want to find something out"""

    bl_label = "Details"
    bl_parent_id = "VIEW3D_PT_fairing_report"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw(self, context: bpy.types.Context) -> None:
        """Draw residual, codes and the like."""
        report = context.window_manager.fairing_report
        column = self.layout.column(align=True)
        for check in report.checks:
            if check.detail:
                _pair(column, check.name, check.value)
        _pair(column, "Free Vertices", str(report.free_vertices))
        _pair(column, "Seconds", f"{report.seconds:.2f}")


class VIEW3D_PT_fairing_live(_Panel, bpy.types.Panel):
    """A region that follows its surroundings"""

    bl_label = "Live"
    bl_parent_id = "VIEW3D_PT_fairing"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw_header(self, context: bpy.types.Context) -> None:
        """Draw the switch."""
        self.layout.prop(context.window_manager.fairing_live, "on", text="")

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the operators, what is followed and how quickly."""
        row = self.layout.row(align=True)
        row.operator(MESH_OT_fair_live_region.bl_idname)
        row.operator(MESH_OT_fair_live_select.bl_idname, text="", icon="RESTRICT_SELECT_OFF")
        row.operator(MESH_OT_fair_live_forget.bl_idname, text="", icon="X")
        self.layout.operator(MESH_OT_fair_live_far_side.bl_idname)
        column = self.layout.column(align=True)
        for name, session in live.sessions.items():
            column.label(text=name, icon="MESH_DATA", translate=False)
            _pair(column, "Free Vertices", str(len(session.region.free)), "BLANK1")
            _pair(column, "Seconds", f"{session.seconds:.3f}", "BLANK1")
        if live.message:
            draw_text(self.layout, translated(live.message), "ERROR")


class VIEW3D_PT_fairing_overlay(_Panel, bpy.types.Panel):
    """Reflection lines and curvature colours"""

    bl_label = "Quality Overlay"
    bl_parent_id = "VIEW3D_PT_fairing"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw_header(self, context: bpy.types.Context) -> None:
        """Draw the switch."""
        self.layout.prop(context.window_manager.fairing_overlay, "show", text="")

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the settings."""
        _draw_overlay(self.layout, context.window_manager.fairing_overlay)
        self.layout.operator(MESH_OT_fair_curvature.bl_idname, icon="RNDCURVE")


def _draw_masked(column: Any, context: bpy.types.Context) -> None:
    """Draw what can be faired outside edit mode."""
    sources = {"MASK": "Fair Masked", "FACE_SET": "Fair Face Set"}
    if context.mode != "SCULPT":
        sources = {"VERTEX_GROUP": "Fair Vertex Group", "LIVE": "Fair Live Region"}
    for source, text in sources.items():
        column.operator(MESH_OT_fair_masked.bl_idname, text=text, icon="MOD_SMOOTH").source = source
    if context.mode == "OBJECT":
        column.operator(OBJECT_OT_fair_copy.bl_idname, icon="DUPLICATE")
        if OBJECT_OT_fair_copies_update.poll(context):
            column.operator(OBJECT_OT_fair_copies_update.bl_idname, icon="FILE_REFRESH")


def _pair(layout: Any, name: str, value: str, icon: str = "NONE") -> None:
    row = layout.split(factor=0.62)
    row.label(text=name, icon=icon)
    row.label(text=value, translate=False)


def _draw_inspection(layout: Any, found: Inspection, named: bool) -> None:
    column = layout.column(align=True)
    if named:
        column.label(text=found.object_name, icon="OBJECT_DATA", translate=False)
    _pair(column, "Faces", str(found.faces))
    _pair(column, "Free Vertices", str(found.free_vertices))
    if found.refusal:
        draw_text(layout, translated(found.refusal), "CANCEL")
        return
    _pair(column, "Boundary Loops", str(found.loops))
    _pair(column, "Islands", str(found.islands))
    for note in found.notes:
        draw_text(layout, note, "INFO")
    if found.left_out:
        layout.operator(MESH_OT_fair_add_left_out.bl_idname, icon="ADD")
    if len(found.bad):
        _pair(layout.column(align=True), "Bad Vertices", str(len(found.bad)), "ERROR")
        column = layout.column(align=True)
        for tool in (MESH_OT_fair_select_bad, MESH_OT_fair_grow, MESH_OT_fair_smooth_outline):
            column.operator(tool.bl_idname)


def _draw_verdict(layout: Any, report: Any) -> None:
    layout.label(text=report.objects, icon="OBJECT_DATA", translate=False)
    row = layout.row()
    row.alert = report.verdict == "UNUSABLE"
    row.label(text=GRADE_NAMES[report.verdict], icon=_GRADE_ICONS[report.verdict])
    if report.reason:
        draw_text(layout, report.reason, "BLANK1")
    if report.verdict != "GOOD":
        if not report.written:
            draw_text(layout, translated("Nothing was changed"), "BLANK1")
        _draw_remedies(layout.column(align=True), report)


def _draw_remedies(column: Any, report: Any) -> None:
    column.operator(MESH_OT_fair_spots.bl_idname, icon="VIEWZOOM")
    for way in filter(None, report.remedies.split(",")):
        column.operator(MESH_OT_fair_again.bl_idname, text=WAY_NAMES[way]).way = way


def _draw_figures(layout: Any, report: Any, said: set[str]) -> None:
    column = layout.column(align=True)
    for check in report.checks:
        if not check.detail:
            row = column.row()
            row.alert = check.state == "MISSED"
            _pair(row, check.name, check.value, _ICONS[check.state])
    for warning in report.warnings.splitlines():
        if warning not in said:
            draw_text(layout, warning, "INFO")


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
        row.prop(settings, "range")
    column.prop(settings, "opacity")
    if overlay.message:
        draw_text(layout, overlay.message, "ERROR")


def draw_face_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add the operators to the menu Face."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_region.bl_idname)
    menu.layout.operator(MESH_OT_fair_fill.bl_idname)


def draw_edge_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add Fair Fillet to the menu Edge, to be drawn by the mouse."""
    menu.layout.separator()
    menu.layout.operator_context = "INVOKE_DEFAULT"
    menu.layout.operator(MESH_OT_fair_fillet.bl_idname)


def draw_context_menu(menu: Any, context: bpy.types.Context) -> None:
    """Add to the context menu, which vertices, edges and faces share, what fits the selection."""
    faces = context.tool_settings.mesh_select_mode[2]
    menu.layout.separator()
    menu.layout.operator((MESH_OT_fair_region if faces else MESH_OT_fair_fill).bl_idname)


def draw_mask_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add Fair Masked to the menu Mask of sculpt mode."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_masked.bl_idname).source = "MASK"


def draw_face_set_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add the same for a face set to the menu Face Sets."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_masked.bl_idname, text="Fair Face Set").source = "FACE_SET"


PANELS = (
    VIEW3D_PT_fairing,
    VIEW3D_PT_fairing_selection,
    VIEW3D_PT_fairing_report,
    VIEW3D_PT_fairing_details,
    VIEW3D_PT_fairing_live,
    VIEW3D_PT_fairing_overlay,
)
