"""Keeps the panel's picture of the selection up to date without ever computing while it is drawn.

A depsgraph handler, O(1), notes that something changed. Drawing the panel then asks for a look, which
a timer takes a moment later, and large meshes are looked at on demand only.
"""

from __future__ import annotations

import time

import bpy

from ..host.context import edited_objects
from ..host.handlers import call_later, call_off, is_edited, listen, unlisten
from ..host.polling import require_edit_mode
from ..host.status import redraw_sidebars
from ..mesh import selecting
from .inspection import Inspection, inspect, last_options

LARGE = 30_000  # faces: a look takes about .15 s
DELAY = 0.2  # seconds without a change, before the look: never in the middle of a drag


class Watch:
    """The last inspection and whether it still holds."""

    def __init__(self) -> None:
        self.found: tuple[Inspection, ...] = ()
        self.stale = True
        self.changed_at = 0.0  # by time.monotonic

    def look(self, context: bpy.types.Context) -> None:
        options = last_options(context)
        self.found = tuple(inspect(obj, options) for obj in edited_objects(context))
        self.stale = False

    def forget(self) -> None:
        self.found, self.stale = (), True


watch = Watch()


def is_large(context: bpy.types.Context) -> bool:
    """Return whether a look would be felt."""
    faces = sum(selecting.face_count(obj.data) for obj in edited_objects(context))
    return faces > LARGE


def request(context: bpy.types.Context) -> None:
    """Have the selection looked at soon, if it has changed; for drawing code."""
    if watch.stale and not is_large(context):
        call_later(_look_later, DELAY)


def _look_later() -> float | None:
    """Look, or return the seconds to wait until the changes may have ended."""
    wait = watch.changed_at + DELAY - time.monotonic()
    if wait > 0.0:
        return wait
    context = bpy.context
    if context.mode == "EDIT_MESH" and watch.stale:
        watch.look(context)
        redraw_sidebars(context)
    return None


def _on_change(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    if is_edited(depsgraph):
        watch.stale, watch.changed_at = True, time.monotonic()


class MESH_OT_fair_inspect(bpy.types.Operator):
    """Look at the selection: what is free to move, and what would be refused"""

    bl_idname = "mesh.fair_inspect"
    bl_label = "Look at Selection"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Look now, however large the mesh."""
        watch.look(context)
        return {"FINISHED"}


def register() -> None:
    listen(bpy.app.handlers.depsgraph_update_post, _on_change)


def unregister() -> None:
    unlisten(bpy.app.handlers.depsgraph_update_post, _on_change)
    call_off(_look_later)
