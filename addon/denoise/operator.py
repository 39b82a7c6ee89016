"""The operator that takes the roughness from selected faces: at once where that is quick, else in the background."""

from dataclasses import dataclass

import bpy

from ..fair.engine import Progress
from ..host.polling import NO_FACE, NO_FREE, SELECT_FACES, require_edit_mode, require_idle
from ..options.options import FairOptions
from ..options.other_options import DenoiseOptions
from ..options.properties import DenoiseProperties
from ..options.redo_panel import draw_options
from ..run import compare, job, last_run
from ..run.asked import AskedInEditMode, Say
from ..run.redo import Redone
from ..translations import translated
from ..verdict.properties import clear, store_refusal
from ..words.words import said
from .denoising import Denoised, denoise_arrays


def solve(tasks: list[job.Task], options: DenoiseOptions, progress: Progress) -> list[Denoised]:
    """Solve task after task, on arrays alone; raises Refused and fairing.Cancelled."""
    return job.each_of(tasks, lambda task, part: denoise_arrays(task.mesh, task.matrix, options, part), progress)


@dataclass
class Asked(AskedInEditMode):
    """What one run was asked for."""

    tasks: list[job.Task]
    options: DenoiseOptions
    moves = True

    @property
    def size(self) -> int:
        """Free vertices."""
        return job.size(self.tasks)

    def work(self, progress: Progress) -> list[Denoised]:
        """Find where vertices go."""
        return solve(self.tasks, self.options, progress)

    def finish(self, context: bpy.types.Context, outcomes: list[Denoised], say: Say) -> set[str]:
        """Move them."""
        last_run.forget()  # Again would fair
        clear(context.window_manager.fairing_report)
        compare.remember(self.tasks, outcomes)
        job.write_each(context, zip(self.names, outcomes, strict=True), job.write_one)
        count = sum(len(outcome.vertices) for outcome in outcomes)
        largest = max(outcome.largest for outcome in outcomes)
        say({"INFO"}, translated(said("moved_by", n=count, largest=largest)))
        return {"FINISHED"}


class MESH_OT_fair_denoise(DenoiseProperties, Redone, bpy.types.Operator):
    """Take the roughness from the selected faces and keep their shape; borders and sharp edges stay"""

    bl_idname = "mesh.fair_denoise"
    bl_label = "Fair Denoise"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context, SELECT_FACES) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        draw_options(self.layout, self, context.object, context.window_manager)

    def _read(self, context: bpy.types.Context) -> Asked | None:
        options = DenoiseOptions.of(self)
        selected = job.read(context, FairOptions())
        tasks = [task for task in selected if task.free_count]
        if not tasks:
            reason = NO_FREE if selected else NO_FACE
            store_refusal(context.window_manager.fairing_report, "", reason)
            last_run.forget()
            self.report({"INFO"}, translated(reason))
            return None
        return Asked(tasks, options)
