"""Panels of the sidebar, and sentences in them over as many lines as their width asks for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import blf
import bpy

from ..translations import translated

TAB = "Fairing"  # of the sidebar
UNIT = 20.0  # pixels of a button's height at scale 1
MARGINS = 3.4  # units that a panel and its scroll bar take of the sidebar
NARROWEST = 60.0  # pixels that are left for words at least
USUAL = 260.0  # pixels of a sidebar where there is none to ask


class SidebarPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = TAB


def pair(layout: Any, name: str, value: str, icon: str = "NONE") -> None:
    row = layout.split(factor=0.62)
    row.label(text=name, icon=icon)
    row.label(text=value, translate=False)


def wrapped(text: str, width: Callable[[str], float], room: float) -> Iterator[str]:
    """Yield the lines into which a text breaks between words; a word that is too long gets a line of its own."""
    line = ""
    for word in text.split():
        longer = f"{line} {word}".strip()
        if line and width(longer) > room:
            yield line
            longer = word
        line = longer
    yield line


def draw_text(layout: Any, text: str, icon: str) -> None:
    """Draw a sentence in the interface's language over as many lines as it needs: labels don't wrap."""
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in wrapped(translated(text), _width, _room(bpy.context)):
        column.label(text=line, icon=icon, translate=False)
        icon = "BLANK1"


def _scale(context: bpy.types.Context) -> float:
    return float(context.preferences.system.ui_scale) or 1.0  # 0 without a window


def _width(text: str) -> float:
    """Return how wide the interface draws a text, in pixels."""
    context = bpy.context
    blf.size(0, context.preferences.ui_styles[0].widget.points * _scale(context))
    return float(blf.dimensions(0, text)[0])


def _room(context: bpy.types.Context) -> float:
    """Return the pixels for words next to an icon in the panel that is being drawn."""
    scale = _scale(context)
    region = getattr(context, "region", None)
    whole = region.width if region is not None and region.type == "UI" else USUAL * scale
    return max(whole - (MARGINS + 1.0) * UNIT * scale, NARROWEST * scale)
