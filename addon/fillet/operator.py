"""The operator that rounds edges: by the mouse, or at once for scripts and the redo panel."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

import fairing

from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Mask
from ..fair.engine import Progress
from ..host.context import edited_objects
from ..host.dragging import pixel_size, say
from ..host.polling import require_edit_mode, require_idle
from ..mesh import mesh_io, remeshed, selecting
from ..mirror.symmetry import NOT_SYMMETRIC, edges_with_image
from ..options.options import FairOptions
from ..options.other_options import FilletOptions
from ..options.properties import FilletProperties
from ..options.redo_panel import draw_options
from ..run import compare, last_run
from ..run.asked import AskedInEditMode, Say
from ..run.background import TICK, has_events
from ..run.job import Refused, each_of, write_each
from ..run.redo import Redone
from ..translations import translated
from ..verdict.properties import store_refusal, store_word
from ..verdict.verdict import UNUSABLE, NotUsable, worst
from ..words.words import said
from .rounding import NO_SEAM, Rounded, round_arrays, seams_of
from .typed import Typed

PROFILE_STEP = 0.1  # of the wheel
PRECISE = 0.1  # of the mouse's way while Shift is held
PATIENCE = 2.0  # seconds for a preview: what is hard to find is sought once, when it is accepted
SLOW = said("takes_longer")


class _Handle:
    """Where the last fillet can be pulled wider."""

    flank: tuple[Floats, Floats] | None = None  # as Task.flank


handle = _Handle()
previews: list[Callable[[list[Rounded]], None]] = []  # called with what a run by the mouse would write; [] at its end


@dataclass(frozen=True)
class Task:
    """One object's seams, as they were read."""

    object_name: str
    mesh: MeshArrays
    seams: Mask
    matrix: Floats  # (4, 4) to world space
    key: str  # the shape key that was read, as mesh_io.writable_key names it

    @property
    def middle(self) -> Floats:
        """The middle of the seams, (3,) in world space."""
        ends = self.mesh.positions[np.unique(self.mesh.edges[self.seams])].mean(axis=0)
        place: Floats = self.matrix[:3, :3] @ ends + self.matrix[:3, 3]
        return place

    @property
    def length(self) -> float:
        """Of all seams, in world space."""
        ends = self.mesh.positions[self.mesh.edges[self.seams]] @ self.matrix[:3, :3].T
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum())

    @property
    def flank(self) -> tuple[Floats, Floats]:
        """The middle (3,) of the seam's middle edge in world space, and the unit direction away from it in one face."""
        points = self.mesh.transformed(self.matrix).positions
        edges = self.mesh.edges[self.seams]
        edge = edges[np.linalg.norm(points[edges].mean(axis=1) - self.middle, axis=1).argmin()]
        place, along = points[edge].mean(axis=0), points[edge[1]] - points[edge[0]]
        triangle = self.mesh.triangles[np.isin(self.mesh.triangles, edge).sum(axis=1) == 2][0]
        third = points[triangle[~np.isin(triangle, edge)][0]] - place
        away = third - along * (third @ along) / (along @ along)
        return place, away / np.linalg.norm(away)


def read(context: bpy.types.Context, group: str) -> list[Task]:
    """Read every object in edit mode that has selected seams; raises Refused. group: see FilletOptions.width_group."""
    tasks = []
    for obj in edited_objects(context):
        edges = selecting.selected_edges(obj.data)
        if not edges.any():
            continue
        try:
            mesh_io.check_new_faces(obj)
            key = mesh_io.writable_key(obj)
            mesh = mesh_io.read_edit_mesh(obj, FairOptions(vertex_group=group), widens=False)
            matrix = np.array(obj.matrix_world, dtype=np.float64)
            by_edges = not context.tool_settings.mesh_select_mode[2]
            seams = edges_with_image(mesh, seams_of(mesh.transformed(matrix), edges, by_edges))
        except ValueError as cause:
            raise Refused(obj.name, cause) from cause
        if seams.any():
            tasks.append(Task(obj.name, mesh, seams, matrix, key))
    return tasks


def solve(tasks: list[Task], options: FilletOptions, progress: Progress) -> list[Rounded]:
    """Round the seams of every task; raises Refused, and what its cause is not."""
    return each_of(tasks, lambda task, part: round_arrays(task.mesh, task.seams, task.matrix, options, part), progress)


