"""A request of a run: what was read, the work, and how the answer is written or refused."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import bpy

from ..fair.engine import Progress
from ..translations import translated
from ..verdict.properties import store_refusal
from . import compare, job, last_run
from .preview import Preview

Say = Callable[[set[str], str], object]  # an operator's report
Work = Callable[[Progress], Any]


class Request:
    """One run. Each operator has a subclass, which does the work and writes the answer."""

    if TYPE_CHECKING:
        work: Work  # gives the answer, on arrays alone: any thread; raises job.Refused and fairing.Cancelled
        is_as_read: Callable[[bpy.types.Context], bool]  # whether the meshes are as they were read
        # Writes and reports; returns an operator's status, and raises job.Refused.
        finish: Callable[[bpy.types.Context, Any, Say], set[str]]
        # For operators with a redo panel (redo.py), while the previous result is shown:
        keep_shown: Callable[[bpy.types.Context], None]  # remembers the meshes as they are now
        is_as_shown: Callable[[bpy.types.Context], bool]  # whether they still are

        @property
        def size(self) -> float:
            """Free vertices; or about how many there will be new."""

        @property
        def names(self) -> tuple[str, ...]:
            """Names of the objects."""

    begin: float = 0.0  # of reading, by the performance counter
    preview: Preview | None = None  # of what is shown while a thread is at work

    def work_aside(self, _large: bool) -> Work:
        """Return the work for a background thread; `_large`: it goes there at once."""
        return self.work

    def complete(self, context: bpy.types.Context, answer: Callable[[], Any], say: Say) -> set[str]:
        """Write and report the answer, or why it is not written; return an operator's status."""
        try:
            return self.finish(context, answer(), say)
        except job.Refused as refusal:
            return refuse(context, refusal, say)

    def swap(self, _context: bpy.types.Context) -> bool:
        """Swap the meshes as read with the previous result; return whether that was possible."""
        return False


@dataclass
class RequestInEditMode(Request):
    """One run over all objects in edit mode."""

    tasks: list[Any]  # each a job.Task or the like
    options: Any
    begin: float = 0.0
    keeps_vertices: ClassVar[bool] = False  # it moves vertices and makes none
    _shown: Sequence[job.AsRead] = field(default=(), init=False)

    @property
    def size(self) -> float:
        """Free vertices; or about how many there will be new."""
        return float(sum(task.free_count for task in self.tasks))

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(task.object_name for task in self.tasks)

    def is_as_read(self, context: bpy.types.Context) -> bool:
        return job.is_current(context, self.tasks)

    def keep_shown(self, context: bpy.types.Context) -> None:
        self._shown = job.as_they_are(context, self.tasks)

    def is_as_shown(self, context: bpy.types.Context) -> bool:
        return len(self._shown) > 0 and job.is_current(context, self._shown)

    def swap(self, context: bpy.types.Context) -> bool:
        """Only where vertices were moved: not for new ones, nor after a run on all shape keys."""
        if not self.keeps_vertices or not compare.is_available():
            return False
        try:
            compare.toggle(context)
        except compare.Changed:
            return False
        return True


def refuse(context: bpy.types.Context, refusal: job.Refused, say: Say) -> set[str]:
    """Say why nothing is written, and leave every mesh and its selection as it is."""
    store_refusal(context.window_manager.fairing_report, refusal.object_name, refusal.reason)
    last_run.forget()
    last_run.point_out(context, refusal.object_name, refusal.elements)
    say({"ERROR"}, translated(str(refusal)))
    return {"CANCELLED"}


def done(say: Say, warnings: Iterable[str], text: str) -> set[str]:
    """Report a run that was written, and return its status."""
    for warning in dict.fromkeys(warnings):
        say({"WARNING"}, translated(warning))
    say({"INFO"}, translated(text))
    return {"FINISHED"}
