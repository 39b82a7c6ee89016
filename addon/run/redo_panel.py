"""The options in groups, for the redo panel: what is set often is in sight, the rest folded away."""

from collections.abc import Callable
from typing import Any

import bpy

from ..core.options import OF_CURVATURE

_SOLVER = ("otherwise", "method", "levels", "tolerance", "max_iterations", "accept")

Draw = Callable[[Any, Any, bpy.types.Object], None]


def draw_options(layout: Any, options: Any, obj: bpy.types.Object, manager: Any) -> None:
    """Draw the properties of `mesh.fair_region`; those without effect don't show."""
    layout.use_property_split = True
    layout.prop(options, "factor")
    _draw_shape(_group(layout, "Shape"), options)
    _draw_vertices(_group(layout, "Vertices"), options)
    _draw_skin(_group(layout, "Skin"), options)
    _draw_outline(_group(layout, "At the Boundary"), options)
    for name, (_, _, draw) in FOLDS.items():
        # No collapsible layout panel: not every place that shows these options has them.
        opened = bool(getattr(manager, name))
        row = layout.row()
        row.use_property_split = False
        row.alignment = "LEFT"
        row.prop(manager, name, icon="DOWNARROW_HLT" if opened else "RIGHTARROW", emboss=False)
        if opened:
            draw(layout.column(align=True), options, obj)


def _group(layout: Any, title: str) -> Any:
    layout.separator(factor=0.5)
    column = layout.column(align=True)
    column.label(text=title)
    return column


def _draw_shape(group: Any, options: Any) -> None:
    group.prop(options, "equation")
    if options.equation == "CONSTANT":
        group.prop(options, "bulge", slider=True)


def _draw_vertices(group: Any, options: Any) -> None:
    group.prop(options, "mesh")
    if options.mesh == "NEW":  # new edges are equally long
        group.prop(options, "spacing")
        group.prop(options, "inner")
        group.prop(options, "subdivide_boundary")
        group.prop(options, "max_vertices")
        group.prop(options, "quads")
        group.prop(options, "limit_total")
    else:
        group.prop(options, "inner_fairness")


def _draw_skin(group: Any, options: Any) -> None:
    group.prop(options, "detail", slider=True)
    if options.detail > 0.0:
        group.prop(options, "detail_size", slider=True)
    row = group.row()
    row.active = options.mesh == "KEEP"
    row.prop(options, "feather", slider=True)


def _draw_outline(group: Any, options: Any) -> None:
    row = group.row()
    row.active = options.equation != "MINIMAL"  # meets positions only
    row.prop(options, "boundary_normals")
    row = group.row()
    row.active = options.equation in OF_CURVATURE and options.method == "GLOBAL"
    row.prop(options, "continuity")
    group.prop(options, "outline")


def _draw_held(group: Any, options: Any, obj: bpy.types.Object) -> None:
    group.prop_search(options, "pin_group", obj, "vertex_groups")
    if options.pin_group:
        group.prop(options, "pin_pull")
        group.prop(options, "pin_radius", slider=True)
    group.prop(options, "pin_edges")
    if options.pin_edges in ("AUTOMATIC", "SHARP"):
        group.prop(options, "pin_curve")
    if options.pin_edges != "NONE":
        group.prop(options, "pin_slope")
    row = group.row()
    row.active = options.mesh == "KEEP"
    row.prop(options, "open_border")


def _draw_parts(group: Any, options: Any, obj: bpy.types.Object) -> None:
    column = group.column(align=True)
    column.active = options.mesh == "KEEP"
    column.prop_search(options, "factor_group", obj, "vertex_groups")
    column.prop(options, "factor_mask")
    row = column.row()
    row.active = obj.data.shape_keys is not None
    row.prop(options, "keys")
    column = group.column(align=True)
    column.active = options.detail > 0.0
    column.prop_search(options, "detail_from", obj, "vertex_groups")
    column.prop(options, "detail_face_set")


def _draw_solver(group: Any, options: Any, _obj: bpy.types.Object) -> None:
    for name in _SOLVER:
        row = group.row()
        row.active = {
            "otherwise": options.method == "GLOBAL" and options.equation not in ("MINIMAL", "LEAST_VARIATION"),
            "levels": options.method == "PAPER",
        }.get(name, True)
        row.prop(options, name)


# What is folded away: names of switches of the window manager, their labels and descriptions, what they show.
FOLDS: dict[str, tuple[str, str, Draw]] = {
    "fairing_held": ("Pins and Borders", "Show what holds the surface inside, and what open borders do", _draw_held),
    "fairing_parts": ("Groups and Masks", "Show where weights, masks and the skin of other faces come in", _draw_parts),
    "fairing_more": ("More", "Show how exactly the surface is found, and which results are written", _draw_solver),
}


def register() -> None:
    """Make the switches known to Blender."""
    for name, (label, description, _) in FOLDS.items():
        setattr(bpy.types.WindowManager, name, bpy.props.BoolProperty(name=label, description=description))


def unregister() -> None:
    """Take them back."""
    for name in FOLDS:
        delattr(bpy.types.WindowManager, name)
