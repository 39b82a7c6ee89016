"""The operator that rounds edges: by the mouse, or at once for scripts and the redo panel."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

import fairing

from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Mask
from ..fair.engine import Progress
from ..host.dragging import pixel_size, say
from ..host.handlers import hear_events
from ..mesh import remeshed, selecting
from ..mirror.symmetry import NOT_SYMMETRIC, edges_with_image
from ..options.options import FairOptions
from ..options.other_options import FilletOptions
from ..options.properties import FilletProperties
from ..run import compare, last_run
from ..run.background import MOMENT, TICK, Watched, has_events
from ..run.job import Refused, Task, each_of, read_for_new_faces, write_each
from ..run.operator import InEditMode
from ..run.request import RequestInEditMode, Say, done
from ..run.runner import Run
from ..show.preview import show
from ..translations import translated
from ..verdict.properties import store_word
from ..verdict.verdict import UNUSABLE, NotUsable, worst
from ..words.words import said
from .rounding import NO_SEAM, Rounded, round_arrays, seams_of
from .typed import Typed

PROFILE_STEP = 0.1  # of the wheel
PRECISE = 0.1  # of the mouse's distance while Shift is held
PATIENCE = 2.0  # seconds for a preview: a search that takes longer gives way to the next one
SLOW = said("takes_longer")


def read(context: bpy.types.Context, group: str) -> list[Task]:
    """Read every object in edit mode that has selected seams; raises Refused. group: see FilletOptions.width_group."""
    by_edges = not context.tool_settings.mesh_select_mode[2]

    def seams(_obj: bpy.types.Object, mesh: MeshArrays, matrix: Floats, edges: Mask) -> Mask | None:
        found = edges_with_image(mesh, seams_of(mesh.transformed(matrix), edges, by_edges))
        return found if found.any() else None

    return read_for_new_faces(context, selecting.selected_edges, seams, FairOptions(vertex_group=group))


def _middle(task: Task) -> Floats:
    """Return the middle of the seams, (3,) in world space."""
    ends = task.mesh.positions[np.unique(task.mesh.edges[task.target])].mean(axis=0)
    place: Floats = task.matrix[:3, :3] @ ends + task.matrix[:3, 3]
    return place


def _length(task: Task) -> float:
    """Return that of all seams, in world space."""
    ends = task.mesh.positions[task.mesh.edges[task.target]] @ task.matrix[:3, :3].T
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())


def solve(tasks: list[Task], options: FilletOptions, progress: Progress) -> list[Rounded]:
    """Round the seams of every task; raises Refused and fairing.Cancelled."""
    return each_of(tasks, lambda task, part: round_arrays(task.mesh, task.target, task.matrix, options, part), progress)


@dataclass
class Request(RequestInEditMode):
    """What one run was asked for; tasks are about seams, (e,) masks."""

    @cached_property
    def size(self) -> float:
        """About as many vertices as will be new: those of bands as wide as both sides."""
        options, length = self.options, sum(map(_length, self.tasks))
        width = options.width or 0.02 * length  # a guess: the seams alone don't tell it
        width_2 = options.width_2 or width
        return length * (width + width_2) / (options.spacing or 0.25 * min(width, width_2)) ** 2

    def work(self, progress: Progress) -> list[Rounded]:
        """Find the surfaces."""
        return solve(self.tasks, self.options, progress)

    def finish(self, context: bpy.types.Context, outcomes: list[Rounded], say: Say) -> set[str]:
        """Let them take the place of old faces."""
        for task, outcome in zip(self.tasks, outcomes, strict=True):
            verdict = outcome.verdict
            if verdict.grade == UNUSABLE:
                raise Refused(task.object_name, NotUsable(verdict, outcome.result))
        last_run.forget()  # there are no faces to fair again, and no two states to compare
        compare.forget()
        written = write_each(context, zip(self.names, outcomes, strict=True), remeshed.write_edit_mesh)
        if not all(each.is_symmetric for each in written):
            say({"WARNING"}, translated(NOT_SYMMETRIC))
        count = sum(each.new_vertices for each in written)
        verdict = worst(outcome.verdict for outcome in outcomes)
        store_word(context.window_manager.fairing_report, self.names, count, verdict)
        seconds = time.perf_counter() - self.begin
        warnings = [each for outcome in outcomes for each in outcome.warnings]
        return done(say, warnings, said("new_vertices", n=count, seconds=seconds))


class MESH_OT_fair_fillet(FilletProperties, InEditMode, bpy.types.Operator):
    """Round the selected edges, or the hard edges of the selected faces, with a fair surface"""

    bl_idname = "mesh.fair_fillet"
    bl_label = "Fair Fillet"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    needs = NO_SEAM
    _asked: Request
    _timer: Any = None
    _search: Run[list[Rounded]] | None = None  # aside, for the options of `_asked`
    if TYPE_CHECKING:  # made from a table
        confirm_on_release: bool
        width: float
        profile: float
        width_group: str

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to follow the mouse; without a window, round at once."""
        if not has_events(context) or context.region_data is None:
            return self.execute(context)
        return self._begin_with(context, lambda here: self._begin_to_follow(here, event))

    def _begin_to_follow(self, context: bpy.types.Context, event: Any) -> set[str]:
        middle = np.mean([_middle(task) for task in self._asked.tasks], axis=0)
        self._follow(event, pixel_size(context, middle))
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        hear_events(context, self)
        self._say(context)
        return {"RUNNING_MODAL"}

    def _follow(self, event: Any, pixel: float) -> None:
        """Take the mouse's place as that of width 0."""
        self._pixel, self._origin, self._way = pixel, (event.mouse_x, event.mouse_y), 0.0
        self._last, self._typed, self._reason = self._origin, Typed(), ""
        self._found: list[Rounded] | None = None  # by the search; None while it goes on
        self._wanted: FilletOptions | None = None

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Mouse: width, wheel: profile, digits: width; click accepts, Esc leaves all as it was."""
        if self._run is not None:
            return Watched.modal(self, context, event)
        if event.type in ("ESC", "RIGHTMOUSE") and event.value == "PRESS":
            self.cancel(context)
            return {"CANCELLED"}
        released = self.confirm_on_release and event.type == "LEFTMOUSE" and event.value == "RELEASE"
        if released or (event.type in ("LEFTMOUSE", "RET", "NUMPAD_ENTER") and event.value == "PRESS"):
            return self._accept(context)
        if event.type == "MOUSEMOVE":
            self._drag(event)
        elif event.type in ("WHEELUPMOUSE", "WHEELDOWNMOUSE"):
            step = PROFILE_STEP if event.type == "WHEELUPMOUSE" else -PROFILE_STEP
            self.profile = min(1.0, max(-1.0, round(self.profile + step, 6)))
            self._wanted = self._options()
        elif event.value == "PRESS" and self._typed.take(event.type, getattr(event, "ascii", "")):
            if self._typed.value:
                self.width = self._typed.value
                self._wanted = self._options()
        elif event.type == "TIMER":
            self._show()
        elif event.type in ("MIDDLEMOUSE", "NDOF_MOTION"):
            return {"PASS_THROUGH"}
        self._say(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop; nothing was written. Blender calls this too, when it closes a window."""
        if self._search is not None:
            self._search.cancel()
        Watched.cancel(self, context)
        self._follow_no_more(context)

    def _follow_no_more(self, context: bpy.types.Context) -> None:
        show([])
        say(context, None)
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None

    def _drag(self, event: Any) -> None:
        place = (event.mouse_x, event.mouse_y)
        share = PRECISE if event.shift else 1.0
        before, after = (np.hypot(*np.subtract(at, self._origin)) for at in (self._last, place))
        self._way = max(0.0, self._way + share * float(after - before))
        self._last = place
        if not self._typed.text and self._way > 0.0:
            self.width = self._pixel * self._way
            self._wanted = self._options()

    def _options(self) -> FilletOptions:
        return FilletOptions.of(self)

    def _show(self) -> None:
        """Let what was found be seen, and search for what is wanted now."""
        search = self._search
        if search is not None and self._found is None:
            if not search.finished:
                if time.perf_counter() > self._asked.begin + PATIENCE:
                    self._reason = SLOW
                    if self._wanted is not None:
                        search.cancel()
                return
            self._found, self._reason = [], ""
            try:
                self._found = search.result()
            except Refused as refusal:
                self._reason = refusal.reason
            except fairing.Cancelled:
                self._reason = SLOW
            show([(*found.surface, np.ones(len(found.surface[0]))) for found in self._found])
        if self._wanted is not None:
            self._asked = replace(self._asked, options=self._wanted, begin=time.perf_counter())
            self._search, self._found, self._wanted = Run(self._asked.work), None, None

    def _say(self, context: bpy.types.Context) -> None:
        width = self._typed.text or f"{self.width:.4g}"
        new = sum(len(each.result.vertices) for each in self._found or ())
        text = said("fillet_header", width=width, profile=self.profile, n=new, reason=self._reason)
        keys = translated(said("fillet_keys"))
        say(context, translated(text) + keys)

    def _accept(self, context: bpy.types.Context) -> set[str]:
        """Finish with the options chosen, in the background where that takes a while."""
        self._follow_no_more(context)
        if not self._asked.is_as_read(context):
            self.report({"ERROR"}, translated(said("dropped")))
            return {"CANCELLED"}
        options, search = self._options(), self._search
        if search is None or search.cancelled or self._asked.options != options:
            if search is not None:
                search.cancel()
            self._asked = replace(self._asked, options=options, begin=time.perf_counter())
            search = Run(self._asked.work)
        return self._await(context, search, MOMENT)

    def _read(self, context: bpy.types.Context) -> Request | None:
        options = self._options()
        tasks = read(context, options.width_group)
        if not tasks:
            self.nothing(context, NO_SEAM)
        return Request(tasks, options) if tasks else None
