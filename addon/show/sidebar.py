"""What the sidebar's panels share."""

from __future__ import annotations

from typing import Any

from ..host.status import TAB


class SidebarPanel:
    """A panel of the sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = TAB


def pair(layout: Any, name: str, value: str, icon: str = "NONE") -> None:
    """Draw a name with a value beside it."""
    row = layout.split(factor=0.62)
    row.label(text=name, icon=icon)
    row.label(text=value, translate=False)
