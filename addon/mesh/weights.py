"""What vertex groups and the sculpt mask of a mesh in object mode, or of a copy of one, say of its vertices."""

from __future__ import annotations

import bpy
import numpy as np

from ..core.arrays import Floats, Ints
from ..core.options import FairOptions
from .attributes import SCULPT_MASK, values


def group_index(obj: bpy.types.Object | None, name: str, option: str) -> int | None:
    """Return the number of a vertex group, None for an empty name; `option` asks for it.

    Raises ValueError where the object has no group of that name.
    """
    if not name:
        return None
    if obj is None or name not in obj.vertex_groups:
        raise ValueError(f"{option}: there is no vertex group named {name!r}")
    return int(obj.vertex_groups[name].index)


def members(mesh: bpy.types.Mesh, vertices: Ints, group: int) -> list[int]:
    """Return those of the vertices that are in the vertex group with a weight above zero."""
    return [
        vertex
        for vertex in vertices.tolist()
        if any(e.group == group and e.weight > 0.0 for e in mesh.vertices[vertex].groups)
    ]


def parts_of_the_way(mesh: bpy.types.Mesh, obj: bpy.types.Object | None, options: FairOptions) -> Floats | None:
    """Return (n,) how much of the way each vertex goes, by vertex group and mask; None where neither is asked for.

    obj: shows the mesh, or what it is a copy of. Raises ValueError where it has no such group, or no mask.
    """
    if not options.goes_by_weight:
        return None
    parts = np.ones(len(mesh.vertices))
    group = group_index(obj, options.factor_group, "factor_group")
    if group is not None:
        parts *= _group_weights(mesh, group)
    if options.factor_mask == "USED":
        mask = values(mesh, SCULPT_MASK, np.float32)
        if mask is None:
            raise ValueError("factor_mask: nothing is masked. Paint a mask in sculpt mode, or choose Ignored")
        parts *= np.clip(mask, 0.0, 1.0)
    return parts


def _group_weights(mesh: bpy.types.Mesh, group: int) -> Floats:
    weights = np.zeros(len(mesh.vertices))
    for vertex in mesh.vertices:
        for entry in vertex.groups:
            if entry.group == group:
                weights[vertex.index] = entry.weight
    return weights
