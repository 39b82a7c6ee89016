# mypy: disable-error-code="valid-type"
"""Changes in the redo panel: the previous result is shown at once and replaced when the new one is found.

Blender undoes the last run and calls `execute`. Small selections are solved there within PROMPT. Otherwise the previous
result is shown: moved vertices are moved again; with new vertices the operator is cancelled, and Blender restores it. A
thread, begun after the operator has ended, solves. Then Blender repeats the operator, which writes the answer: one undo
step, as always.

No postponed annotations here: Blender reads them as property definitions.
"""

import time
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty

import fairing

from ..host.context import in_view
from ..host.handlers import call_later, call_off, hear_events, listen, unlisten
from ..host.status import hide_following, redraw_sidebars, show_following
from ..verdict.properties import clear, kept, message, store_awaited
from ..words.words import said
from . import background, runner
from .background import TICK, Watched, has_events
from .request import Request, Say
from .runner import under_way

PROMPT = 0.06  # seconds for reading and an answer; with writing and undo a change stays below 0.1
SOON = 0.01  # seconds until the threads in the way are looked at again
BLINK = 0.02  # seconds that a change waits for the search before it to stop
AWAITED = said("awaited")
KEPT = said("kept_before")
GIVEN_UP = said("given_up")


class Following:
    """One change whose answer is awaited while Blender goes on."""

    def __init__(self, change: Request, operator: bpy.types.Operator, window: bpy.types.Window) -> None:
        """operator: the panel's, or a macro. Only addresses of it and its window are kept: Blender may free them."""
        self.change, self.step = change, operator.name
        self.operator, self.window = operator.as_pointer(), window.as_pointer()
        self.unwanted = False  # a button has asked for the end
        self.completed = False  # the answer is written
        self.run: runner.Run[Any] | None = None  # none yet while the operator is under way
        self.timer: bpy.types.Timer | None = None  # calls look()

    def begin(self, context: bpy.types.Context) -> None:
        """Let Blender go on; the search begins at the first look."""
        store_awaited(context.window_manager.fairing_report, self.change.names, self.change.size, AWAITED)
        under_way.append(self)
        self.show(context)
        watch()

    def search(self, context: bpy.types.Context) -> None:
        """Begin, now that the result before is there again."""
        self.change.keep_shown(context)
        self.run = runner.Run(self.change.work)

    def show(self, context: bpy.types.Context) -> None:
        show_following(context, 0.0 if self.run is None else self.run.fraction)

    def end(self, reason: str = GIVEN_UP) -> None:
        """Stop waiting; the previous result stays, and the report says why."""
        if self in under_way:
            under_way.remove(self)
        if self.timer is not None:
            bpy.context.window_manager.event_timer_remove(self.timer)
            self.timer = None
        if self.run is not None and not self.run.finished:
            self.run.cancel()
            self.run.wait(BLINK)  # what it has prepared is of use to the next one
        hide_following(bpy.context)
        bpy.context.window_manager.fairing_report.reason = reason

    def is_last(self, context: bpy.types.Context) -> bool:
        """Return whether Blender would repeat this operator, for which it needs an area."""
        kept = context.window_manager.operators
        is_same = len(kept) > 0 and kept[-1].as_pointer() == self.operator
        return is_same and context.area is not None and bool(bpy.ops.ed.undo_redo.poll())

    def complete(self, context: bpy.types.Context, say: Say) -> set[str]:
        """Write and report the answer, where the meshes are as they were read; return an operator's status."""
        assert self.run is not None
        if not self.change.is_as_read(context):
            return {"CANCELLED"}
        status = self.change.complete(context, self.run.result, say)
        self.completed = "FINISHED" in status
        return status


class _Repeat:
    """The change for which Blender repeats an operator."""

    now: Following | None = None


