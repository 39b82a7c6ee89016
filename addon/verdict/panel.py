"""What the last run did: a verdict, a sentence, the button that helps most; all else in Details."""

from __future__ import annotations

from typing import Any

import bpy

from ..host.text import SidebarPanel, draw_text, pair
from ..run.again import REMEDY_NAMES, MESH_OT_fair_again, best_first
from ..selection.tools import draw_select
from ..selection.watch import watch
from ..translations import translated
from .properties import message
from .report import GRADE_NAMES

_GRADE_ICONS = {"GOOD": "CHECKMARK", "LOOK": "ERROR", "UNUSABLE": "CANCEL"}
_LONGEST = 20  # letters of a value that has room after its name
_ICONS = {"MET": "CHECKMARK", "MISSED": "ERROR", "TOLD": "BLANK1"}


class VIEW3D_PT_fairing_report(SidebarPanel, bpy.types.Panel):
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
        """Draw the verdict, the reason for it or the first note, and what helps most."""
        report = context.window_manager.fairing_report
        row = self.layout.row()
        row.alert = report.verdict == "UNUSABLE"
        row.label(text=GRADE_NAMES[report.verdict], icon=_GRADE_ICONS[report.verdict])
        sentence = report.reason or next(iter(_notes(context, report)), "")
        if sentence:
            draw_text(self.layout, message(sentence), "BLANK1")
        if report.verdict == "GOOD":
            return
        if not report.written:
            draw_text(self.layout, translated("Nothing was changed"), "BLANK1")
        _draw_remedies(self.layout, best_first(report.remedies)[:1])


class VIEW3D_PT_fairing_details(SidebarPanel, bpy.types.Panel):
    """Figures, notes and the other buttons"""

    bl_label = "Details"
    bl_parent_id = "VIEW3D_PT_fairing_report"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012 - the form that Blender asks for

    def draw(self, context: bpy.types.Context) -> None:
        """Draw what is left; what the panel Selection says isn't said again."""
        report = context.window_manager.fairing_report
        self.layout.label(text=report.objects, icon="OBJECT_DATA", translate=False)
        if report.verdict != "GOOD":
            column = self.layout.column(align=True)
            draw_select(column, "SPOTS", icon="VIEWZOOM")
            _draw_remedies(column, best_first(report.remedies)[1:])
        for note in _notes(context, report)[0 if report.reason else 1 :]:
            draw_text(self.layout, message(note), "INFO")
        _draw_figures(self.layout.column(align=True), report)


def _draw_remedies(layout: Any, remedies: list[str]) -> None:
    for remedy in remedies:
        layout.operator(MESH_OT_fair_again.bl_idname, text=REMEDY_NAMES[remedy]).remedy = remedy


def _notes(context: bpy.types.Context, report: Any) -> list[str]:
    said = {note for found in watch.found for note in found.notes} if context.mode == "EDIT_MESH" else set()
    return [warning for warning in report.warnings.splitlines() if warning not in said]


def _draw_figures(column: Any, report: Any) -> None:
    for check in sorted(report.checks, key=lambda each: each.detail):
        row = column.row()
        row.alert = check.state == "MISSED"
        value = translated(message(check.value))
        if len(value) > _LONGEST:
            draw_text(row, f"{translated(check.name)}: {value}", _ICONS[check.state])
        else:
            pair(row, check.name, value, _ICONS[check.state])
    pair(column, "Free Vertices", str(report.free_vertices), "BLANK1")
    pair(column, "Seconds", f"{report.seconds:.2f}", "BLANK1")
