"""Listening to Blender's events and its clock, and ceasing to in time.

The module bpy 4.2 crashes at exit where a handler or a timer is left.
"""

from __future__ import annotations

import atexit
from collections.abc import Callable
from typing import Any

import bpy

_listening: list[tuple[list[Any], Callable[..., None]]] = []
_clocked: list[Callable[[], float | None]] = []


def listen(events: list[Any], function: Callable[..., None]) -> None:
    """Have Blender call the function, in the next file too; `events`: a list of bpy.app.handlers."""
    events.append(bpy.app.handlers.persistent(function))
    _listening.append((events, function))


def unlisten(events: list[Any], function: Callable[..., None]) -> None:
    """Take one function back, unless that has been done already."""
    # By identity: two lists of events that happen to hold the same functions are equal.
    for index, (list_of, listener) in enumerate(_listening):
        if list_of is events and listener is function:
            del _listening[index]
            events.remove(function)
            return


def call_later(function: Callable[[], float | None], seconds: float) -> None:
    """Call the function on the main thread, again after the seconds that it returns.

    Once more makes no difference before that.
    """
    if not bpy.app.timers.is_registered(function):
        bpy.app.timers.register(function, first_interval=seconds)
        if function not in _clocked:
            _clocked.append(function)


def call_off(function: Callable[[], float | None]) -> None:
    if bpy.app.timers.is_registered(function):
        bpy.app.timers.unregister(function)


def hear_events(context: bpy.types.Context, operator: Any) -> None:
    """Have Blender hand events to a modal operator, once: a second handler outlives it and swallows what follows."""
    if not getattr(operator, "hears_events", False):
        operator.hears_events = True
        context.window_manager.modal_handler_add(operator)


def is_edited(depsgraph: bpy.types.Depsgraph) -> bool:
    """Return whether a mesh changed, its selection included, or an object was moved.

    Copies that are made for reading show up as other kinds of updates, which must not count: each look
    would be the reason for the next one.
    """
    return any(
        isinstance(update.id, bpy.types.Mesh)
        or (isinstance(update.id, bpy.types.Object) and (update.is_updated_transform or update.is_updated_geometry))
        for update in depsgraph.updates
    )


def stop() -> None:
    for events, function in tuple(_listening):
        unlisten(events, function)
    while _clocked:
        call_off(_clocked.pop())


def register() -> None:
    atexit.register(stop)


def unregister() -> None:
    stop()
    atexit.unregister(stop)