class Redone(Watched):
    """An operator whose changes in the redo panel don't hold Blender up."""

    if TYPE_CHECKING:
        options: Any
        as_pointer: Callable[[], int]
        _asked: Request

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Return when done, but for a change in the redo panel.

        Where a change gives nothing usable, Blender goes back to the result before it.
        """
        if _Repeat.now is not None:
            return _Repeat.now.complete(context, self.report)
        if has_events(context) and self.is_repeated(context):
            return self._begin_with(context, partial(self._change, time.perf_counter() + PROMPT))
        return super().execute(context)

    def is_repeated(self, context: bpy.types.Context) -> bool:
        """Return whether the redo panel is calling. A macro's steps are known by address: `is_repeat` isn't set."""
        if self.options.is_repeat:
            return True
        kept = context.window_manager.operators
        steps = kept[-1].macros if len(kept) else ()
        return any(step.as_pointer() == self.as_pointer() for step in steps)

    def _change(self, end: float, context: bpy.types.Context) -> set[str]:
        asked = self._asked
        if asked.size < background.LARGE:
            try:
                return asked.complete(context, lambda: asked.work(lambda *_: time.perf_counter() < end), self.report)
            except fairing.Cancelled:
                pass  # it takes longer
        kept = context.window_manager.operators
        Following(asked, kept[-1], context.window).begin(context)
        return {"FINISHED"} if asked.swap(context) else {"CANCELLED"}


def _following() -> Following | None:
    return next((each for each in under_way if isinstance(each, Following)), None)


def is_being_edited(context: bpy.types.Context) -> bool:
    """Return whether an operator that edits is under way: undo would take the mesh away from it."""
    windows = context.window_manager.windows
    return any("UNDO" in operator.bl_options for window in windows for operator in window.modal_operators)


def look(context: bpy.types.Context) -> bool:
    """Look at the search; return whether to look again."""
    following = _following()
    if following is None:
        return False
    if following.unwanted:
        following.end()
    elif following.run is None:
        following.search(context)
    elif following.run.finished and not is_being_edited(context) and not is_held():
        _collect(context, following)
    else:
        following.show(context)
    return _following() is not None


def watch() -> None:
    """Start polling as soon as the operator has ended."""
    call_later(_watch, 0.0)


def _watch() -> float | None:
    """Begin to take looks, while none of our threads runs: see `MESH_OT_fair_follow`."""
    following = _following()
    if following is None:
        return None
    if not runner.call_off_all():
        return SOON
    view = in_view(following.window)
    if view is None:
        following.end()
        return None
    with bpy.context.temp_override(**view):
        bpy.ops.mesh.fair_follow("INVOKE_DEFAULT")
    return None


class _Hand:
    """The mouse button's state when it was last queried."""

    is_down = False


def is_held() -> bool:
    """Return whether the mouse button is down, as while a field is dragged. Only an operator's event shows it."""
    bpy.ops.mesh.fair_follow("INVOKE_DEFAULT", asks=True)
    return _Hand.is_down


class MESH_OT_fair_follow(bpy.types.Operator):
    """Wait for the answer to a change in the redo panel"""

    # No timer of bpy.app: undo would take a field of the panel away while it is being edited. A field that is edited
    # lets no event through to here. And operators have a context that is Blender's own: in one of `temp_override`,
    # Blender crashes while a thread runs Python.

    bl_idname = "mesh.fair_follow"
    bl_label = "Wait for the Answer"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    asks: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})  # only whether the mouse button is down

    _following: Following | None = None

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Start polling, or with `asks` read the mouse button only."""
        if self.asks:
            _Hand.is_down = event.type == "LEFTMOUSE" and event.value not in ("RELEASE", "CLICK")
            return {"CANCELLED"}
        self._following = _following()
        assert self._following is not None
        self._following.timer = context.window_manager.event_timer_add(TICK, window=context.window)
        hear_events(context, self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Look at each event of the timer; all others are other operators' own."""
        goes_on = self._following is _following()
        if goes_on and event.type == "TIMER":
            goes_on = look(context)
        return {"PASS_THROUGH"} if goes_on else {"CANCELLED", "PASS_THROUGH"}

    def cancel(self, _context: bpy.types.Context) -> None:
        """Give it up; Blender calls this when it closes a window."""
        if self._following is not None and self._following is _following():
            self._following.end()


def _collect(context: bpy.types.Context, following: Following) -> None:
    """Have the answer written in place of what is shown."""
    change, report = following.change, context.window_manager.fairing_report
    current = change.is_as_shown(context)
    following.end(KEPT)
    with runner.holding():  # undo would have Live write as well
        if current and following.is_last(context):
            _Repeat.now = following
            try:
                bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)  # True: an undo step, by which the next change goes back
            finally:
                _Repeat.now = None
        elif current and change.swap(context):  # something else was selected meanwhile
            following.complete(context, lambda _kinds, _text: None)
            if following.completed:
                bpy.ops.ed.undo_push(message=following.step)
            else:
                change.swap(context)
    if not following.completed and not report.written and change.is_as_shown(context):
        report.reason, report.written = kept(said("not_taken", reason=message(report.reason))), True
        report.free_vertices = report.free_vertices or max(1, round(change.size))
    redraw_sidebars(context)


def _on_undo(*_arguments: object) -> None:
    """Nothing is awaited any more: a change in the panel begins with an undo, too."""
    following = _following()
    if following is not None:
        following.end()
        clear(bpy.context.window_manager.fairing_report)


def _on_redo(*arguments: object) -> None:
    """The same, except for the redo by which Blender itself restores the previous result."""
    following = _following()
    if following is not None and following.run is not None:
        _on_undo(*arguments)


def register() -> None:
    listen(bpy.app.handlers.undo_post, _on_undo)
    listen(bpy.app.handlers.redo_post, _on_redo)


def unregister() -> None:
    call_off(_watch)
    unlisten(bpy.app.handlers.redo_post, _on_redo)
    unlisten(bpy.app.handlers.undo_post, _on_undo)
