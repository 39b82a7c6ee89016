"""The operator that fills holes and joins outlines, at once: a hole takes a tenth of a second."""

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..core.arrays import Floats, Ints
from ..core.border import NO_BORDER, border_loops
from ..core.engine import REFUSALS, Progress, sub_range
from ..core.filling import FillOptions, Piece, fill, worst
from ..core.options import FairOptions
from ..core.region import MeshArrays
from ..core.verdict import GOOD, UNUSABLE
from ..core.words import counted
from ..host.context import edited_objects
from ..host.polling import require, require_edit_mode
from ..mesh import filled, mesh_io, selecting
from ..translations import translated
from .fill_properties import FillProperties
from .job import Refused, objects_in_mode


@dataclass(frozen=True)
class Task:
    """One object's holes, as they were read."""

    object_name: str
    mesh: MeshArrays
    matrix: Floats  # (4, 4) to world space
    loops: list[Ints]


def read(context: bpy.types.Context) -> list[Task]:
    """Read every object in edit mode that has a selected border; raises Refused."""
    tasks = []
    for obj in edited_objects(context):
        seeds = filled.border_seeds(obj.data)
        if not seeds.any():
            continue
        try:
            filled.check_kept(obj)
            mesh_io.writable_key(obj)
            mesh = mesh_io.read_own_mesh(obj, FairOptions())
            loops = border_loops(mesh, seeds)
        except ValueError as cause:
            raise Refused(obj.name, cause) from cause
        tasks.append(Task(obj.name, mesh, np.array(obj.matrix_world, dtype=np.float64), loops))
    return tasks


def solve(tasks: list[Task], options: FillOptions, progress: Progress) -> list[list[Piece]]:
    """Solve task after task, on arrays alone; raises Refused, also where a result is not to be written."""
    outcomes = []
    for i, task in enumerate(tasks):
        part = sub_range(progress, i / len(tasks), (i + 1) / len(tasks))
        try:
            pieces = fill(task.mesh, task.matrix, task.loops, options, part)
        except REFUSALS as cause:
            raise Refused(task.object_name, cause) from cause
        verdict = worst(pieces)
        if verdict.grade == UNUSABLE and options.accept != "ALL":
            raise Refused(task.object_name, NotWritten(verdict.reason, verdict.spots))
        outcomes.append(pieces)
    return outcomes


class NotWritten(ValueError):
    """A surface that is not usable; `elements` are the vertices of its outline."""

    def __init__(self, reason: str, elements: Ints) -> None:
        super().__init__(f"{reason}. Nothing was changed")
        self.elements = elements


class MESH_OT_fair_fill(FillProperties, bpy.types.Operator):
    """Fill the holes whose outlines are selected, in part or whole, or join them,
    with the fair surface that continues their surroundings"""

    bl_idname = "mesh.fair_fill"
    bl_label = "Fair Fill"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode has borders; while a run is under way, the mesh is its own."""
        return require_edit_mode(cls, context, "Select the outline of a hole in edit mode") and require(
            cls,
            not context.window_manager.fairing_progress.running,
            "Fairing is under way: wait for it, or press Esc",
        )

    def draw(self, _context: bpy.types.Context) -> None:
        """Lay the options out."""
        self.layout.use_property_split = True
        for name in ("equation", "bridge", "spacing", "accept"):
            self.layout.prop(self, name)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Fill in every object in edit mode, or in none of them where one is refused."""
        context.view_layer.update()  # a script may just have changed an object's matrix
        try:
            options = FillOptions.of(self)
            tasks = read(context)
            if not tasks:
                self.report({"ERROR"}, translated(NO_BORDER))
                return {"CANCELLED"}
            outcomes = self._solved(context, tasks, options)
        except Refused as refusal:
            return self._refuse(context, refusal)
        self._write(context, tasks, outcomes)
        return {"FINISHED"}

    def _solved(self, context: bpy.types.Context, tasks: list[Task], options: FillOptions) -> list[list[Piece]]:
        manager = context.window_manager
        manager.progress_begin(0.0, 1.0)
        tell: Progress = lambda fraction, _stage: manager.progress_update(fraction)  # noqa: E731
        try:
            return solve(tasks, options, tell)
        finally:
            manager.progress_end()

    def _write(self, context: bpy.types.Context, tasks: list[Task], outcomes: list[list[Piece]]) -> None:
        objects = objects_in_mode(context)
        for task, pieces in zip(tasks, outcomes, strict=True):
            seams = filled.add_faces(objects[task.object_name], pieces)
            for text in _notes(pieces, seams):
                self.report({"WARNING"}, f"{task.object_name}: {text}")
        written = [piece for pieces in outcomes for piece in pieces]
        faces = counted(sum(len(piece.triangles) for piece in written), "face", "faces")
        self.report({"INFO"}, f"{counted(len(written), 'surface', 'surfaces')}, {faces}")

    def _refuse(self, context: bpy.types.Context, refusal: Refused) -> set[str]:
        elements: Any = np.asarray(getattr(refusal.cause, "elements", ()), dtype=np.int64)
        if elements.size:
            context.tool_settings.mesh_select_mode = (True, False, False)
            selecting.select_vertices(objects_in_mode(context)[refusal.object_name].data, elements)
        self.report({"ERROR"}, str(refusal))
        return {"CANCELLED"}


def _notes(pieces: list[Piece], seams: int) -> list[str]:
    """Return a sentence for each thing that is worth a look."""
    notes = [note for piece in pieces for note in piece.notes]
    notes += [piece.verdict.reason for piece in pieces if piece.verdict.grade != GOOD]
    if seams:
        text = counted(seams, "vertex of the outline lies", "vertices of the outline lie")
        notes.append(f"{text} on a seam of UVs or colours: new faces begin with the mean there")
    return list(dict.fromkeys(notes))
