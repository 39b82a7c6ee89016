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

from ..core.arrays import Floats, Ints
from ..core.engine import REFUSALS, Progress
from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..core.region import MeshArrays, free_vertices
from ..core.report import make_report, summary
from ..host.context import active_object
from ..host.polling import require, require_idle
from ..mesh import painted
from ..mesh.free_normals import free_normals
from ..translations import translated
from . import compare, last_run
from .asked import Asked, Say
from .fair_arrays import fair_arrays
from .fair_mesh import read, write
from .job import Refused
from .labels import with_idle
from .option_properties import FairProperties
from .redo import Redone
from .report_properties import store

MODES = ("SCULPT", "OBJECT", "WEIGHT_PAINT")


@dataclass(frozen=True)
class Task:
    """The object's mesh, as it was read."""

    object_name: str
    mesh: MeshArrays
    matrix: Floats  # (4, 4) to world space
    options: FairOptions
    before: Floats  # (n, 3) positions


def solve(task: Task, progress: Progress) -> Fairing:
    """Solve on arrays alone; raises Refused and fairing.Cancelled."""
    try:
        return fair_arrays(task.mesh, task.matrix, task.options, progress)
    except REFUSALS as cause:
        raise Refused(task.object_name, cause) from cause


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


class AskedOutside(Asked):
    """What one run was asked for."""

    def __init__(self, task: Task, begin: float) -> None:
        """begin: of the performance counter."""
        self.task, self.begin = task, begin
        self._shown = task.before

    @property
    def names(self) -> tuple[str, ...]:
        """Of the object."""
        return (self.task.object_name,)

    @cached_property
    def size(self) -> int:
        """Free vertices."""
        return int(np.count_nonzero(free_vertices(self.task.mesh)))

    def work(self, progress: Progress) -> Fairing:
        """Find the surface."""
        return solve(self.task, progress)

    def is_as_read(self, context: bpy.types.Context) -> bool:
        """Return whether the mesh is as it was read."""
        return self._is_at(context, self.task.before)

    def keep_shown(self, context: bpy.types.Context) -> None:
        """Remember the mesh as it is now."""
        obj = active_object(context)
        if obj is not None and obj.name == self.task.object_name and obj.mode in MODES:
            with in_object_mode(obj):
                self._shown = painted.positions(obj.data)

    def is_as_shown(self, context: bpy.types.Context) -> bool:
        """Return whether it still is."""
        return self._is_at(context, self._shown)

    def _is_at(self, context: bpy.types.Context, positions: Floats) -> bool:
        obj = active_object(context)
        if obj is None or obj.name != self.task.object_name or obj.mode not in MODES:
            return False
        with in_object_mode(obj):
            return np.array_equal(painted.positions(obj.data), positions)

    def finish(self, context: bpy.types.Context, outcome: Fairing, say: Say) -> set[str]:
        """Write and report what the run came to; return an operator's status."""
        task, obj = self.task, active_object(context)
        report = make_report([(task.object_name, outcome)], task.options, time.perf_counter() - self.begin)
        report = with_idle(report, task.options)
        store(context.window_manager.fairing_report, report)
        last_run.forget()  # buttons for the next run belong to edit mode
        if not report.written:
            say({"ERROR"}, translated(summary(report)))
            return {"CANCELLED"}
        with in_object_mode(obj):
            normals = free_normals(obj.data)
            write(obj.data, outcome)
        compare.remember_one(obj.name, task.before, outcome, normals)
        say({"INFO"}, translated(summary(report)))
        return {"FINISHED"}


class FairsOutside(FairProperties, Redone):
    """An operator that fairs the active object outside edit mode, but for `_faces`, which says what of it."""

    if TYPE_CHECKING:
        _faces: Callable[[bpy.types.Object], Ints]  # in object mode; raises ValueError where there are none

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Needs a mesh outside edit mode."""
        obj = active_object(context)
        return (
            require(cls, obj is not None and obj.type == "MESH", "Make a mesh object active")
            and require(cls, obj.mode in MODES, "In sculpt or object mode; in edit mode use Fair Region")
            and require_idle(cls, context)
        )

    def _read(self, context: bpy.types.Context) -> AskedOutside:
        begin = time.perf_counter()
        obj = active_object(context)
        if obj.mode == "SCULPT" and not self.is_repeated(context):
            bpy.ops.ed.undo_push(message="Before Fair Masked")  # strokes are steps of another kind
        self.take_names_before()
        try:
            options = FairOptions.of(self)
            with in_object_mode(obj):
                return AskedOutside(self._read_object(obj, options), begin)
        except REFUSALS as cause:
            raise Refused(obj.name, cause) from cause

    def _read_object(self, obj: bpy.types.Object, options: FairOptions) -> Task:
        check_shown(obj)
        faces = self._faces(obj)
        mesh, matrix = read(obj.data, faces.tolist(), np.array(obj.matrix_world, dtype=np.float64), options)
        return Task(obj.name, mesh, matrix, options, painted.positions(obj.data))


def check_shown(obj: bpy.types.Object) -> None:
    """Raise ValueError where what is seen is not the mesh's own shape."""
    if getattr(obj, "use_dynamic_topology_sculpting", False):
        raise ValueError("Dynamic topology is on: turn it off first")
    if any(modifier.type == "MULTIRES" and modifier.sculpt_levels for modifier in obj.modifiers):
        raise ValueError("The multiresolution levels hide the base mesh: go to level 0, or apply them")
    key: Any = obj.active_shape_key
    if key is not None and key != obj.data.shape_keys.reference_key:
        raise ValueError(f"The shape key {key.name!r} is active: fair it in edit mode, or choose the Basis")
