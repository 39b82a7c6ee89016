"""Puts the panels into the tab that the preferences name."""

from __future__ import annotations

import bpy

from .. import tab_name
from ..preferences import sidebar_tab
from .ui import PANELS


def move() -> None:
    """Register the panels anew where they belong into another tab."""
    wanted = sidebar_tab(bpy.context)
    if PANELS[0].bl_category == wanted:
        return
    for panel in reversed(PANELS):
        bpy.utils.unregister_class(panel)
    for panel in PANELS:
        panel.bl_category = wanted
        bpy.utils.register_class(panel)


def register() -> None:
    """Follow the preferences."""
    tab_name.listeners.append(move)
    move()


def unregister() -> None:
    """Follow them no more."""
    tab_name.listeners.remove(move)
