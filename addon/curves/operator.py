"""The operator that makes a surface over edges without faces: at once where that is quick, else in the background."""

from dataclasses import dataclass
from functools import cached_property

import bpy
import numpy as np

from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Mask
from ..fair.engine import Progress
from ..host.context import edited_objects
from ..host.polling import require_edit_mode, require_idle
from ..mesh import mesh_io, spanned
from ..mirror.symmetry import edges_with_image
from ..options.options import FairOptions
from ..options.other_options import CurvesOptions
from ..options.properties import CurvesProperties
from ..options.redo_panel import draw_options
from ..run import compare, last_run
from ..run.asked import AskedInEditMode, Say
from ..run.job import Refused, each_of, write_each
from ..run.redo import Redone
from ..translations import translated
from ..verdict.properties import clear, store_refusal
from ..words.words import said
from .spanning import NO_WIRE, Spanned, span_arrays


@dataclass(frozen=True)
class Task:
    """One object's curves, as they were read."""

    object_name: str
    mesh: MeshArrays
    wires: Mask
    matrix: Floats  # (4, 4) to world space
    key: str  # the shape key that was read, as mesh_io.writable_key names it


def read(context: bpy.types.Context) -> list[Task]:
    """Read every object in edit mode that has selected edges without faces; raises Refused."""
    tasks = []
    for obj in edited_objects(context):
        wires = spanned.selected_wires(obj.data)
        if not wires.any():
            continue
        try:
            mesh_io.check_new_faces(obj)
            key = mesh_io.writable_key(obj)
            mesh = mesh_io.read_edit_mesh(obj, FairOptions(), widens=False)
        except ValueError as cause:
            raise Refused(obj.name, cause) from cause
        wires = edges_with_image(mesh, wires)
        tasks.append(Task(obj.name, mesh, wires, np.array(obj.matrix_world, dtype=np.float64), key))
    return tasks


def solve(tasks: list[Task], options: CurvesOptions, progress: Progress) -> list[Spanned]:
    """Solve task after task, on arrays alone; raises Refused and fairing.Cancelled."""
    return each_of(tasks, lambda task, part: span_arrays(task.mesh, task.wires, task.matrix, options, part), progress)


@dataclass
class Asked(AskedInEditMode):
    """What one run was asked for."""

    tasks: list[Task]
    options: CurvesOptions

    @cached_property
    def size(self) -> float:
        """About as many vertices as will be new: those of a square that the curves are around."""
        edges = sum(int(np.count_nonzero(task.wires)) for task in self.tasks)
        return (edges / self.options.spacing) ** 2 / 16

    def work(self, progress: Progress) -> list[Spanned]:
        """Find the surfaces."""
        return solve(self.tasks, self.options, progress)

    def finish(self, context: bpy.types.Context, outcomes: list[Spanned], say: Say) -> set[str]:
        """Make their faces."""
        last_run.forget()  # there are no faces to fair again, and no two states to compare
        compare.forget()
        clear(context.window_manager.fairing_report)
        added = write_each(context, zip(self.names, outcomes, strict=True), spanned.add_to_edit_mesh)
        faces = sum(each.faces for each in added)
        warnings = [each for outcome in outcomes for each in outcome.warnings]
        for warning in dict.fromkeys([*warnings, *(note for each in added for note in each.notes)]):
            say({"WARNING"}, translated(warning))
        cells, left = (sum(getattr(each, name) for each in outcomes) for name in ("cells", "left_open"))
        say({"INFO"}, translated(said("from_curves", faces=faces, cells=cells, left=left)))
        return {"FINISHED"}


class MESH_OT_fair_from_curves(CurvesProperties, Redone, bpy.types.Operator):
    """Make a fair surface over selected edges without faces: closed curves, or a network of them.
    Edges marked sharp become creases"""

    bl_idname = "mesh.fair_from_curves"
    bl_label = "Fair From Curves"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context, NO_WIRE) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        draw_options(self.layout, self, context.object, context.window_manager)

    def _read(self, context: bpy.types.Context) -> Asked | None:
        options = CurvesOptions.of(self)
        tasks = read(context)
        if not tasks:
            store_refusal(context.window_manager.fairing_report, "", NO_WIRE)
            last_run.forget()
            self.report({"ERROR"}, translated(NO_WIRE))
            return None
        return Asked(tasks, options)
