"""The redo panel: three groups in sight, the rest folded away, and nothing that has no effect."""

from typing import Any

import bpy

from .table import FOLDED, GROUPS, Option, table

ADVANCED = "fairing_advanced"  # the switch, of the window manager


def draw_options(layout: Any, options: Any, obj: bpy.types.Object | None, manager: Any) -> None:
    """Draw the options of an operator that says which class they come to."""
    shown = _shown(options)
    layout.use_property_split = True
    titles = dict.fromkeys(option.group for option in table(options.chosen))
    for title in (title for title in titles if title not in FOLDED):
        _draw_group(layout, title if title in GROUPS[1:] else "", shown.get(title, []), options, obj)
    if not any(title in FOLDED for title in titles):
        return
    opened = bool(getattr(manager, ADVANCED))
    row = layout.row()
    row.use_property_split = False
    row.alignment = "LEFT"
    # No collapsible layout panel: not every place that shows these options has them.
    row.prop(manager, ADVANCED, icon="DOWNARROW_HLT" if opened else "RIGHTARROW", emboss=False)
    if opened:
        for title in FOLDED:
            _draw_group(layout, title, shown.get(title, []), options, obj)


def _shown(options: Any) -> dict[str, list[Option]]:
    """Return the options in sight, by their groups."""
    given = options.chosen.of(options)
    found: dict[str, list[Option]] = {}
    for option in table(options.chosen):
        if option.counts(given) or option.is_set(options):
            found.setdefault(option.group, []).append(option)
    return found


def _draw_group(layout: Any, title: str, shown: list[Option], options: Any, obj: Any) -> None:
    if not shown:
        return
    layout.separator(factor=0.5)
    column = layout.column(align=True)
    if title:
        column.label(text=title)
    for option in shown:
        _draw_option(column, option, options, obj)


def _draw_option(column: Any, option: Option, options: Any, obj: Any) -> None:
    if option.kind == "VERTEX_GROUP" and obj is not None:
        column.prop_search(options, option.name, obj, "vertex_groups")
    else:
        column.prop(options, option.name, slider=option.kind == "FACTOR" or option.slider == (-1.0, 1.0))


def register() -> None:
    setattr(
        bpy.types.WindowManager,
        ADVANCED,
        bpy.props.BoolProperty(name="Advanced", description="Show masks, pins, limits, and how the surface is found"),
    )


def unregister() -> None:
    delattr(bpy.types.WindowManager, ADVANCED)
