"""The operator that fills holes and joins boundary loops: at once where that is quick, else in the background."""

import time
from dataclasses import dataclass
from functools import cached_property

import bpy
import numpy as np

from ..arrays.border import NO_BORDER, left_by
from ..arrays.region import MeshArrays
from ..arrays.types import Floats
from ..curves.spanning import WIRES_ALONE
from ..fair.engine import REFUSALS, Progress, sub_range
from ..host.context import edited_objects
from ..host.polling import require_edit_mode, require_idle
from ..mesh import filled, mesh_io
from ..mesh.spanned import selected_wires
from ..options.options import FairOptions
from ..options.other_options import FillOptions
from ..options.properties import FillProperties
from ..options.redo_panel import draw_options
from ..run import compare, last_run
from ..run.asked import AskedInEditMode, Say
from ..run.job import Refused, show_vertices, write_each
from ..run.redo import Redone
from ..translations import translated
from ..verdict.properties import store, store_refusal
from ..verdict.report import summary
from ..words.words import said
from .filling import fill_borders
from .holes import Borders, borders_at, chosen_borders
from .pieces import Filled
from .report import make_fill_report, writable


@dataclass(frozen=True)
class Task:
    """One object's holes, as they were read."""

    object_name: str
    mesh: MeshArrays
    matrix: Floats  # (4, 4) to world space
    borders: Borders
    key: str  # the shape key that was read, as mesh_io.writable_key names it

    def expected_vertices(self, options: FillOptions) -> float:
        """Return about how many vertices will be new."""
        return self.borders.expected_vertices(self.matrix, options.bridge) / options.spacing**2


def read(context: bpy.types.Context, options: FillOptions) -> list[Task]:
    """Read every object in edit mode that has a selected border; raises Refused."""
    tasks = []
    for obj in edited_objects(context):
        seeds = filled.border_seeds(obj.data)
        if not seeds.any():
            continue
        try:
            mesh_io.check_new_faces(obj)
            key = mesh_io.writable_key(obj)
            mesh = mesh_io.read_edit_mesh(obj, FairOptions(), widens=False)
            matrix = np.array(obj.matrix_world, dtype=np.float64)
            found = borders_at(mesh, seeds)
            # Where all faces are selected, too, no border was chosen.
            every = obj.data.count_selected_items()[2] == len(mesh.in_patch)
            borders = chosen_borders(matrix, found, options, every)
        except ValueError as cause:
            raise Refused(obj.name, cause) from cause
        if not len(borders.vertices):  # a Mirror modifier closes them
            continue
        tasks.append(Task(obj.name, mesh, matrix, borders, key))
    return tasks


def solve(tasks: list[Task], options: FillOptions, progress: Progress) -> list[Filled]:
    """Solve task after task, on arrays alone; raises fairing.Cancelled, and Refused where there is no surface."""
    outcomes = []
    refused: Refused | None = None
    for i, task in enumerate(tasks):
        part = sub_range(progress, i / len(tasks), (i + 1) / len(tasks))
        try:
            outcomes.append(fill_borders(task.borders, task.matrix, options, part))
        except REFUSALS as cause:
            refused = refused or Refused(task.object_name, cause)
            outcomes.append(Filled([], (*task.borders.left, left_by(cause, task.borders.vertices))))
    if refused is not None and not any(found.pieces for found in outcomes):
        raise refused from refused.cause
    return outcomes


@dataclass
class Asked(AskedInEditMode):
    """What one run was asked for."""

    tasks: list[Task]
    options: FillOptions
    begin: float  # of the performance counter

    @cached_property
    def size(self) -> float:
        """About as many vertices as will be new."""
        return sum(task.expected_vertices(self.options) for task in self.tasks)

    def work(self, progress: Progress) -> list[Filled]:
        """Find the surfaces."""
        return solve(self.tasks, self.options, progress)

    def finish(self, context: bpy.types.Context, outcomes: list[Filled], say: Say) -> set[str]:
        """Make their faces."""
        named = list(zip(self.names, outcomes, strict=True))
        report = make_fill_report(named, self.options, time.perf_counter() - self.begin)
        last_run.forget()  # there are no faces to fair again, and no two states to compare
        if not report.written:
            store(context.window_manager.fairing_report, report)
            if len(self.tasks) == 1:  # the boundary where the surface is no good
                show_vertices(context, self.tasks[0].object_name, report.verdict.spots)
            say({"ERROR"}, translated(summary(report)))
            return {"CANCELLED"}
        compare.forget()
        named = writable(named, self.options)
        added = write_each(context, [pair for pair in named if pair[1].pieces], filled.add_to_edit_mesh)
        for name, of_one in named:
            show_vertices(context, name, of_one.left_vertices)
        notes = tuple(note for task in self.tasks for note in task.borders.notes)
        report = make_fill_report(named, self.options, time.perf_counter() - self.begin, added, notes)
        store(context.window_manager.fairing_report, report)
        for warning in report.warnings:
            say({"WARNING"}, translated(warning))
        say({"INFO"}, translated(summary(report)))
        return {"FINISHED"}


class MESH_OT_fair_fill(FillProperties, Redone, bpy.types.Operator):
    """Fill the holes whose boundaries are selected, in part or whole, or join them,
    with the fair surface that continues their surroundings"""

    bl_idname = "mesh.fair_fill"
    bl_label = "Fair Fill"
    bl_options = {"REGISTER", "UNDO", "PRESET"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context, said("select_boundary")) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        draw_options(self.layout, self, context.object, context.window_manager)

    def _read(self, context: bpy.types.Context) -> Asked | None:
        begin = time.perf_counter()
        options = FillOptions.of(self)
        tasks = read(context, options)
        if not tasks:
            wires = any(selected_wires(obj.data).any() for obj in edited_objects(context))
            reason = WIRES_ALONE if wires else NO_BORDER
            store_refusal(context.window_manager.fairing_report, "", reason)
            last_run.forget()
            self.report({"ERROR"}, translated(reason))
            return None
        return Asked(tasks, options, begin)
