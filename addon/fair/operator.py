"""The operator: at once for scripts and where it takes but a moment, else in the background.

What it does is in job.py and fair_arrays.py, the thread in core's runner.py.
"""

import time

import bpy

from ..host.polling import NO_FACE, NO_FREE, SELECT_FACES, require_edit_mode, require_idle
from ..options.options import FairOptions
from ..options.properties import FairProperties
from ..options.redo_panel import draw_options
from ..run import job, last_run
from ..run.redo import Redone
from ..translations import translated
from ..verdict.properties import store_refusal
from ..words.words import said
from .finish import Asked


class MESH_OT_fair_region(FairProperties, Redone, bpy.types.Operator):
    """Replace the selected faces by the fair surface that continues their surroundings.
    Vertices stay the same vertices; nothing outside the selection moves"""

    bl_idname = "mesh.fair_region"
    bl_label = "Fair Region"
    bl_options = {"REGISTER", "UNDO", "PRESET"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Cheap, as it is asked at every redraw; what takes a look at the mesh is answered by a report."""
        return require_edit_mode(cls, context, SELECT_FACES) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        draw_options(self.layout, self, context.object, context.window_manager)

    def _read(self, context: bpy.types.Context) -> Asked | None:
        begin, way = time.perf_counter(), last_run.way_to_try()
        options = FairOptions.of(self)
        selected = job.read(context, options)
        tasks = [task for task in selected if task.free_count]
        if not tasks:
            reason = NO_FREE if selected else NO_FACE
            store_refusal(context.window_manager.fairing_report, "", reason)
            last_run.forget()
            self.report({"INFO"}, translated(reason))
            return None
        notes = tuple(said("left_no_free", name=task.object_name) for task in selected if not task.free_count)
        return Asked(tasks, options, notes, begin, way)
