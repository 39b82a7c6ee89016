"""One run over all objects in edit mode: read, solve (on arrays, in any thread), write.

Nothing is written unless all objects can be done.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, Protocol, TypeVar

import bpy
import numpy as np

from ..arrays.region import MeshArrays, free_vertices, to_local
from ..arrays.types import Floats, Ints, Mask
from ..fair.engine import REFUSALS, Problem, Progress, sub_range
from ..fair.fair_arrays import fair_all_keys
from ..fair.memory import memory
from ..fair.solve import Kept
from ..host.context import edited_objects
from ..mesh import all_keys, mesh_io, remeshed, selecting
from ..mesh.target import restored
from ..mirror.reflected import Whole, whole_of
from ..options.options import FairOptions
from ..remesh.remeshing import Remeshed
from ..verdict.outcome import Fairing, Moves
from ..words.labels import reason_of
from ..words.words import said

Answer = TypeVar("Answer")
Done = TypeVar("Done")


class Refused(Exception):
    """One object can't be faired; nothing has been written yet."""

    def __init__(self, name: str, cause: Exception) -> None:
        self.reason = reason_of(cause)
        super().__init__(said("named", name=name, text=self.reason))
        self.object_name = name
        self.cause = cause

    @property
    def elements(self) -> Ints:
        """The vertices that the cause names; none where it names none."""
        return np.asarray(getattr(self.cause, "elements", ()), dtype=np.int64)


@contextmanager
def refusing(name: str, errors: type[Exception] | tuple[type[Exception], ...] = REFUSALS) -> Iterator[None]:
    """Turn these errors into Refused with the object's name."""
    try:
        yield
    except errors as cause:
        raise Refused(name, cause) from cause


@dataclass(frozen=True)
class Task:
    """One object's mesh, as it was read."""

    object_name: str
    mesh: MeshArrays
    matrix: Floats  # (4, 4) to world space
    key: str = ""  # the shape key that was read, as mesh_io.writable_key names it
    free_count: int = 0
    whole: Whole | None = None  # the mesh with its mirror images, where it is one half
    target: Any = None  # what new faces are made over: borders, wires

    @property
    def faired_mesh(self) -> MeshArrays:
        """The mesh with its images; its own vertices come first."""
        return self.mesh if self.whole is None else self.whole.mesh


def read(context: bpy.types.Context, options: FairOptions, faces: Mapping[str, Ints] | None = None) -> list[Task]:
    """Read every object in edit mode that has selected faces, free vertices or not; raises Refused.

    faces: of each object by name, in place of its selection.
    """
    tasks = []
    for obj in edited_objects(context):
        if faces is not None and obj.name not in faces:
            continue
        with refusing(obj.name, ValueError):
            task = read_object(obj, options, None if faces is None else faces[obj.name])
        if task.mesh.in_patch.any():
            tasks.append(task)
    return tasks


def read_object(obj: bpy.types.Object, options: FairOptions, faces: Ints | None = None) -> Task:
    """Read one object in edit mode; raises ValueError where it can't be faired."""
    key = mesh_io.writable_key(obj)
    if options.remesh:
        mesh_io.check_new_faces(obj)
    mesh = mesh_io.read_edit_mesh(obj, options, faces)
    if options.all_keys and not options.remesh:
        mesh = replace(mesh, keys=all_keys.read_keys(obj), shown_offsets=None)
    matrix = np.array(obj.matrix_world, dtype=np.float64)
    whole = whole_of(mesh)
    free = whole.free_count if whole is not None else int(np.count_nonzero(free_vertices(mesh)))
    if options.remesh:  # a new mesh has free vertices of its own
        free = max(free, int(np.count_nonzero(mesh.in_patch)))
    return Task(obj.name, mesh, matrix, key, free, whole)


def read_for_new_faces(
    context: bpy.types.Context,
    chosen: Callable[[bpy.types.Mesh], Mask],
    target: Callable[[bpy.types.Object, MeshArrays, Floats, Mask], Any],
    options: FairOptions | None = None,
) -> list[Task]:
    """Read every object in edit mode of which something is chosen; raises Refused.

    target: returns what new faces are made over, from object, mesh, matrix and mask; None: nothing.
    """
    tasks = []
    for obj in edited_objects(context):
        mask = chosen(obj.data)
        if not mask.any():
            continue
        with refusing(obj.name, ValueError):
            mesh_io.check_new_faces(obj)
            key = mesh_io.writable_key(obj)
            mesh = mesh_io.read_edit_mesh(obj, options or FairOptions(), widens=False)
            matrix = np.array(obj.matrix_world, dtype=np.float64)
            there = target(obj, mesh, matrix, mask)
        if there is not None:
            tasks.append(Task(obj.name, mesh, matrix, key, target=there))
    return tasks


Give = Callable[[str, Ints, Floats], None]  # an object's name, vertices (k,) of its mesh, where to show them (k, 3)


