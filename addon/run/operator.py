"""Base class of the operators of edit mode."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import bpy

from ..arrays.types import Ints
from ..host.polling import NO_FACE, NO_FREE, SELECT_FACES, require_edit_mode, require_idle
from ..options.options import FairOptions
from ..options.redo_panel import draw_options
from ..translations import translated
from ..verdict.properties import store_refusal
from . import job, last_run
from .redo import Redone


class InEditMode(Redone):
    """Base of operators on the selection in edit mode; they add `_read`."""

    needs = SELECT_FACES  # the poll message outside edit mode
    layout: Any

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Cheap, as it is asked at every redraw; what needs a look at the mesh is reported by the run."""
        return require_edit_mode(cls, context, cls.needs) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        draw_options(self.layout, self, context.object, context.window_manager)

    def nothing(self, context: bpy.types.Context, reason: str, kind: str = "ERROR") -> None:
        """Say why there is nothing to do."""
        store_refusal(context.window_manager.fairing_report, "", reason)
        last_run.forget()
        self.report({kind}, translated(reason))

    def read_faces(
        self, context: bpy.types.Context, options: FairOptions, faces: Mapping[str, Ints] | None = None
    ) -> tuple[list[job.Task], list[job.Task]]:
        """Return the selected faces of each object where some vertex is free, and those where none is.

        Says so where there are none of the first; raises Refused.
        """
        selected = job.read(context, options, faces)
        free = [task for task in selected if task.free_count]
        if not free:
            self.nothing(context, NO_FREE if selected else NO_FACE, "INFO")
        return free, [task for task in selected if not task.free_count]
