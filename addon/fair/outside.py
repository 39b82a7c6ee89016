"""Fairing outside edit mode: what such operators share. They say which faces it is about."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ..arrays.region import MeshArrays, free_vertices
from ..arrays.types import Floats, Ints
from ..host.context import active_object
from ..host.polling import require, require_idle
from ..mesh import levels, painted
from ..options.options import FairOptions
from ..options.properties import FairProperties
from ..run import compare, last_run
from ..run.job import refusing
from ..run.redo import Redone
from ..run.request import Request, Say
from ..translations import translated
from ..verdict.outcome import Fairing
from ..verdict.properties import store
from ..verdict.report import make_report, summary
from ..words.labels import with_idle
from ..words.words import said
from .engine import Progress
from .fair_arrays import fair_arrays
from .script import read, write

MODES = ("SCULPT", "OBJECT", "WEIGHT_PAINT")


@dataclass(frozen=True)
class Task:
    """The object's mesh, as it was read."""

    object_name: str
    mesh: MeshArrays
    matrix: Floats  # (4, 4) to world space
    options: FairOptions
    before: Floats  # (n, 3) positions
    level: int = 0  # of a Multiresolution modifier that the mesh is of; 0: the object's own mesh


def solve(task: Task, progress: Progress) -> Fairing:
    """Solve on arrays alone; raises Refused and fairing.Cancelled."""
    with refusing(task.object_name):
        return fair_arrays(task.mesh, task.matrix, task.options, progress)


@contextmanager
def in_object_mode(obj: bpy.types.Object) -> Iterator[None]:
    """Go to object mode and back: sculpt mode keeps the mesh for itself."""
    mode = obj.mode
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


@contextmanager
def as_read(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Give an object whose mesh is the one that is seen, where sculpt mode keeps that for itself."""
    level = levels.shown_level(obj)
    if level == 0:
        yield obj
        return
    with in_object_mode(obj), levels.at_level(obj, level) as shown:
        bpy.context.view_layer.update()
        yield shown


class OutsideRequest(Request):
    def __init__(self, task: Task) -> None:
        self.task, self._shown = task, task.before

    @property
    def names(self) -> tuple[str, ...]:
        return (self.task.object_name,)

    @cached_property
    def size(self) -> int:
        return int(np.count_nonzero(free_vertices(self.task.mesh)))

    def work(self, progress: Progress) -> Fairing:
        return solve(self.task, progress)

    def is_as_read(self, context: bpy.types.Context) -> bool:
        return self._is_at(context, self.task.before)

    def keep_shown(self, context: bpy.types.Context) -> None:
        obj = active_object(context)
        if obj is not None and obj.name == self.task.object_name and obj.mode in MODES:
            with in_object_mode(obj), levels.at_level(obj, self.task.level) as shown:
                self._shown = painted.positions(shown.data)

    def is_as_shown(self, context: bpy.types.Context) -> bool:
        return self._is_at(context, self._shown)

    def _is_at(self, context: bpy.types.Context, positions: Floats) -> bool:
        obj = active_object(context)
        if obj is None or obj.name != self.task.object_name or obj.mode not in MODES:
            return False
        if levels.shown_level(obj) != self.task.level:
            return False
        with in_object_mode(obj), levels.at_level(obj, self.task.level) as shown:
            return np.array_equal(positions, painted.positions(shown.data))

    def finish(self, context: bpy.types.Context, outcome: Fairing, say: Say) -> set[str]:
        task, obj = self.task, active_object(context)
        report = make_report([(task.object_name, outcome)], task.options, time.perf_counter() - self.begin)
        report = with_idle(report, task.options)
        store(context.window_manager.fairing_report, report)
        last_run.forget()  # buttons for the next run belong to edit mode
        if not report.written:
            say({"ERROR"}, translated(summary(report)))
            return {"CANCELLED"}
        with in_object_mode(obj):
            self._write(obj, outcome)
        say({"INFO"}, translated(summary(report)))
        return {"FINISHED"}

    def _write(self, obj: bpy.types.Object, outcome: Fairing) -> None:
        compare.forget()  # it goes to and fro between positions of the mesh itself, by their numbers
        if self.task.level:
            levels.write(obj, self.task.level, outcome.vertices, outcome.positions)
        else:
            compare.remember([self.task], [outcome])
            write(obj.data, outcome)


class FairsOutside(FairProperties, Redone):
    """An operator that fairs the active object outside edit mode, but for `_faces`, which says what of it."""

    if TYPE_CHECKING:
        _faces: Callable[[bpy.types.Object], Ints]  # in object mode; raises ValueError where there are none

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = active_object(context)
        return (
            require(cls, obj is not None and obj.type == "MESH", said("make_active"))
            and require(cls, obj.mode in MODES, said("outside_edit_mode"))
            and require_idle(cls, context)
        )

    def _read(self, context: bpy.types.Context) -> OutsideRequest:
        obj = active_object(context)
        if obj.mode == "SCULPT" and not self.is_repeated(context):
            bpy.ops.ed.undo_push(message="Before Fair Masked")  # strokes are steps of another kind
        with refusing(obj.name):
            options = FairOptions.of(self)
            check_shown(obj)
            level = levels.shown_level(obj)
            self._check_level(level, options)
            with in_object_mode(obj):
                return OutsideRequest(self._read_object(obj, options, level))

    def _check_level(self, level: int, options: FairOptions) -> None:
        """Raise ValueError where this can't be done on a level of a Multiresolution modifier."""
        if level and options.remesh:
            raise ValueError(said("level_keeps_faces"))

    def _read_object(self, obj: bpy.types.Object, options: FairOptions, level: int) -> Task:
        faces = levels.faces_at(obj.data, self._faces(obj), level)
        matrix = np.array(obj.matrix_world, dtype=np.float64)
        with levels.at_level(obj, level) as shown:
            mesh, matrix = read(shown.data, faces.tolist(), matrix, options)
            return Task(obj.name, mesh, matrix, options, painted.positions(shown.data), level)


def check_shown(obj: bpy.types.Object) -> None:
    """Raise ValueError where what is seen is not the mesh's own shape, or its vertices are not in its order."""
    if obj.use_dynamic_topology_sculpting:
        raise ValueError(said("dynamic_topology"))
    key: Any = obj.active_shape_key
    if key is not None and key != obj.data.shape_keys.reference_key:
        raise ValueError(said("key_is_active", name=key.name))