@dataclass
class Asked(AskedInEditMode):
    """What one run was asked for."""

    tasks: list[Task]
    options: FilletOptions
    begin: float  # of the performance counter

    @cached_property
    def size(self) -> float:
        """About as many vertices as will be new: those of bands as wide as both sides."""
        options, length = self.options, sum(task.length for task in self.tasks)
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
        handle.flank = self.tasks[0].flank
        written = write_each(context, zip(self.names, outcomes, strict=True), remeshed.write_edit_mesh)
        if not all(each.is_symmetric for each in written):
            say({"WARNING"}, translated(NOT_SYMMETRIC))
        for warning in (each for outcome in outcomes for each in outcome.warnings):
            say({"WARNING"}, translated(warning))
        count = sum(each.new_vertices for each in written)
        verdict = worst(outcome.verdict for outcome in outcomes)
        store_word(context.window_manager.fairing_report, self.names, count, verdict)
        seconds = time.perf_counter() - self.begin
        say({"INFO"}, translated(said("new_vertices", n=count, seconds=seconds)))
        return {"FINISHED"}


class MESH_OT_fair_fillet(FilletProperties, Redone, bpy.types.Operator):
    """Round the selected edges, or the hard edges of the selected faces, by a fair surface within a width"""

    bl_idname = "mesh.fair_fillet"
    bl_label = "Fair Fillet"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    _asked: Asked
    _timer: Any = None
    if TYPE_CHECKING:  # made from a table
        confirm_on_release: bool
        width: float
        profile: float
        width_group: str

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode has seams; while a run is under way, the mesh is its own."""
        return require_edit_mode(cls, context, NO_SEAM) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out in groups."""
        draw_options(self.layout, self, context.object, context.window_manager)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to follow the mouse; without a window, round at once."""
        if not has_events(context) or context.region_data is None:
            return self.execute(context)
        return self._begin_with(context, lambda here: self._begin_to_follow(here, event))

    def _begin_to_follow(self, context: bpy.types.Context, event: Any) -> set[str]:
        middle = np.mean([task.middle for task in self._asked.tasks], axis=0)
        self._follow(event, pixel_size(context, middle))
        manager = context.window_manager
        self._timer = manager.event_timer_add(TICK, window=context.window)
        manager.modal_handler_add(self)
        self._say(context)
        return {"RUNNING_MODAL"}

    def _follow(self, event: Any, pixel: float) -> None:
        """Take the mouse's place as that of width 0."""
        self._pixel, self._origin, self._way = pixel, (event.mouse_x, event.mouse_y), 0.0
        self._last, self._typed, self._reason = self._origin, Typed(), ""
        self._shown: tuple[FilletOptions, list[Rounded]] | None = None
        self._wanted: FilletOptions | None = None

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Mouse: width, wheel: profile, digits: width; click accepts, Esc leaves all as it was."""
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
            self._show(context)
        elif event.type in ("MIDDLEMOUSE", "NDOF_MOTION"):
            return {"PASS_THROUGH"}
        self._say(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop; nothing was written. Blender calls this too, when it closes a window."""
        for preview in previews:
            preview([])
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

    def _show(self, context: bpy.types.Context) -> None:
        """Solve what is wanted now, and let it be seen."""
        if self._wanted is None:
            return
        wanted, self._wanted = self._wanted, None
        end = time.perf_counter() + PATIENCE
        outcomes: list[Rounded] = []
        try:
            outcomes = solve(self._asked.tasks, wanted, lambda _fraction, _stage: time.perf_counter() < end)
            self._shown, self._reason = (wanted, outcomes), ""
        except Refused as refusal:
            self._shown, self._reason = None, refusal.reason
        except fairing.Cancelled:
            self._shown, self._reason = None, SLOW
        for preview in previews:
            preview(outcomes)

    def _say(self, context: bpy.types.Context) -> None:
        width = self._typed.text or f"{self.width:.4g}"
        new = sum(len(each.result.vertices) for each in self._shown[1]) if self._shown else 0
        text = said("fillet_header", width=width, profile=self.profile, n=new, reason=self._reason)
        keys = translated(said("fillet_keys"))
        say(context, translated(text) + keys)

    def _accept(self, context: bpy.types.Context) -> set[str]:
        self.cancel(context)
        if not self._asked.is_as_read(context):
            self.report({"ERROR"}, translated(said("dropped")))
            return {"CANCELLED"}
        shown, options = self._shown, self._options()
        self._asked = replace(self._asked, options=options)
        if shown is None or shown[0] != options:
            return self._at_once(context)
        return self._asked.settle(context, lambda: shown[1], self.report)

    def _read(self, context: bpy.types.Context) -> Asked | None:
        begin = time.perf_counter()
        tasks = read(context, self.width_group)
        if not tasks:
            store_refusal(context.window_manager.fairing_report, "", NO_SEAM)
            last_run.forget()
            self.report({"ERROR"}, translated(NO_SEAM))
            return None
        return Asked(tasks, self._options(), begin)
