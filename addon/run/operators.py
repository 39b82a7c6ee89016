"""The operator: at once for scripts and where it takes but a moment, else in the background.

What it does is in job.py and fair_arrays.py, the thread in core's runner.py.
"""

import time
from functools import partial

import bpy

from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..core.report import GRADE_NAMES, Report, make_report, summary
from ..host.polling import NO_FACE, NO_FREE, SELECT_FACES, require_edit_mode, require_idle
from ..host.status import redraw_sidebars
from ..preferences import background_from
from ..translations import translated
from . import compare, job, labels, last_run
from .background import Watched, Work
from .option_properties import FairProperties
from .preview import Preview
from .redo_panel import draw_options
from .report_properties import store, store_refusal


class MESH_OT_fair_region(FairProperties, Watched, bpy.types.Operator):
    """Replace the selected faces by the fair surface that continues their surroundings.
    Vertices stay the same vertices; nothing outside the selection moves"""

    bl_idname = "mesh.fair_region"
    bl_label = "Fair Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for
    preset_menu, preset_add = "MESH_MT_fair_region_presets", "mesh.fair_region_preset_add"

    _tasks: list[job.Task] = []  # noqa: RUF012 - each run sets its own
    _options: FairOptions
    _notes: tuple[str, ...] = ()  # on objects that there is nothing to do for
    _begin: float
    _way = ""  # tried after a run that was not good: written only where the verdict improves

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Cheap, as it is asked at every redraw; what takes a look at the mesh is answered by a report."""
        return require_edit_mode(cls, context, SELECT_FACES) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out in groups."""
        draw_options(self.layout, self, context.object, context.window_manager)

    def _read(self, context: bpy.types.Context) -> bool:
        self._begin, self._way = time.perf_counter(), last_run.way_to_try()
        self.take_names_before()
        self._options = FairOptions.of(self)
        selected = job.read(context, self._options)
        self._tasks = [task for task in selected if task.free_count]
        if not self._tasks:
            reason = NO_FREE if selected else NO_FACE
            store_refusal(context.window_manager.fairing_report, "", reason)
            last_run.forget()
            self.report({"INFO"}, translated(reason))
        self._notes = tuple(
            f"{task.object_name} was left as it is: no vertex inside its selection is free to move"
            for task in selected
            if not task.free_count
        )
        return bool(self._tasks)

    def _start_work(self, context: bpy.types.Context) -> set[str]:
        # The size bounds the time from below only: a selection without a fair surface may be searched for minutes.
        large = job.size(self._tasks) >= background_from(context)
        preview = Preview(self._tasks)
        work = partial(job.solve, self._tasks, self._options, ahead=large, give=preview.give)
        return self._start(context, work, large, preview)

    def _work(self) -> Work:
        return partial(job.solve, self._tasks, self._options)

    def _is_current(self, context: bpy.types.Context) -> bool:
        return job.is_current(context, self._tasks)

    def _apply(self, context: bpy.types.Context, outcomes: list[Fairing]) -> set[str]:
        named = [(task.object_name, outcome) for task, outcome in zip(self._tasks, outcomes, strict=True)]
        report = make_report(named, self._options, time.perf_counter() - self._begin, self._notes)
        report = labels.with_idle(report, self._options)
        if self._way and not last_run.is_improved_by(report):
            return self._keep(context, report)
        store(context.window_manager.fairing_report, report)
        last_run.remember(self._tasks, outcomes, self._options, report)
        if not report.written:
            return self._leave(context, summary(report))
        compare.remember(self._tasks, outcomes)
        last_run.renumber(job.write(context, self._tasks, outcomes))
        for warning in report.warnings:
            self.report({"WARNING"}, translated(warning))
        for idle in labels.idle_in(report):
            self.report({"INFO"}, f"{labels.IDLE} with these options: {idle}")
        self.report({"INFO"}, translated(summary(report)))
        return {"FINISHED"}

    def _leave(self, context: bpy.types.Context, reason: str) -> set[str]:
        """Leave every mesh as it is, and show where the result is no good."""
        last_run.select_spots(context)
        self.report({"ERROR"}, translated(reason))
        return {"CANCELLED"}

    def _keep(self, context: bpy.types.Context, report: Report) -> set[str]:
        """Leave what the last run has left, offer this change no more, and report how it would have come out."""
        last_run.select_region(context)
        shown = context.window_manager.fairing_report
        shown.remedies = ",".join(name for name in shown.remedies.split(",") if name != self._way)
        outcome = ": ".join(filter(None, (GRADE_NAMES[report.verdict.grade], report.verdict.reason)))
        self.report({"INFO"}, translated(f"That is no better and was not written ({outcome})"))
        redraw_sidebars(context)
        return {"CANCELLED"}

    def _refuse(self, context: bpy.types.Context, refusal: job.Refused) -> set[str]:
        job.show_vertices(context, refusal.object_name, refusal.elements)
        store_refusal(context.window_manager.fairing_report, refusal.object_name, refusal.reason)
        last_run.refused(self._tasks)
        self.report({"ERROR"}, translated(str(refusal)))
        return {"CANCELLED"}