def solve(
    tasks: list[Task], options: FairOptions, progress: Progress, ahead: bool = False, give: Give | None = None
) -> list[Fairing]:
    """Solve task after task, on arrays alone; raises Refused and fairing.Cancelled.

    ahead: also prepare for a change of options, which takes a while (background runs only).
    give: receives each task's first surface, where the mesh can show it.
    """

    def solve_one(task: Task, part: Progress | None) -> Fairing:
        kept = Kept(memory, ahead, _preview(task, options, give))
        return fair_all_keys(task.mesh, task.matrix, options, part, kept)

    return each_of(tasks, solve_one, progress)


def each_of(
    tasks: Sequence[Any], solve_one: Callable[[Any, Progress | None], Answer], progress: Progress
) -> list[Answer]:
    """Solve task after task, on arrays alone, each with its `object_name`; raises Refused and fairing.Cancelled."""
    outcomes = []
    ends = np.cumsum([0, *(getattr(task, "free_count", 0) or 1 for task in tasks)])
    for task, begin, end in zip(tasks, ends[:-1] / ends[-1], ends[1:] / ends[-1], strict=True):
        with refusing(task.object_name):
            outcomes.append(solve_one(task, sub_range(progress, float(begin), float(end))))
    return outcomes


def _preview(task: Task, options: FairOptions, give: Give | None) -> Callable[[Problem, Floats], None] | None:
    """Return what gives a task's first surface; None where the mesh would not show it as it is."""
    if give is None or task.whole is not None or options.remesh or options.factor != 1.0:
        return None

    def preview(problem: Problem, points: Floats) -> None:
        free = problem.patch.free
        give(task.object_name, problem.patch.vertices[free], to_local(points[free], task.matrix))

    return preview


def objects_in_mode(context: bpy.types.Context) -> dict[str, bpy.types.Object]:
    """Return the objects in edit mode by name; undo replaces objects, so that only names last."""
    return {obj.name: obj for obj in edited_objects(context)}


def show_vertices(context: bpy.types.Context, name: str, vertices: Ints) -> None:
    """Select these vertices of an object in edit mode, and nothing else there; without any leave all as it is."""
    if len(vertices) and context.mode == "EDIT_MESH":
        context.tool_settings.mesh_select_mode = (True, False, False)
        selecting.select_vertices(objects_in_mode(context)[name].data, vertices)


class AsRead(Protocol):
    """An object as it was read."""

    @property
    def object_name(self) -> str:
        """Its name."""

    @property
    def mesh(self) -> mesh_io.Shape | MeshArrays:
        """Its mesh."""

    @property
    def key(self) -> str:
        """The shape key that was read, as mesh_io.writable_key names it."""


def as_they_are(context: bpy.types.Context, tasks: Sequence[AsRead]) -> list[AsRead]:
    """Return those of the tasks whose objects are in edit mode, with the shapes that these have now."""
    objects = objects_in_mode(context) if context.mode == "EDIT_MESH" else {}
    there: list[Any] = [task for task in tasks if task.object_name in objects]
    return [replace(task, mesh=mesh_io.shape_of(objects[task.object_name].data)) for task in there]


def is_current(context: bpy.types.Context, tasks: Sequence[AsRead]) -> bool:
    """Return whether the objects are still in edit mode, with the vertices, faces and shape key that were read."""
    objects = objects_in_mode(context)
    return context.mode == "EDIT_MESH" and all(
        task.object_name in objects and is_unchanged(objects[task.object_name], task.mesh, task.key) for task in tasks
    )


def is_unchanged(obj: bpy.types.Object, mesh: mesh_io.Shape | MeshArrays, key: str) -> bool:
    """Return whether an object in edit mode still has the mesh and the shape key that were read."""
    try:
        same_key = mesh_io.writable_key(obj) == key
    except ValueError:  # locked meanwhile
        return False
    return same_key and mesh_io.is_unchanged(obj.data, mesh)


def write_each(
    context: bpy.types.Context,
    named: Iterable[tuple[str, Answer]],
    write_one: Callable[[bpy.types.Object, Answer], Done],
) -> list[Done]:
    """Write each answer to the object in edit mode that it is named with.

    If one fails, all objects are restored and Refused, or the error itself, is raised.
    """
    objects, pairs, done = objects_in_mode(context), list(named), []
    with _without_collector(), restored([objects[name] for name, _ in pairs]):
        for name, answer in pairs:
            with refusing(name):
                done.append(write_one(objects[name], answer))
    return done


@contextmanager
def _without_collector() -> Iterator[None]:
    """Turn garbage collection off, which takes a third of the time with tens of thousands of elements."""
    is_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if is_on:
            gc.enable()


def write_one(obj: bpy.types.Object, outcome: Moves) -> remeshed.Written | None:
    """Move the free vertices of an object, or put its new mesh in; return what was written where the mesh is new."""
    if isinstance(outcome, Remeshed):
        return remeshed.write_edit_mesh(obj, outcome)
    mesh_io.write_edit_mesh(obj.data, outcome.vertices, outcome.positions)
    all_keys.write_keys(obj, outcome.keys)
    return None
