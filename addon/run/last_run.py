"""The last run: its options, regions and spots, for inspection and for a rerun with one change."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ..arrays.region import nothing
from ..arrays.types import Floats, Ints
from ..mesh import selecting
from ..mesh.remeshed import Written
from ..options.options import FairOptions
from ..verdict.outcome import Fairing
from ..verdict.report import Report, standing
from ..words.words import said
from .job import Task, objects_in_mode

SIGHT = 25.0  # in edge lengths: what the view shows


@dataclass(frozen=True)
class Region:
    """What one object had selected, and where its result is to be looked at."""

    object_name: str
    face_count: int
    faces: Ints  # that were faired
    spots: Ints  # vertices


class _Last:
    """The last run, written or not."""

    def __init__(self) -> None:
        self.regions: tuple[Region, ...] = ()
        self.refused: tuple[Region, ...] = ()  # that a refusal is about
        self.options = FairOptions()
        self.standing: tuple[int, float] = (0, 0.0)
        self.next: tuple[str, dict[str, Ints] | None] = ("", None)  # the next run's remedy, and its faces


_last = _Last()


def remember(tasks: list[Task], outcomes: list[Fairing], options: FairOptions, report: Report) -> None:
    """Keep what a run was about, and what came of it."""
    _last.options, _last.standing = options, standing(report)
    _last.regions = tuple(_region(task, outcome.verdict.spots) for task, outcome in zip(tasks, outcomes, strict=True))
    _last.refused = ()


def _region(task: Task, spots: Ints) -> Region:
    return Region(task.object_name, len(task.mesh.in_patch), np.flatnonzero(task.mesh.in_patch), spots)


def point_out(context: bpy.types.Context, name: str, vertices: Ints) -> None:
    """Remember the vertices that a refusal is about, if the object is in edit mode."""
    if len(vertices) and context.mode == "EDIT_MESH":
        count = selecting.face_count(objects_in_mode(context)[name].data)
        _last.refused = (Region(name, count, nothing(), vertices),)


def renumber(written: list[Written | None]) -> None:
    """Follow the faces and vertices of objects whose patch was meshed anew."""
    _last.regions = tuple(
        region if new is None else Region(region.object_name, new.face_count, new.faces, new.spots)
        for region, new in zip(_last.regions, written, strict=True)
    )


def forget() -> None:
    _last.regions = _last.refused = ()
    _last.next = ("", None)


def try_remedy(remedy: str, faces: dict[str, Ints]) -> None:
    """Set the next run's faces; with a remedy it is written only if better than the last one, with "" always."""
    _last.next = (remedy, faces)


def take_remedy() -> tuple[str, dict[str, Ints] | None]:
    """Return what try_remedy has set, once."""
    found, _last.next = _last.next, ("", None)
    return found


def is_improved_by(report: Report) -> bool:
    """Return whether a run with one change has come out better than the last one."""
    return standing(report) < _last.standing


def has_regions() -> bool:
    return bool(_last.regions)


def options() -> FairOptions:
    return _last.options


def has_spots() -> bool:
    return any(len(region.spots) for region in _last.regions or _last.refused)


class Changed(Exception):
    """The objects of the last run are not in edit mode any more, or have other faces."""


def _found(context: bpy.types.Context, regions: tuple[Region, ...]) -> list[tuple[Region, bpy.types.Mesh]]:
    """Return the meshes of these regions; raises Changed."""
    objects = objects_in_mode(context)
    found = []
    for region in regions:
        obj = objects.get(region.object_name)
        if obj is None:
            raise Changed(said("not_in_edit_mode", name=region.object_name))
        if selecting.face_count(obj.data) != region.face_count:
            raise Changed(said("other_faces", name=region.object_name))
        found.append((region, obj.data))
    return found


def worst_spot(context: bpy.types.Context) -> tuple[Floats, Floats, float]:
    """Return where in world space the worst of the spots is, its normal, and how much around it is of interest."""
    region, mesh = next(pair for pair in _found(context, _last.regions or _last.refused) if len(pair[0].spots))
    place, normal, edge = selecting.surroundings(mesh, int(region.spots[0]))
    matrix = np.array(objects_in_mode(context)[region.object_name].matrix_world)
    linear = matrix[:3, :3]
    size = float(np.cbrt(abs(np.linalg.det(linear))))
    return linear @ place + matrix[:3, 3], np.linalg.solve(linear.T, normal), SIGHT * edge * size


def select_spots(context: bpy.types.Context) -> None:
    """Select the vertices that the verdict or the refusal is about, in vertex mode; raises Changed."""
    found = _found(context, _last.regions or _last.refused)
    context.tool_settings.mesh_select_mode = (True, False, False)
    for region, mesh in found:
        selecting.select_vertices(mesh, region.spots)


def faces(context: bpy.types.Context) -> dict[str, Ints]:
    """Return the faces that were faired, by the names of objects; raises Changed."""
    return {region.object_name: region.faces for region, _ in _found(context, _last.regions)}


def select_region(context: bpy.types.Context) -> None:
    """Select the faces that were faired, in face mode; raises Changed."""
    found = _found(context, _last.regions)
    context.tool_settings.mesh_select_mode = (False, False, True)
    for region, mesh in found:
        selecting.select_faces(mesh, region.faces)
