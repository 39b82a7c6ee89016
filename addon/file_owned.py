"""What belongs to the file that is open. It ends when another file is opened, and when the extension is disabled.

Whatever keeps something about meshes or objects between two calls has its line in `forget`.
"""

from __future__ import annotations

from typing import Any

import bpy

from .fair.memory import memory
from .host.handlers import listen, unlisten
from .live.live import live
from .overlay import overlay
from .run import background, compare, last_run
from .selection.watch import watch
from .verdict import properties as report_properties


def forget() -> None:
    """Stop all runs first, so that none of them leaves anything behind; then drop what is kept."""
    background.stop_all()
    live.forget()
    watch.forget()
    overlay.overlay.clear()
    compare.forget()
    last_run.forget()
    memory.clear()
    report_properties.clear(bpy.context.window_manager.fairing_report)


def _before_load(*_arguments: Any) -> None:
    """A run must not outlive its file: the next one may have an object of the same name and shape."""
    background.stop_all()


def _after_load(*_arguments: Any) -> None:
    bpy.context.window_manager.fairing_live.on = False  # nobody has asked for anything in this file yet
    forget()
    overlay.refresh()


def register() -> None:
    listen(bpy.app.handlers.load_pre, _before_load)
    listen(bpy.app.handlers.load_post, _after_load)


def unregister() -> None:
    unlisten(bpy.app.handlers.load_post, _after_load)
    unlisten(bpy.app.handlers.load_pre, _before_load)
    forget()
