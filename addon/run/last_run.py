"""What the last run was asked for, so that it can be looked at and done once more in another way."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ..core.arrays import Ints
from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..mesh import selecting
from ..mesh.remeshed import Written
from .job import Task, objects_in_mode


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
        self.options = FairOptions()


_last = _Last()


def remember(tasks: list[Task], outcomes: list[Fairing], options: FairOptions) -> None:
    """Keep what a run was about."""
    _last.options = options
    _last.regions = tuple(
        Region(task.object_name, len(task.mesh.in_patch), np.flatnonzero(task.mesh.in_patch), outcome.verdict.spots)
        for task, outcome in zip(tasks, outcomes, strict=True)
    )


def renumber(written: list[Written | None]) -> None:
    """Follow the faces and vertices of objects whose patch was meshed anew."""
    _last.regions = tuple(
        region if new is None else Region(region.object_name, new.face_count, new.faces, new.spots)
        for region, new in zip(_last.regions, written, strict=True)
    )


def forget() -> None:
    """Drop what was kept."""
    _last.regions = ()


def has_regions() -> bool:
    """Tell whether there was a run."""
    return bool(_last.regions)


def options() -> FairOptions:
    """Return what it was asked for."""
    return _last.options


def has_spots() -> bool:
    """Tell whether there is anything to look at."""
    return any(len(region.spots) for region in _last.regions)


class Changed(Exception):
    """The objects of the last run are not in edit mode any more, or have other faces."""


def _found(context: bpy.types.Context) -> list[tuple[Region, bpy.types.Mesh]]:
    """Return the meshes of the last run; raises Changed."""
    objects = objects_in_mode(context)
    found = []
    for region in _last.regions:
        obj = objects.get(region.object_name)
        if obj is None:
            raise Changed(f"{region.object_name} is not in edit mode")
        if selecting.face_count(obj.data) != region.face_count:
            raise Changed(f"{region.object_name} has other faces by now: select the region anew")
        found.append((region, obj.data))
    return found


def select_spots(context: bpy.types.Context) -> None:
    """Select the vertices that the verdict is about, in vertex mode; raises Changed."""
    found = _found(context)
    context.tool_settings.mesh_select_mode = (True, False, False)
    for region, mesh in found:
        selecting.select_vertices(mesh, region.spots)


def select_region(context: bpy.types.Context) -> None:
    """Select the faces that were faired, in face mode; raises Changed."""
    found = _found(context)
    context.tool_settings.mesh_select_mode = (False, False, True)
    for region, mesh in found:
        selecting.select_faces(mesh, region.faces)
