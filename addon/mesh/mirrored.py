"""Across which planes Mirror modifiers show an object once more."""

from __future__ import annotations

import bpy
import numpy as np

from ..arrays.region import Reflection
from ..arrays.types import Floats


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
