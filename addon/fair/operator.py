"""The operator: at once for scripts and where it takes but a moment, else in the background."""

import bpy

from ..options.options import FairOptions
from ..options.properties import FairProperties
from ..run import last_run
from ..run.operator import InEditMode
from ..words.words import said
from .finish import Request


class MESH_OT_fair_region(FairProperties, InEditMode, bpy.types.Operator):
    """Replace the selected faces by the fair surface that continues their surroundings.
    No vertex is added or lost; nothing outside the selection moves"""

    bl_idname = "mesh.fair_region"
    bl_label = "Fair Region"
    bl_options = {"REGISTER", "UNDO", "PRESET"}  # noqa: RUF012 - the form that Blender asks for

    def _read(self, context: bpy.types.Context) -> Request | None:
        (remedy, faces), options = last_run.take_remedy(), FairOptions.of(self)
        tasks, rest = self.read_faces(context, options, faces)
        notes = tuple(said("left_no_free", name=task.object_name) for task in rest)
        return Request(tasks, options, notes=notes, remedy=remedy, again=faces is not None) if tasks else None
