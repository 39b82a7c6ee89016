"""Operators that may take long: at once for scripts and where it takes but a moment, else watched in the background."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import bpy

from ..fair.engine import Progress
from ..host.handlers import hear_events
from ..host.status import CANCEL, hide_progress, over_buttons, show_progress
from ..translations import translated
from ..words.words import said
from . import job, runner
from .preview import Preview
from .request import Request, Work, refuse
from .runner import under_way

CANCELLED = said("cancelled")
TICK = 0.05  # seconds between two looks at the thread
MOMENT = 0.3  # seconds that Blender may stand still for an answer
LARGE = 4000  # free vertices that take longer in any case

# Looking around does no harm while the engine works; all else would.
_VIEW_EVENTS = {
    "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE",
    "NUMPAD_1", "NUMPAD_3", "NUMPAD_5", "NUMPAD_7", "NUMPAD_PERIOD", "NDOF_MOTION",
}  # fmt: skip

_POINTER_EVENTS = {"LEFTMOUSE", "MOUSEMOVE", "INBETWEEN_MOUSEMOVE"}  # to the button that cancels


def has_events(context: bpy.types.Context) -> bool:
    return not bpy.app.background and context.window is not None


def at_once(context: bpy.types.Context, work: Work) -> Any:
    """Return what the work gives, with Blender's own progress at the cursor."""
    manager = context.window_manager
    manager.progress_begin(0.0, 1.0)
    show: Progress = lambda fraction, _stage: manager.progress_update(fraction)  # noqa: E731
    try:
        return work(show)
    finally:
        manager.progress_end()


class Signs:
    """The timer and progress displays of a run: pointer, status bar, sidebar.

    `end` works once, called by the run's operator or by `stop_all`.
    """

    def __init__(self, context: bpy.types.Context, preview: Preview | None = None) -> None:
        self.preview = preview
        self.unwanted = False  # a button has asked for the end
        manager = context.window_manager
        self._timer = manager.event_timer_add(TICK, window=context.window)
        manager.progress_begin(0.0, 1.0)
        show_progress(context, 0.0, "")
        under_way.append(self)

    def show_preview(self) -> None:
        if self.preview is not None:
            self.preview.show()

    def end(self) -> None:
        """Take them away, unless that has been done."""
        if self in under_way:
            under_way.remove(self)
            if self.preview is not None:
                self.preview.take_back()
            manager = bpy.context.window_manager
            manager.event_timer_remove(self._timer)
            manager.progress_end()
            hide_progress(bpy.context)


class MESH_OT_fair_cancel(bpy.types.Operator):
    """Give the run up; nothing changes"""

    bl_idname = CANCEL
    bl_label = "Cancel"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return bool(under_way)

    def execute(self, _context: bpy.types.Context) -> set[str]:
        """Have it ended at the next look at it."""
        for each in under_way:
            each.unwanted = True
        return {"FINISHED"}


def stop_all() -> None:
    """Give up every run, watched by an operator or not; returns when all their threads have ended.

    An operator that Blender still calls finds its run cancelled. Blender may also have freed it without a word.
    """
    while under_way:
        under_way[-1].end()
    runner.stop_all()


class Watched:
    """Base of operators that begin and watch a run; they add `_read`."""

    if TYPE_CHECKING:
        report: Callable[[set[str], str], None]
        # Reads the request; None where there is nothing to do, which it has reported.
        _read: Callable[[bpy.types.Context], Request | None]

    _asked: Request
    _run: runner.Run[Any] | None = None
    _signs: Signs | None = None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Do every object in edit mode, or none of them where one is refused; return when done."""
        return self._begin_with(context, self._at_once)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Do them in the background where that takes long enough to be noticed."""
        return self._begin_with(context, self._start)

    def _begin_with(self, context: bpy.types.Context, go_on: Callable[[bpy.types.Context], set[str]]) -> set[str]:
        """Read, and go on at once or in the background."""
        context.view_layer.update()  # a script may just have changed an object's matrix
        for each in tuple(under_way):
            each.end()
        begin = time.perf_counter()
        try:
            asked = self._read(context)
        except job.Refused as refusal:
            return refuse(context, refusal, self.report)
        if asked is None:
            return {"CANCELLED"}
        self._asked, asked.begin = asked, begin
        return go_on(context)

    def _at_once(self, context: bpy.types.Context) -> set[str]:
        return self._asked.complete(context, lambda: at_once(context, self._asked.work), self.report)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Watch the thread; Esc leaves the mesh as it is, and so does what calls `stop_all`."""
        assert self._run is not None
        if self._run.cancelled:
            self.cancel(context)
            return {"CANCELLED"}
        unwanted = self._signs is not None and self._signs.unwanted
        if unwanted or (event.type == "ESC" and event.value == "PRESS"):
            self.cancel(context)
            self.report({"INFO"}, translated(CANCELLED))
            return {"CANCELLED"}
        if event.type == "TIMER":
            if self._run.finished:
                return self._collect(context)
            if self._signs is not None:
                self._signs.show_preview()
            show_progress(context, self._run.fraction, self._run.stage)
        passes = event.type in _VIEW_EVENTS or (event.type in _POINTER_EVENTS and over_buttons(context, event))
        return {"PASS_THROUGH"} if passes else {"RUNNING_MODAL"}

    def cancel(self, _context: bpy.types.Context) -> None:
        """Give the run up; Blender calls this too, when it closes a window."""
        if self._run is not None:
            self._run.cancel()
        self._stop_watching()

    def _start(self, context: bpy.types.Context) -> set[str]:
        """Start the thread; wait for it a moment, unless the request is large."""
        if not has_events(context):
            return self._at_once(context)
        # The size bounds the time from below only: a selection without a fair surface may be searched for minutes.
        large = self._asked.size >= LARGE
        return self._await(context, runner.Run(self._asked.work_aside(large)), 0.0 if large else MOMENT)

    def _await(self, context: bpy.types.Context, run: runner.Run[Any], seconds: float) -> set[str]:
        """Wait for a run at most so many seconds, then watch it."""
        self._run = run
        if run.wait(seconds):
            return self._asked.complete(context, run.result, self.report)
        self._start_watching(context)
        return {"RUNNING_MODAL"}

    def _collect(self, context: bpy.types.Context) -> set[str]:
        """Write what the run came to, if its mesh is still there as it was read."""
        assert self._run is not None
        self._stop_watching()
        if not self._asked.is_as_read(context):
            self.report({"ERROR"}, translated(said("dropped")))
            return {"CANCELLED"}
        return self._asked.complete(context, self._run.result, self.report)

    def _start_watching(self, context: bpy.types.Context) -> None:
        self._signs = Signs(context, self._asked.preview)
        hear_events(context, self)

    def _stop_watching(self) -> None:
        if self._signs is not None:
            self._signs.end()
