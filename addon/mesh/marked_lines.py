"""Edges of a mesh that a new mesh has to keep, as its attributes say."""

from __future__ import annotations

import bpy
import numpy as np

from ..arrays.lines import WIRES, edges_at_wires, parting_edges
from ..arrays.region import MeshArrays
from ..arrays.types import Mask
from .columns import has_numbers, values_of

_WHITE = {"FLOAT_COLOR", "BYTE_COLOR"}  # what edges have that nobody has coloured; of all else they have zeros
_TURNS = {"QUATERNION", "FLOAT4X4"}  # whose zeros are no numbers of zero, and which nobody marks by
_OWN = {".sculpt_face_set"}  # of Blender's own attributes, which begin with a point, the one that counts
_NOT_MARKS = {"custom_normal", "sharp_face"}  # what new faces have of their own, and shading


def lines(mesh: bpy.types.Mesh, arrays: MeshArrays) -> dict[str, Mask]:
    """Return (e,) masks, by attribute: edges with marks, those where UVs, colours or face sets part, those at wires."""
    found = {WIRES: edges_at_wires(arrays)}
    for attribute in mesh.attributes:
        hidden = attribute.name.startswith(".") and attribute.name not in _OWN
        if hidden or attribute.name in _NOT_MARKS or attribute.data_type in _TURNS or not has_numbers(attribute):
            continue
        values = values_of(attribute).astype(np.float64)
        if attribute.domain == "EDGE":
            unmarked = 1.0 if attribute.data_type in _WHITE else 0.0
            found[attribute.name] = (values != unmarked).any(axis=1)
        elif attribute.domain == "CORNER":
            found[attribute.name] = parting_edges(arrays, values)
        elif attribute.domain == "FACE":
            found[attribute.name] = parting_edges(arrays, values[arrays.corner_faces])
    return found
