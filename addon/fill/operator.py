"""The operator that fills holes and joins boundary loops: at once where that is quick, else in the background."""

import time
from functools import cached_property

import bpy

from ..arrays.border import NO_BORDER, left_by
from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Mask
from ..curves.spanning import WIRES_ALONE
from ..fair.engine import REFUSALS, Progress
from ..host.context import edited_objects
from ..mesh import filled
from ..mesh.spanned import selected_wires
from ..options.other_options import FillOptions
from ..options.properties import FillProperties
from ..run import compare, last_run
from ..run.job import Refused, Task, each_of, read_for_new_faces, show_vertices, write_each
from ..run.operator import InEditMode
from ..run.request import RequestInEditMode, Say, done
from ..translations import translated
from ..verdict.properties import store
from ..verdict.report import summary
from ..words.words import said
from .filling import fill_borders
from .holes import Borders, borders_at, chosen_borders
from .pieces import Filled
from .report import make_fill_report, writable


def read(context: bpy.types.Context, options: FillOptions) -> list[Task]:
    """Read every object in edit mode that has a selected border, with its borders; raises Refused."""

    def borders(obj: bpy.types.Object, mesh: MeshArrays, matrix: Floats, seeds: Mask) -> Borders | None:
        # Where all faces are selected, too, no border was chosen.
        every = obj.data.count_selected_items()[2] == len(mesh.in_patch)
        found = chosen_borders(matrix, borders_at(mesh, seeds), options, every)
        return found if len(found.vertices) else None  # a Mirror modifier closes them

    return read_for_new_faces(context, filled.border_seeds, borders)


def solve(tasks: list[Task], options: FillOptions, progress: Progress) -> list[Filled]:
    """Solve task after task, on arrays alone; raises fairing.Cancelled, and Refused where there is no surface."""
    refusals: list[Refused] = []

    def fill(task: Task, part: Progress | None) -> Filled:
        try:
            return fill_borders(task.target, task.matrix, options, part)
        except REFUSALS as cause:
            refusals.append(Refused(task.object_name, cause))
            return Filled([], (*task.target.left, left_by(cause, task.target.vertices)))

    outcomes = each_of(tasks, fill, progress)
    if refusals and not any(found.pieces for found in outcomes):
        raise refusals[0] from refusals[0].cause
    return outcomes


class Request(RequestInEditMode):
    """What one run was asked for; tasks are about borders."""

    @cached_property
    def size(self) -> float:
        """About as many vertices as will be new."""
        new = sum(task.target.expected_vertices(task.matrix, self.options.bridge) for task in self.tasks)
        return float(new / self.options.spacing**2)

    def work(self, progress: Progress) -> list[Filled]:
        return solve(self.tasks, self.options, progress)

    def finish(self, context: bpy.types.Context, outcomes: list[Filled], say: Say) -> set[str]:
        named = list(zip(self.names, outcomes, strict=True))
        report = make_fill_report(named, self.options, time.perf_counter() - self.begin)
        last_run.forget()  # there are no faces to fair again, and no two states to compare
        if not report.written:
            store(context.window_manager.fairing_report, report)
            if len(self.tasks) == 1:  # the boundary where the surface is no good
                last_run.point_out(context, self.tasks[0].object_name, report.verdict.spots)
            say({"ERROR"}, translated(summary(report)))
            return {"CANCELLED"}
        compare.forget()
        named = writable(named, self.options)
        added = write_each(context, [pair for pair in named if pair[1].pieces], filled.add_to_edit_mesh)
        for name, of_one in named:
            show_vertices(context, name, of_one.left_vertices)
        notes = tuple(note for task in self.tasks for note in task.target.notes)
        report = make_fill_report(named, self.options, time.perf_counter() - self.begin, added, notes)
        store(context.window_manager.fairing_report, report)
        return done(say, report.warnings, summary(report))


class MESH_OT_fair_fill(FillProperties, InEditMode, bpy.types.Operator):
    """Fill the holes whose boundaries are selected, in part or whole, or join them,
    with the fair surface that continues their surroundings"""

    bl_idname = "mesh.fair_fill"
    bl_label = "Fair Fill"
    bl_options = {"REGISTER", "UNDO", "PRESET"}  # noqa: RUF012 - the form that Blender asks for
    needs = said("select_boundary")

    def _read(self, context: bpy.types.Context) -> Request | None:
        options = FillOptions.of(self)
        tasks = read(context, options)
        if tasks:
            return Request(tasks, options)
        wires = any(selected_wires(obj.data).any() for obj in edited_objects(context))
        self.nothing(context, WIRES_ALONE if wires else NO_BORDER)
        return None
