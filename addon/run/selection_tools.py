"""Buttons for the selection and its boundary: what is bad about it, and what can be done before a run."""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

from ..core.arrays import Ints, Mask
from ..core.engine import REFUSALS, bad_outline, fitted_boundary
from ..core.options import FairOptions
from ..core.region import MeshArrays, to_local
from ..core.selection import grown_until_smooth, left_out_faces, problem_of
from ..core.words import said
from ..host.context import edited_objects
from ..host.polling import SELECT_FACES, require_edit_mode
from ..mesh import mesh_io, selecting
from ..translations import translated
from . import job, last_run


class _Tool:
    """Does something with the selection of every object in edit mode that has one."""

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode has a selection."""
        return require_edit_mode(cls, context, SELECT_FACES)

    def _each(self, context: bpy.types.Context, work: Callable[[bpy.types.Object, job.Task], int]) -> int | None:
        """Add up what the work returns for each object; None where one is refused, which is reported."""
        context.view_layer.update()
        total = 0
        for obj in edited_objects(context):
            try:
                task = job.read_object(obj, FairOptions())
                if task.mesh.in_patch.any():
                    total += work(obj, task)
            except REFUSALS as cause:
                self.report({"ERROR"}, translated(said("named", name=obj.name, text=str(cause))))  # type: ignore[attr-defined]
                return None
        return total

    def _answer(self, count: int | None, done: str, nothing: str) -> set[str]:
        if count is None:
            return {"CANCELLED"}
        self.report({"INFO"}, translated(done if count else nothing))  # type: ignore[attr-defined]
        return {"FINISHED"} if count else {"CANCELLED"}


class MESH_OT_fair_select_bad(_Tool, bpy.types.Operator):
    """Select the vertices of the boundary whose surroundings are folded, noisy or needles:
    the surface would follow them"""

    bl_idname = "mesh.fair_select_bad"
    bl_label = "Select Bad Boundary"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select them in vertex mode, where there are any."""
        found: list[tuple[bpy.types.Object, Ints]] = []

        tasks: list[job.Task] = []

        def look(obj: bpy.types.Object, task: job.Task) -> int:
            tasks.append(task)
            found.append((obj, bad_outline(problem_of(task.mesh, task.matrix))))
            return len(found[-1][1])

        count = self._each(context, look)
        if count:
            last_run.keep_selection(tasks)
            context.tool_settings.mesh_select_mode = (True, False, False)
            for obj, vertices in found:
                selecting.select_vertices(obj.data, vertices)
        return self._answer(count, said("bad_vertices", n=count or 0), said("none_bad"))


def _select_faces(context: bpy.types.Context, obj: bpy.types.Object, mesh: MeshArrays, faces: Mask) -> int:
    """Select these faces in face mode; return how many there are more than before."""
    context.tool_settings.mesh_select_mode = (False, False, True)
    selecting.select_faces(obj.data, np.flatnonzero(faces))
    return int(np.count_nonzero(faces & ~mesh.in_patch))


class MESH_OT_fair_grow(_Tool, bpy.types.Operator):
    """Grow the selection over the bad vertices of its boundary, until none is left"""

    bl_idname = "mesh.fair_grow"
    bl_label = "Grow Until Smooth"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select more, where that helps."""
        count = self._each(
            context,
            lambda obj, task: _select_faces(context, obj, task.mesh, grown_until_smooth(task.mesh, task.matrix)),
        )
        return self._answer(count, said("faces_more", n=count or 0), said("nothing_to_grow"))


class MESH_OT_fair_add_left_out(_Tool, bpy.types.Operator):
    """Select the single faces that a lasso missed"""

    bl_idname = "mesh.fair_add_left_out"
    bl_label = "Add Left-Out Faces"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select small holes, too."""
        count = self._each(
            context,
            lambda obj, task: _select_faces(context, obj, task.mesh, task.mesh.in_patch | left_out_faces(task.mesh)),
        )
        return self._answer(count, said("faces_more", n=count or 0), said("none_left_out"))


def _smooth(obj: bpy.types.Object, task: job.Task) -> int:
    fitted = fitted_boundary(problem_of(task.mesh, task.matrix))
    mesh_io.write_edit_mesh(obj.data, fitted.vertices, to_local(fitted.points, task.matrix))
    return len(fitted.vertices)


class MESH_OT_fair_smooth_outline(_Tool, bpy.types.Operator):
    """Move a noisy boundary and the two rings around it onto the surface that the surroundings suggest,
    by a quarter of an edge at most"""

    bl_idname = "mesh.fair_smooth_outline"
    bl_label = "Smooth Boundary"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Move vertices of the boundary; nothing inside the selection moves."""
        count = self._each(context, _smooth)
        text = said("vertices_moved", n=count or 0)
        return self._answer(count, text, said("smooth_already"))


TOOLS: tuple[Any, ...] = (
    MESH_OT_fair_select_bad,
    MESH_OT_fair_grow,
    MESH_OT_fair_smooth_outline,
    MESH_OT_fair_add_left_out,
)
