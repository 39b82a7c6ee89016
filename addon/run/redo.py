"""Changes in the redo panel: the first surface at once, the fair one in its place as soon as it is found.

Blender takes the last run's step of undo back and calls `execute`, which ends here within PROMPT. When the answer is
there, a timer has Blender do the same once more: as ever there is one step of undo, with the answer in it.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

import bpy

from ..core import runner
from ..core.outcome import Fairing
from ..host.handlers import call_later, listen, unlisten
from ..host.status import hide_following, redraw_sidebars, show_following
from . import job
from .background import MOMENT, TICK, Watched, has_events, under_way
from .finish import Asked, Say, finish, refuse
from .preview import Preview
from .report_properties import clear, store_first

# Off: in one of 44 sessions of its tests, headless, Python crashed while a search ran beside `ed.undo_redo`.
IS_ON = False
PROMPT = 0.06  # seconds from the begin of reading in which an answer needs no first surface
SLICE = 0.005  # seconds between two looks at the thread
BLINK = 0.02  # seconds that a change waits for the search before it to stop
AWAITED = "Looking for a fair surface: a smooth one is shown meanwhile"
KEPT = "A smooth surface was kept: the mesh changed before the fair one was found"
GIVEN_UP = "A smooth surface was kept: the search for the fair one was cancelled"


class Following:
    """One change whose answer is awaited while Blender goes on."""

    def __init__(self, asked: Asked, operator: int, window: int) -> None:
        """Begin the search. operator: where Blender keeps the one in its panel, maybe a macro; window: likewise."""
        self.asked, self.operator, self.window = asked, operator, window
        self.unwanted = False  # a button has asked for the end
        self.preview = Preview(asked.tasks)
        self.run: runner.Run[list[Fairing]] = runner.Run(
            partial(job.solve, asked.tasks, asked.options, give=self.preview.give)
        )

    def is_there_soon(self) -> bool:
        """Wait for the answer until PROMPT, or for the first surface until MOMENT.

        Until then the thread makes arrays in Python. It shouldn't while Blender ends the operator, without Python.
        """
        while not self.run.wait(SLICE):
            passed = time.perf_counter() - self.asked.begin
            if passed > (PROMPT if self.preview.is_given else MOMENT):
                return False
        return True

    def begin(self, context: bpy.types.Context) -> None:
        """Let Blender go on, and look at the search from now on."""
        clear(context.window_manager.fairing_report)
        under_way.append(self)
        self.show(context)
        call_later(_look, TICK)

    def show(self, context: bpy.types.Context) -> None:
        """Show how far it is, and the first surface where there is one."""
        self.preview.show()
        report, tasks = context.window_manager.fairing_report, self.asked.tasks
        if self.preview.is_shown and not report.written:
            store_first(report, [task.object_name for task in tasks], job.size(tasks), AWAITED)
        show_following(context, self.run.fraction)

    def end(self, reason: str = "") -> None:
        """Await it no more; a first surface stays, for which the report then gives this reason."""
        if self in under_way:
            under_way.remove(self)
        if not self.run.finished:
            self.run.cancel()
            self.run.wait(BLINK)  # what it has prepared is of use to the next one
        hide_following(bpy.context)
        if reason and self.preview.is_shown:
            bpy.context.window_manager.fairing_report.reason = reason

    @contextmanager
    def place(self) -> Iterator[bpy.types.Context]:
        """Give a timer the context of an operator: a window and a 3D view in it."""
        windows = bpy.context.window_manager.windows
        window = next((each for each in windows if each.as_pointer() == self.window), windows[0])
        given: dict[str, Any] = {"window": window, "screen": window.screen}
        area = next((each for each in window.screen.areas if each.type == "VIEW_3D"), None)
        if area is not None:
            given |= {"area": area, "region": next(each for each in area.regions if each.type == "WINDOW")}
        with bpy.context.temp_override(**given):
            yield bpy.context

    def is_last(self, context: bpy.types.Context) -> bool:
        """Return whether it is this operator that Blender would repeat."""
        kept = context.window_manager.operators
        return len(kept) > 0 and kept[-1].as_pointer() == self.operator and bool(bpy.ops.ed.undo_redo.poll())

    def is_current(self, context: bpy.types.Context) -> bool:
        """Return whether the meshes are as they were read, but for the first surfaces."""
        return job.is_current(context, self.preview.tasks_as_shown())

    def settle(self, context: bpy.types.Context, say: Say) -> None:
        """Write and report the answer."""
        try:
            finish(context, self.asked, self.run.result(), say)
        except job.Refused as refusal:
            refuse(context, self.asked.tasks, refusal, say)


class _Repeat:
    """The change that we have Blender repeat an operator for."""

    now: Following | None = None


class Redone(Watched):
    """An operator whose changes in the redo panel don't hold Blender up."""

    if TYPE_CHECKING:
        options: Any
        as_pointer: Callable[[], int]
        _asked: Callable[[], Asked]

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Return when done, but for a change in the redo panel."""
        if not (IS_ON and has_events(context) and self._is_repeated(context)):
            return super().execute(context)
        # What is not written counts as done, too: the mesh is as it was before the run, and the panel stays.
        found = _Repeat.now
        if found is not None and job.is_current(context, found.asked.tasks):
            found.settle(context, self.report)
        else:
            self._begin_with(context, self._change)
        return {"FINISHED"}

    def _is_repeated(self, context: bpy.types.Context) -> bool:
        """Return whether the redo panel calls, of a macro as well: its steps are not told."""
        if self.options.is_repeat:
            return True
        kept = context.window_manager.operators
        steps = kept[-1].macros if len(kept) else ()
        return any(step.as_pointer() == self.as_pointer() for step in steps)

    def _change(self, context: bpy.types.Context) -> set[str]:
        kept = context.window_manager.operators
        following = Following(self._asked(), kept[-1].as_pointer(), context.window.as_pointer())
        if following.is_there_soon():
            following.settle(context, self.report)
        else:
            following.begin(context)
        return {"FINISHED"}


def _following() -> Following | None:
    return next((each for each in under_way if isinstance(each, Following)), None)


def is_being_edited(context: bpy.types.Context) -> bool:
    """Return whether an operator that edits is under way: undo would take the mesh away from it."""
    windows = context.window_manager.windows
    return any("UNDO" in operator.bl_options for window in windows for operator in window.modal_operators)


def _look() -> float | None:
    """Look at the search; a timer calls this, again after so many seconds."""
    following = _following()
    if following is not None:
        with following.place() as context:
            if following.unwanted:
                following.end(GIVEN_UP)
            elif is_being_edited(context):
                show_following(context, following.run.fraction)
            elif following.run.finished:
                _collect(context, following)
            else:
                following.show(context)
    return TICK if _following() is not None else None


def _collect(context: bpy.types.Context, following: Following) -> None:
    """Have the answer written in place of the first surface."""
    if not following.is_current(context):
        following.end(KEPT)
    elif following.is_last(context):
        following.end()
        _Repeat.now = following
        try:
            bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)  # True: a step of undo for the next one to go back by
        finally:
            _Repeat.now = None
    else:  # something else was selected meanwhile
        following.end()
        following.preview.take_back()
        following.settle(context, lambda _kinds, _text: None)
        bpy.ops.ed.undo_push(message="Fair Region")
    redraw_sidebars(context)


def _on_step(*_arguments: object) -> None:
    """After an undo or a redo nothing is awaited any more: a change in the panel begins with an undo, too."""
    following = _following()
    if following is not None:
        following.end()
        clear(bpy.context.window_manager.fairing_report)


def register() -> None:
    """Hear of steps of undo."""
    listen(bpy.app.handlers.undo_post, _on_step)
    listen(bpy.app.handlers.redo_post, _on_step)


def unregister() -> None:
    """Hear of them no more."""
    unlisten(bpy.app.handlers.redo_post, _on_step)
    unlisten(bpy.app.handlers.undo_post, _on_step)
