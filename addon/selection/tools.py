# mypy: disable-error-code="valid-type"
"""What a button can select: bad vertices of a boundary, faces that were left out, what the last run was about.

No postponed annotations here: Blender reads them as property definitions.
"""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
from bpy.props import EnumProperty

from ..arrays.region import nothing
from ..fair.engine import REFUSALS, bad_outline
from ..host.context import edited_objects
from ..host.polling import require_edit_mode
from ..host.status import look_at
from ..mesh import live_mesh, selecting
from ..options.options import FairOptions
from ..run import job, last_run
from ..translations import translated
from ..words.words import said
from .selection import left_out_faces, problem_of

_FACES, _VERTICES = (False, False, True), (True, False, False)  # modes of selection


def _tasks(context: bpy.types.Context) -> list[job.Task]:
    context.view_layer.update()
    return job.read(context, FairOptions())


def _bad(context: bpy.types.Context) -> bool:
    tasks = _tasks(context)
    found = [bad_outline(problem_of(task.mesh, task.matrix)) for task in tasks]
    if not any(map(len, found)):
        return False
    context.tool_settings.mesh_select_mode = _VERTICES
    objects = job.objects_in_mode(context)
    for task, vertices in zip(tasks, found, strict=True):
        selecting.select_vertices(objects[task.object_name].data, vertices)
    return True


def _left_out(context: bpy.types.Context) -> bool:
    found = [(task, left_out_faces(task.mesh)) for task in _tasks(context)]
    if not any(faces.any() for _, faces in found):
        return False
    context.tool_settings.mesh_select_mode = _FACES
    objects = job.objects_in_mode(context)
    for task, faces in found:
        selecting.select_faces(objects[task.object_name].data, np.flatnonzero(faces | task.mesh.in_patch))
    return True


def _spots(context: bpy.types.Context) -> bool:
    if not last_run.has_spots():
        return False
    last_run.select_spots(context)
    look_at(context, *last_run.worst_spot(context))
    return True


def _live(context: bpy.types.Context) -> bool:
    meshes = [obj.data for obj in edited_objects(context)]
    if not any(map(live_mesh.has_region, meshes)):
        return False
    context.tool_settings.mesh_select_mode = _FACES  # the others would select faces between the region's vertices, too
    for mesh in meshes:
        faces = live_mesh.region_faces(mesh)
        selecting.select_faces(mesh, nothing() if faces is None else faces)
    return True


_WHAT = (
    ("SPOTS", "Show Worst Spots", "Select the spots that the verdict is about and turn the view to them"),
    (
        "BAD",
        "Select Bad Boundary",
        "Select the vertices of the boundary whose surroundings are folded, noisy or slivers: "
        "the surface would follow them",
    ),
    ("LEFT_OUT", "Add Left-Out Faces", "Select faces that a lasso missed: gaps of up to four"),
    ("LIVE", "Select Live Region", "Select the faces of the live region, to see which they are"),
)
NAMES = {identifier: name for identifier, name, _ in _WHAT}
# Each selects, and returns whether there was something; raises last_run.Changed and what reading does.
_SELECTS: dict[str, Callable[[bpy.types.Context], bool]] = {
    "SPOTS": _spots,
    "BAD": _bad,
    "LEFT_OUT": _left_out,
    "LIVE": _live,
}


class MESH_OT_fair_select(bpy.types.Operator):
    """Select what a run was about, or should be about"""

    bl_idname = "mesh.fair_select"
    bl_label = "Fair Select"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    what: EnumProperty(name="What", description="What is selected", items=_WHAT, default="SPOTS")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: Any) -> str:
        return next(text for identifier, _, text in _WHAT if identifier == properties.what)

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            if _SELECTS[self.what](context):
                return {"FINISHED"}
        except (last_run.Changed, job.Refused, *REFUSALS) as cause:
            self.report({"ERROR"}, translated(str(cause)))
            return {"CANCELLED"}
        self.report({"INFO"}, translated(said("nothing_to_select")))
        return {"CANCELLED"}


def draw_select(layout: Any, what: str, **shown: Any) -> None:
    layout.operator(MESH_OT_fair_select.bl_idname, **{"text": NAMES[what], **shown}).what = what
