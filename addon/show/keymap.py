"""Entries of the keymap without a key, which Preferences, Keymap binds. Recommended: Alt Shift F for the pie menu."""

from __future__ import annotations

from typing import Any

import bpy

from .menus import VIEW3D_MT_fair_pie

_MODES = (("Mesh", "EMPTY"), ("Sculpt", "EMPTY"), ("Object Mode", "EMPTY"))
_entries: list[tuple[Any, Any]] = []


def register() -> None:
    """Add them; Blender has no keymaps in the background."""
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is None:
        return
    for mode, space in _MODES:
        keymap = configuration.keymaps.new(name=mode, space_type=space)
        entry = keymap.keymap_items.new("wm.call_menu_pie", "NONE", "PRESS")
        entry.properties.name = VIEW3D_MT_fair_pie.__name__
        _entries.append((keymap, entry))


def unregister() -> None:
    while _entries:
        keymap, entry = _entries.pop()
        keymap.keymap_items.remove(entry)
