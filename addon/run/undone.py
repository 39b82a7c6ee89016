"""A run that was undone is not shown as the last one."""

from __future__ import annotations

import bpy

from ..host.handlers import listen, unlisten
from . import compare


def _on_step(*_arguments: object) -> None:
    """After an undo or a redo: see whether the last run still stands."""
    report = bpy.context.window_manager.fairing_report
    if report.written:
        report.undone = compare.is_undone()


def register() -> None:
    listen(bpy.app.handlers.undo_post, _on_step)
    listen(bpy.app.handlers.redo_post, _on_step)


def unregister() -> None:
    unlisten(bpy.app.handlers.redo_post, _on_step)
    unlisten(bpy.app.handlers.undo_post, _on_step)
