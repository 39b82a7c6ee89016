"""The options in groups, for the redo panel."""

from typing import Any

import bpy

_SOLVER = ("method", "levels", "tolerance", "max_iterations", "accept")
OPEN = "fairing_more"  # of the window manager: whether the rarely used options show


def draw_options(layout: Any, options: Any, obj: bpy.types.Object, manager: Any) -> None:
    """Draw the properties of `mesh.fair_region`: shape, vertices, outline, and folded away what is rarely used."""
    layout.use_property_split = True
    layout.prop(options, "factor")
    _draw_shape(_group(layout, "Shape"), options)
    _draw_vertices(_group(layout, "Vertices"), options)
    _draw_detail(_group(layout, "Skin"), options, obj)
    _draw_outline(_group(layout, "At the Outline"), options, obj)
    # No collapsible layout panel: not every place that shows these options has them.
    opened = bool(getattr(manager, OPEN))
    row = layout.row()
    row.use_property_split = False
    row.alignment = "LEFT"
    row.prop(manager, OPEN, icon="DOWNARROW_HLT" if opened else "RIGHTARROW", emboss=False)
    if opened:
        _draw_solver(layout.column(align=True), options)


def _group(layout: Any, title: str) -> Any:
    layout.separator(factor=0.5)
    column = layout.column(align=True)
    column.label(text=title)
    return column


def _draw_shape(group: Any, options: Any) -> None:
    group.prop(options, "equation")
    row = group.row()
    row.active = options.method == "GLOBAL" and options.equation not in ("MINIMAL", "LEAST_VARIATION")
    row.prop(options, "otherwise")
    row = group.row()
    row.active = options.equation == "CONSTANT"
    row.prop(options, "bulge", slider=True)


def _draw_vertices(group: Any, options: Any) -> None:
    group.prop(options, "mesh")
    new = options.mesh == "NEW"
    row = group.row()
    row.active = new
    row.prop(options, "spacing")
    row = group.row()
    row.active = new
    row.prop(options, "quads")
    row = group.row()
    row.active = not new  # new vertices lie evenly
    row.prop(options, "inner_fairness")


def _draw_detail(group: Any, options: Any, obj: bpy.types.Object) -> None:
    group.prop(options, "detail", slider=True)
    row = group.row()
    row.active = options.detail > 0.0
    row.prop(options, "detail_size", slider=True)
    column = group.column(align=True)
    column.active = options.detail > 0.0
    column.prop_search(options, "detail_from", obj, "vertex_groups")
    column.prop(options, "detail_face_set")
    row = group.row()
    row.active = options.mesh == "KEEP"
    row.prop(options, "feather", slider=True)
    column = group.column(align=True)
    column.active = options.mesh == "KEEP"
    column.prop_search(options, "factor_group", obj, "vertex_groups")
    column.prop(options, "factor_mask")


def _draw_outline(group: Any, options: Any, obj: bpy.types.Object) -> None:
    row = group.row()
    row.active = options.equation != "MINIMAL"  # meets positions only
    row.prop(options, "boundary_normals")
    row = group.row()
    row.active = options.equation == "HARMONIC" and options.method == "GLOBAL"
    row.prop(options, "continuity")
    group.prop(options, "outline")
    group.prop_search(options, "pin_group", obj, "vertex_groups")
    row = group.row()
    row.active = bool(options.pin_group)
    row.prop(options, "pin_radius", slider=True)
    group.prop(options, "pin_edges")
    row = group.row()
    row.active = options.pin_edges != "NONE"
    row.prop(options, "pin_slope")
    group.prop(options, "open_border")


def _draw_solver(group: Any, options: Any) -> None:
    for name in _SOLVER:
        row = group.row()
        row.active = name != "levels" or options.method == "PAPER"
        row.prop(options, name)
