"""Where the operator is found: sidebar, Face menu, context menu."""

from typing import Any

import bpy

from .operators import MESH_OT_fair_region


class VIEW3D_PT_fairing(bpy.types.Panel):
    """The sidebar panel: the operator and what its last run did"""

    bl_label = "Intrinsic Fairing"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fairing"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the button and the last report."""
        self.layout.operator(MESH_OT_fair_region.bl_idname, icon="MOD_SMOOTH")
        report = context.window_manager.fairing_report
        if report.free_vertices:
            _draw_report(self.layout.box(), report)


def _draw_report(layout: Any, report: Any) -> None:
    layout.label(text=report.objects, icon="CHECKMARK" if report.converged else "ERROR")
    column = layout.column(align=True)
    column.label(text=f"Free vertices: {report.free_vertices}")
    column.label(text=f"Seconds: {report.seconds:.2f}")
    column.label(text=f"Residual: {report.residual:.1e}")
    column.label(text=f"Largest angle at the outline: {report.boundary_angle:.2g}°")
    for warning in report.warnings.splitlines():
        layout.label(text=warning, icon="ERROR")


def draw_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add the operator to a menu."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_region.bl_idname)


def draw_context_menu(menu: Any, context: bpy.types.Context) -> None:
    """Add the operator to the context menu of faces, which vertices and edges share."""
    if context.tool_settings.mesh_select_mode[2]:
        draw_menu(menu, context)
