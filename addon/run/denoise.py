"""The operator that takes the roughness from selected faces: at once where that is quick, else in the background."""

from functools import partial

import bpy

from ..core.denoising import Denoised, DenoiseOptions, denoise_arrays
from ..core.engine import Progress
from ..core.options import FairOptions
from ..host.polling import NO_FACE, NO_FREE, SELECT_FACES, require_edit_mode, require_idle
from ..preferences import background_from
from ..translations import translated
from . import compare, job, last_run
from .background import Watched, Work
from .option_properties import DenoiseProperties
from .redo_panel import draw_options
from .report_properties import clear, store_refusal


def solve(tasks: list[job.Task], options: DenoiseOptions, progress: Progress) -> list[Denoised]:
    """Solve task after task, on arrays alone; raises Refused and fairing.Cancelled."""
    return job.each_of(tasks, lambda task, part: denoise_arrays(task.mesh, task.matrix, options, part), progress)


class MESH_OT_fair_denoise(DenoiseProperties, Watched, bpy.types.Operator):
    """Take the roughness from the selected faces and keep their shape; borders and sharp edges stay"""

    bl_idname = "mesh.fair_denoise"
    bl_label = "Fair Denoise"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    _tasks: list[job.Task]
    _options: DenoiseOptions

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode has a selection; while a run is under way, the mesh is its own."""
        return require_edit_mode(cls, context, SELECT_FACES) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out."""
        draw_options(self.layout, self, context.object, context.window_manager)

    def _read(self, context: bpy.types.Context) -> bool:
        self._options = DenoiseOptions.of(self)
        selected = job.read(context, FairOptions())
        self._tasks = [task for task in selected if task.free_count]
        if not self._tasks:
            reason = NO_FREE if selected else NO_FACE
            store_refusal(context.window_manager.fairing_report, "", reason)
            last_run.forget()
            self.report({"INFO"}, translated(reason))
        return bool(self._tasks)

    def _work(self) -> Work:
        return partial(solve, self._tasks, self._options)

    def _start_work(self, context: bpy.types.Context) -> set[str]:
        large = job.size(self._tasks) >= background_from(context)
        return self._start(context, partial(solve, self._tasks, self._options), large)

    def _is_current(self, context: bpy.types.Context) -> bool:
        return job.is_current(context, self._tasks)

    def _apply(self, context: bpy.types.Context, outcomes: list[Denoised]) -> set[str]:
        last_run.forget()  # Again would fair
        clear(context.window_manager.fairing_report)
        compare.remember(self._tasks, outcomes)
        job.write(context, self._tasks, outcomes)
        count = sum(len(outcome.vertices) for outcome in outcomes)
        largest = max(outcome.largest for outcome in outcomes)
        one = f"{count} vertex moved, by {largest:.3g} at most"
        text = one if count == 1 else f"{count} vertices moved, by {largest:.3g} at most"
        self.report({"INFO"}, translated(text))
        return {"FINISHED"}

    def _refuse(self, context: bpy.types.Context, refusal: job.Refused) -> set[str]:
        job.show_vertices(context, refusal.object_name, refusal.elements)
        store_refusal(context.window_manager.fairing_report, refusal.object_name, refusal.reason)
        last_run.forget()
        self.report({"ERROR"}, translated(str(refusal)))
        return {"CANCELLED"}
