"""Modifiers: levels of a Multiresolution, and Blender's own return from one; planes of Mirror modifiers."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from ..arrays.region import Reflection
from ..arrays.types import Floats, Ints
from ..words.words import said
from .columns import indices
from .painted import positions

# Blender smooths what a level below the finest is given on its way up to that one. Of a hill of .3 on a unit sphere
# .005 is lost, one level below, and .02 two below; after six rounds 6e-5 and 3e-4.
ROUNDS = 6
NEAR = 1e-6  # of the largest coordinate: what single precision leaves; the finest level is there at once


def shown_level(obj: bpy.types.Object) -> int:
    """Return the level that is seen outside edit mode, in sculpt mode that of brushes; 0: the mesh itself."""
    for modifier in obj.modifiers:
        if modifier.type == "MULTIRES":
            return int(modifier.sculpt_levels if obj.mode == "SCULPT" else modifier.levels * modifier.show_viewport)
    return 0


@contextmanager
def at_level(obj: bpy.types.Object, level: int) -> Iterator[bpy.types.Object]:
    """Give, for an object in object mode, one whose mesh is that level's: itself for 0, a temporary one otherwise.

    Groups and other layers are there; masks are not: Blender shows extensions none of a level. Raises ValueError where
    Simplify lets Blender show a lower level alone.
    """
    if level == 0:
        yield obj
        return
    copy, mesh = obj.copy(), None
    try:
        bpy.context.scene.collection.objects.link(copy)
        for modifier in list(copy.modifiers):
            if modifier.type != "MULTIRES":
                copy.modifiers.remove(modifier)
        copy.modifiers[0].levels, copy.modifiers[0].show_viewport = level, True
        depsgraph = bpy.context.evaluated_depsgraph_get()
        mesh = bpy.data.meshes.new_from_object(
            copy.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
        )
        copy.modifiers.clear()
        copy.data = mesh
        if len(mesh.polygons) != len(obj.data.loops) * 4 ** (level - 1):
            raise ValueError(said("simplified"))
        yield copy
    finally:
        bpy.data.objects.remove(copy)
        if mesh is not None:
            bpy.data.meshes.remove(mesh)


def faces_at(mesh: bpy.types.Mesh, faces: Ints, level: int) -> Ints:
    """Return the faces of a level that the faces (k,) of the mesh itself have become: Blender keeps their order."""
    if level == 0:
        return faces
    sizes = indices(mesh.polygons, "loop_total")
    own = np.repeat(np.arange(len(sizes)), sizes * 4 ** (level - 1))
    found: Ints = np.flatnonzero(np.isin(own, faces))
    return found


def write(obj: bpy.types.Object, level: int, vertices: Ints, moved: Floats) -> None:
    """Move the vertices (k,) of a level of an object in object mode to `moved` (k, 3), in its own coordinates.

    What finer levels have added to this one stays on it. Raises ValueError where Blender declines.
    """
    modifier: Any = next(modifier for modifier in obj.modifiers if modifier.type == "MULTIRES")
    before, modifier.levels = modifier.levels, level
    try:
        with at_level(obj, level) as copy:
            wanted = positions(copy.data)
            wanted[vertices] = moved
            asked = wanted.copy()
            for _ in range(ROUNDS):
                copy.data.vertices.foreach_set("co", asked.astype(np.float32).ravel())
                copy.data.update()
                _reshape(obj, copy, modifier.name)
                with at_level(obj, level) as now:
                    missing = wanted - positions(now.data)
                if np.abs(missing).max() <= NEAR * np.abs(wanted).max():
                    break
                asked += missing
    finally:
        modifier.levels = before


def _reshape(obj: bpy.types.Object, source: bpy.types.Object, modifier: str) -> None:
    with _selected(obj, source):
        if bpy.ops.object.multires_reshape(modifier=modifier) != {"FINISHED"}:
            raise ValueError(said("level_not_written"))


@contextmanager
def _selected(*objects: bpy.types.Object) -> Iterator[None]:
    """Select exactly these for a while: operators in `temp_override` can crash Blender while a thread runs Python."""
    before = [obj for obj in bpy.context.view_layer.objects if obj.select_get()]
    for obj in before:
        obj.select_set(False)
    for obj in objects:
        obj.select_set(True)
    try:
        yield
    finally:
        for obj in objects:
            obj.select_set(obj in before)
        for obj in before:
            obj.select_set(True)


def reflections(obj: bpy.types.Object | None) -> tuple[Reflection, ...]:
    """Return the planes of the object's Mirror modifiers that are on and merge, in the mesh's own coordinates."""
    found = []
    for modifier in obj.modifiers if obj is not None else ():
        if modifier.type != "MIRROR" or not (modifier.show_viewport and modifier.use_mirror_merge):
            continue
        for axis in np.flatnonzero(list(modifier.use_axis)):
            found.append(Reflection(_across(obj, modifier.mirror_object, int(axis)), float(modifier.merge_threshold)))
    return tuple(found)


def _across(obj: bpy.types.Object, other: bpy.types.Object | None, axis: int) -> Floats:
    """Return the (4, 4) reflection across a plane of the object's own axes, or of another object's."""
    flip = np.eye(4)
    flip[axis, axis] = -1.0
    if other is None:
        return flip
    own, its = (np.array(one.matrix_world, dtype=np.float64) for one in (obj, other))
    return np.linalg.solve(own, its @ flip @ np.linalg.solve(its, own))
