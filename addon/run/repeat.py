"""Blender's own operators called by a timer: the last one run again, as its redo panel does.

While Python calls an operator, Blender lets other threads of Python run. Where Python has put the operator's context
together (`temp_override`), Blender then looks into it without Python's lock whenever another thread has that lock
(`BPY_context_member_get`), and crashes. A timer has no other context: it waits until none of our threads is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from ..core import runner


@contextmanager
def placed(window: int) -> Iterator[bpy.types.Context]:
    """Give a timer the context of an operator: a window, told by where Blender has it, and a 3D view in it."""
    windows = bpy.context.window_manager.windows
    chosen = next((each for each in windows if each.as_pointer() == window), windows[0])
    given: dict[str, Any] = {"window": chosen, "screen": chosen.screen}
    area = next((each for each in chosen.screen.areas if each.type == "VIEW_3D"), None)
    if area is not None:
        given |= {"area": area, "region": next(each for each in area.regions if each.type == "WINDOW")}
    with bpy.context.temp_override(**given):
        yield bpy.context


def may_call() -> bool:
    """Return whether a timer may call an operator; if not, the threads in its way have been asked to end."""
    return runner.call_off_all()


def run_last_again() -> None:
    """Have the last operator undone and run again, inside `placed` and where `may_call`."""
    bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)  # True: a step of undo for the next one to go back by
