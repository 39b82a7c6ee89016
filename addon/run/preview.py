"""The first surfaces of a run under way: shown in the mesh until the run ends, and taken back before anything else.

The run's thread gives them, the main thread shows them. The mesh is restored bit for bit, however the run ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ..arrays.types import Floats, Ints
from ..mesh import mesh_io
from .job import Task, is_unchanged, objects_in_mode


@dataclass(frozen=True)
class _Shown:
    name: str
    vertices: Ints  # (k,) of the mesh
    before: Floats  # (k, 3) where they were
    there: Floats  # (k, 3) where they are now


class Preview:
    def __init__(self, tasks: list[Task]) -> None:
        self._tasks = {task.object_name: task for task in tasks}
        self._given: list[tuple[str, Ints, Floats]] = []
        self._shown: list[_Shown] = []

    def give(self, name: str, vertices: Ints, positions: Floats) -> None:
        """Have these vertices (k,) of an object shown at `positions` (k, 3); any thread."""
        self._given.append((name, vertices, positions))

    def show(self) -> None:
        """Show what was given since the last call, where the mesh is as it was read; main thread."""
        objects = objects_in_mode(bpy.context) if self._given else {}
        while self._given:
            name, vertices, positions = self._given.pop(0)
            task, obj = self._tasks[name], objects.get(name)
            if name in {shown.name for shown in self._shown}:
                continue
            if obj is None or not np.isfinite(positions).all() or not is_unchanged(obj, task.mesh, task.key):
                continue
            mesh_io.move_vertices(obj.data, vertices, positions)
            there = positions.astype(np.float32).astype(np.float64)
            self._shown.append(_Shown(name, vertices, task.mesh.positions[vertices], there))

    def take_back(self) -> None:
        """Put everything back that is where it was shown; main thread, and no harm where nothing was."""
        objects = objects_in_mode(bpy.context)
        while self._shown:
            shown = self._shown.pop()
            obj = objects.get(shown.name)
            if obj is not None:
                mesh_io.move_vertices_back(obj.data, shown.vertices, shown.there, shown.before)
