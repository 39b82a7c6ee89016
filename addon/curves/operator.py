"""The operator that makes a surface over edges without faces: at once where that is quick, else in the background."""

from dataclasses import dataclass
from functools import cached_property

import bpy
import numpy as np

from ..fair.engine import Progress
from ..mesh import spanned
from ..mirror.symmetry import edges_with_image
from ..options.other_options import CurvesOptions
from ..options.properties import CurvesProperties
from ..run import compare, job, last_run
from ..run.operator import InEditMode
from ..run.request import RequestInEditMode, Say, done
from ..verdict.properties import store_word
from ..verdict.verdict import worst
from ..words.words import said
from .spanning import NO_WIRE, Spanned, span_arrays


@dataclass
class Request(RequestInEditMode):
    """What one run was asked for; tasks are about wires, (e,) masks."""

    @cached_property
    def size(self) -> float:
        """About as many vertices as will be new: those of a square that the curves are around."""
        edges = sum(int(np.count_nonzero(task.target)) for task in self.tasks)
        return float((edges / self.options.spacing) ** 2 / 16)

    def work(self, progress: Progress) -> list[Spanned]:
        return job.each_of(
            self.tasks,
            lambda task, part: span_arrays(task.mesh, task.target, task.matrix, self.options, part),
            progress,
        )

    def finish(self, context: bpy.types.Context, outcomes: list[Spanned], say: Say) -> set[str]:
        last_run.forget()  # there are no faces to fair again, and no two states to compare
        compare.forget()
        added = job.write_each(context, zip(self.names, outcomes, strict=True), spanned.add_to_edit_mesh)
        warnings = [each for outcome in outcomes for each in outcome.warnings]
        new = sum(len(outcome.positions) for outcome in outcomes)
        verdict = worst(outcome.verdict for outcome in outcomes)
        store_word(context.window_manager.fairing_report, self.names, new, verdict)
        cells, left = (sum(getattr(each, name) for each in outcomes) for name in ("cells", "left_open"))
        text = said("from_curves", faces=sum(each.faces for each in added), cells=cells, left=left)
        return done(say, (*warnings, *(note for each in added for note in each.notes)), text)


class MESH_OT_fair_from_curves(CurvesProperties, InEditMode, bpy.types.Operator):
    """Make a fair surface over selected edges without faces: closed curves, or a network of them.
    Edges marked sharp become creases"""

    bl_idname = "mesh.fair_from_curves"
    bl_label = "Fair From Curves"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for
    needs = NO_WIRE

    def _read(self, context: bpy.types.Context) -> Request | None:
        tasks = job.read_for_new_faces(
            context, spanned.selected_wires, lambda _obj, mesh, _matrix, wires: edges_with_image(mesh, wires)
        )
        if not tasks:
            self.nothing(context, NO_WIRE)
            return None
        return Request(tasks, CurvesOptions.of(self))
