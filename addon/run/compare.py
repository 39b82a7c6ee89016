"""Before and after: the last run's free vertices go back and forth between the two."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..arrays.types import Floats, Ints
from ..host.handlers import listen, unlisten
from ..host.polling import require, require_edit_mode
from ..mesh import mesh_io, selecting
from ..mesh.free_normals import free_normals
from ..remesh.remeshing import Remeshed
from ..translations import translated
from ..verdict.outcome import Moves
from ..words.words import said
from .job import objects_in_mode

SAMPLED = 1000  # vertices compared to see whether a run was undone, at each undo


@dataclass(frozen=True)
class Pair:
    """What one run did to one object: k vertices, float32 positions as Blender keeps them."""

    object_name: str
    vertex_count: int
    vertices: Ints  # (k,)
    before: Floats  # (k, 3)
    after: Floats  # (k, 3)
    normals: Floats | None = None  # free custom normals of the whole mesh, before


class _Last:
    def __init__(self) -> None:
        self.pairs: tuple[Pair, ...] = ()


_last = _Last()


def remember(tasks: Sequence[Any], outcomes: Sequence[Moves]) -> None:
    """Keep both states of a run that will be written now; tasks: with `object_name` and `mesh`."""
    _last.pairs = tuple(_pair(task, outcome) for task, outcome in zip(tasks, outcomes, strict=True))
    if any(isinstance(outcome, Remeshed) or outcome.keys for outcome in outcomes):
        forget()  # new meshes and shape keys can't be swapped by these pairs


def _pair(task: Any, outcome: Moves) -> Pair:
    before = task.mesh.positions
    return Pair(
        object_name=task.object_name,
        vertex_count=len(before),
        vertices=outcome.vertices,
        before=before[outcome.vertices],
        after=outcome.positions.astype(np.float32).astype(np.float64),
        normals=free_normals(bpy.data.objects[task.object_name].data),
    )


def positions_before(object_name: str, positions: Floats) -> Floats | None:
    """Return all positions (n, 3) as they were before the last run; None where it was not about this object."""
    for pair in _last.pairs:
        if pair.object_name == object_name and pair.vertex_count == len(positions):
            before = positions.copy()
            before[pair.vertices] = pair.before
            return before
    return None


def forget() -> None:
    _last.pairs = ()


def is_available() -> bool:
    return bool(_last.pairs)


class Changed(Exception):
    """The vertices are neither where they were before the run nor where it left them."""


def is_undone() -> bool:
    """Return whether the vertices of the last run that was written are where they were before it."""
    return bool(_last.pairs) and all(_is_before(pair) for pair in _last.pairs)


def _is_before(pair: Pair) -> bool:
    obj = bpy.data.objects.get(pair.object_name)
    if obj is None or obj.type != "MESH" or selecting.count(obj.data) != pair.vertex_count:
        return False
    moved = np.flatnonzero((pair.before != pair.after).any(axis=1))
    asked = moved[:: len(moved) // SAMPLED + 1]
    places = selecting.places(obj.data, pair.vertices[asked]) if len(asked) else None
    return places is not None and np.array_equal(places, pair.before[asked])


def is_shown(context: bpy.types.Context) -> bool:
    """Return whether there is a result, and all of it shows. Raises Changed."""
    objects = objects_in_mode(context)
    for pair in _last.pairs:
        if pair.object_name not in objects:
            raise Changed(said("not_in_edit_mode", name=pair.object_name))
    return is_available() and all(_is_after(objects[pair.object_name].data, pair) for pair in _last.pairs)


def show(context: bpy.types.Context, result: bool) -> None:
    """Show the last run's result, or the shape before."""
    objects = objects_in_mode(context)
    for pair in _last.pairs:
        shown_now = (pair.after, None) if result else (pair.before, pair.normals)
        mesh_io.write_edit_mesh(objects[pair.object_name].data, pair.vertices, *shown_now)


def _is_after(mesh: bpy.types.Mesh, pair: Pair) -> bool:
    now = mesh_io.edit_positions(mesh)
    if len(now) == pair.vertex_count:
        if np.array_equal(now[pair.vertices], pair.after):
            return True
        if np.array_equal(now[pair.vertices], pair.before):
            return False
    raise Changed(said("edited_since", name=pair.object_name))


def toggle(context: bpy.types.Context) -> bool:
    """Swap before and after; return whether the result shows now. Raises Changed."""
    shows_result = not is_shown(context)
    show(context, shows_result)
    return shows_result


class MESH_OT_fair_compare(bpy.types.Operator):
    """Switch between the shape before the last fairing and the result"""

    bl_idname = "mesh.fair_compare"
    bl_label = "Before / After"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context) and require(cls, is_available(), said("nothing_faired"))

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Swap, unless the vertices were moved by anything else."""
        try:
            shows_result = toggle(context)
        except Changed as change:
            self.report({"ERROR"}, translated(str(change)))
            return {"CANCELLED"}
        self.report({"INFO"}, translated(said("shown_result") if shows_result else said("shown_before")))
        return {"FINISHED"}


def _on_step(*_arguments: object) -> None:
    """After an undo or a redo: see whether the last run still stands."""
    report = bpy.context.window_manager.fairing_report
    if report.written:
        report.undone = is_undone()


def register() -> None:
    listen(bpy.app.handlers.undo_post, _on_step)
    listen(bpy.app.handlers.redo_post, _on_step)


def unregister() -> None:
    unlisten(bpy.app.handlers.redo_post, _on_step)
    unlisten(bpy.app.handlers.undo_post, _on_step)
