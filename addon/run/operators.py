"""The operator: at once for scripts and where it takes but a moment, else in the background.

What it does is in job.py and fair_arrays.py, the thread in core's runner.py.
"""

import time
from functools import partial

import bpy

from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..host.polling import NO_FACE, NO_FREE, SELECT_FACES, require_edit_mode, require_idle
from ..preferences import background_from
from ..translations import translated
from . import job, last_run
from .background import Work
from .finish import Asked, finish, refuse
from .option_properties import FairProperties
from .redo import Redone
from .redo_panel import draw_options
from .report_properties import store_refusal


class MESH_OT_fair_region(FairProperties, Redone, bpy.types.Operator):
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
        asked = self._asked()
        large = asked.size >= background_from(context)
        return self._start(context, partial(asked.work, ahead=large), large, asked.preview)

    def _work(self) -> Work:
        return partial(job.solve, self._tasks, self._options)

    def _is_current(self, context: bpy.types.Context) -> bool:
        return job.is_current(context, self._tasks)

    def _asked(self) -> Asked:
        return Asked(self._tasks, self._options, self._notes, self._begin, self._way)

    def _apply(self, context: bpy.types.Context, outcomes: list[Fairing]) -> set[str]:
        return finish(context, self._asked(), outcomes, self.report)

    def _refuse(self, context: bpy.types.Context, refusal: job.Refused) -> set[str]:
        return refuse(context, self._tasks, refusal, self.report)
