"""What is selected, and what would be refused, before anything runs."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import bpy
import numpy as np

import fairing

from ..arrays.types import Floats
from ..fair import engine
from ..fair.solve import pose
from ..host.polling import NO_FACE, NO_FREE
from ..options.options import FairOptions
from ..run import job
from ..words import labels
from .selection import left_out_faces


@dataclass(frozen=True)
class Inspection:
    """One object's selection."""

    object_name: str
    faces: int
    free_vertices: int = 0
    loops: int = 0  # of the selection's boundary
    islands: int = 0  # pieces that are solved each on its own
    refusal: str = ""  # why the operator would say no, or do nothing; empty where it would not
    notes: tuple[str, ...] = ()  # what may surprise about the result
    bad: Floats = field(default_factory=lambda: np.empty((0, 3)))  # in world space: the boundary's bad vertices
    left_out: int = 0  # faces of small holes


def last_options(context: bpy.types.Context) -> FairOptions:
    """Return the options that the operator would start with."""
    last = context.window_manager.operator_properties_last("mesh.fair_region")
    if last is None:
        return FairOptions()
    return replace(FairOptions.of(last), allow_folds=False)  # is asked for each time anew


def inspect(obj: bpy.types.Object, options: FairOptions) -> Inspection:
    """Look at the selection of an object in edit mode; the engine checks it, but solves nothing."""
    faces = obj.data.total_face_sel
    if not faces and not obj.data.total_edge_sel:
        return Inspection(obj.name, 0, refusal=NO_FACE)
    try:
        return _inspect_task(job.read_object(obj, options), options)
    except ValueError as cause:
        return Inspection(obj.name, faces, refusal=labels.reason_of(cause))


def _inspect_task(task: job.Task, options: FairOptions) -> Inspection:
    faces = int(np.count_nonzero(task.mesh.in_patch))
    if not faces:
        return Inspection(task.object_name, 0, refusal=NO_FACE)
    if not task.free_count:
        return Inspection(task.object_name, faces, refusal=NO_FREE)
    try:
        problem, notes = pose(task.faired_mesh, task.matrix, options)
        if not options.remesh or len(problem.patch.free):
            engine.check(problem, options.resolved(task.mesh.textured))
        islands = engine.islands(problem.patch)
    except engine.REFUSALS as cause:
        return Inspection(task.object_name, faces, task.free_count, refusal=labels.reason_of(cause))
    loops = fairing.boundary_loops(problem.patch.triangles)
    marked = engine.bad_outline(problem)
    marked = marked[marked < len(task.mesh.positions)]
    bad = task.mesh.positions[marked] @ task.matrix[:3, :3].T + task.matrix[:3, 3]
    left_out = int(np.count_nonzero(left_out_faces(task.mesh)))
    return Inspection(
        task.object_name, faces, task.free_count, len(loops), islands, notes=notes, bad=bad, left_out=left_out
    )
