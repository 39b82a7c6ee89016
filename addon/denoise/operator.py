"""The operator that takes the roughness from selected faces: at once where that is quick, else in the background."""

from dataclasses import dataclass

import bpy

from ..fair.engine import Progress
from ..options.options import FairOptions
from ..options.other_options import DenoiseOptions
from ..options.properties import DenoiseProperties
from ..run import compare, job, last_run
from ..run.operator import InEditMode
from ..run.request import RequestInEditMode, Say, done
from ..verdict.properties import store_word
from ..verdict.verdict import worst
from ..words.words import said
from .denoising import Denoised, denoise_arrays


@dataclass
class Request(RequestInEditMode):
    keeps_vertices = True

    def work(self, progress: Progress) -> list[Denoised]:
        return job.each_of(
            self.tasks, lambda task, part: denoise_arrays(task.mesh, task.matrix, self.options, part), progress
        )

    def finish(self, context: bpy.types.Context, outcomes: list[Denoised], say: Say) -> set[str]:
        last_run.forget()  # Fair Again only fairs
        compare.remember(self.tasks, outcomes)
        job.write_each(context, zip(self.names, outcomes, strict=True), job.write_one)
        count = sum(len(outcome.vertices) for outcome in outcomes)
        verdict = worst(outcome.verdict for outcome in outcomes)
        store_word(context.window_manager.fairing_report, self.names, count, verdict)
        warnings = [warning for outcome in outcomes for warning in outcome.warnings]
        return done(say, warnings, said("moved_by", n=count, largest=max(outcome.largest for outcome in outcomes)))


class MESH_OT_fair_denoise(DenoiseProperties, InEditMode, bpy.types.Operator):
    """Take the roughness from the selected faces and keep their shape; borders and sharp edges stay"""

    bl_idname = "mesh.fair_denoise"
    bl_label = "Fair Denoise"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    def _read(self, context: bpy.types.Context) -> Request | None:
        options = DenoiseOptions.of(self)
        tasks, _ = self.read_faces(context, FairOptions())
        return Request(tasks, options) if tasks else None
