"""What vertex groups and the sculpt mask of a mesh in object mode, or of a copy of one, say of its vertices."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Mask
from ..options.options import FairOptions
from ..words.words import said
from .columns import SCULPT_MASK, values


def group_index(obj: bpy.types.Object | None, name: str, option: str) -> int | None:
    """Return the number of a vertex group, None for an empty name; `option` asks for it.

    Raises ValueError where the object has no group of that name.
    """
    if not name:
        return None
    if obj is None or name not in obj.vertex_groups:
        raise ValueError(said("option_no_group", option=option, name=name))
    return int(obj.vertex_groups[name].index)


def bone_groups(obj: bpy.types.Object | None) -> list[int]:
    """Return the numbers of the vertex groups by which an armature deforms an object; empty without one."""
    armature = None if obj is None else obj.find_armature()
    if obj is None or armature is None:
        return []
    bones = {bone.name for bone in armature.data.bones if bone.use_deform}
    return [int(group.index) for group in obj.vertex_groups if group.name in bones]


def weighed(arrays: MeshArrays, mesh: bpy.types.Mesh, obj: bpy.types.Object | None, options: FairOptions) -> MeshArrays:
    """Return the arrays with what vertex groups and the mask say of them; raises what these raise."""
    group = _in_group(mesh, obj, options)
    return replace(
        arrays,
        parts=parts_of_the_way(mesh, obj, options),
        free_slopes=group if options.frees_slopes else None,
        continued=group if options.joins_curvature else None,
    )


def _in_group(mesh: bpy.types.Mesh, obj: bpy.types.Object | None, options: FairOptions) -> Mask | None:
    """Return the (n,) mask of the vertex group that alone has the continuity chosen; None where there is none.

    obj: shows the mesh, or what it is a copy of. Raises ValueError where it has no such group.
    """
    group = group_index(obj, options.continuity_group, "continuity_group")
    return None if group is None else group_weights(mesh, group) > 0.0


def parts_of_the_way(mesh: bpy.types.Mesh, obj: bpy.types.Object | None, options: FairOptions) -> Floats | None:
    """Return (n,) each vertex's own factor, by vertex group and mask; None where neither is asked for.

    obj: shows the mesh, or what it is a copy of. Raises ValueError where it has no such group, or no mask.
    """
    if not options.goes_by_weight:
        return None
    parts = np.ones(len(mesh.vertices))
    group = group_index(obj, options.vertex_group, "vertex_group")
    if group is not None:
        parts *= group_weights(mesh, group)
    if options.use_mask:
        mask = values(mesh, SCULPT_MASK, np.float32)
        if mask is None:
            raise ValueError("Nothing is masked: paint a mask in sculpt mode, or turn Use Mask off")
        parts *= np.clip(mask, 0.0, 1.0)
    return parts


def group_weights(mesh: bpy.types.Mesh, group: int) -> Floats:
    """Return (n,) the weights of a vertex group, 0 for what is not in it."""
    found = ((v.index, entry.weight) for v in mesh.vertices for entry in v.groups if entry.group == group)
    weights = np.zeros(len(mesh.vertices))
    for vertex, weight in found:
        weights[vertex] = weight
    return weights
