"""Edges of a mesh that a new mesh has to keep, as its attributes say."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..arrays.lines import WIRES, edges_at_wires, parting_edges
from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Mask

_WIDTHS = {
    "FLOAT": ("value", 1, np.float32),
    "INT": ("value", 1, np.int32),
    "INT8": ("value", 1, np.int32),
    "BOOLEAN": ("value", 1, bool),
    "FLOAT2": ("vector", 2, np.float32),
    "FLOAT4": ("vector", 4, np.float32),  # since Blender 5.2
    "FLOAT_VECTOR": ("vector", 3, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32),
    "BYTE_COLOR": ("color", 4, np.float32),
    "INT16_2D": ("value", 2, np.int32),
    "INT32_2D": ("value", 2, np.int32),
}  # fmt: skip
_WHITE = {"FLOAT_COLOR", "BYTE_COLOR"}  # what edges have that nobody has coloured; of all else they have zeros
_OWN = {".sculpt_face_set"}  # of Blender's own attributes, which begin with a point, the one that counts
_NOT_MARKS = {"custom_normal", "sharp_face"}  # what new faces have of their own, and shading


def lines(mesh: bpy.types.Mesh, arrays: MeshArrays) -> dict[str, Mask]:
    """Return (e,) masks, by attribute: edges with marks, those where UVs, colours or face sets part, those at wires."""
    found = {WIRES: edges_at_wires(arrays)}
    for attribute in mesh.attributes:
        hidden = attribute.name.startswith(".") and attribute.name not in _OWN
        if hidden or attribute.name in _NOT_MARKS or attribute.data_type not in _WIDTHS:
            continue
        if attribute.domain == "EDGE":
            unmarked = 1.0 if attribute.data_type in _WHITE else 0.0
            found[attribute.name] = (_values(attribute, len(arrays.edges)) != unmarked).any(axis=1)
        elif attribute.domain == "CORNER":
            found[attribute.name] = parting_edges(arrays, _values(attribute, len(arrays.corner_vertices)))
        elif attribute.domain == "FACE":
            values = _values(attribute, len(arrays.in_patch))
            found[attribute.name] = parting_edges(arrays, values[arrays.corner_faces])
    return found


def _values(attribute: Any, count: int) -> Floats:
    name, width, dtype = _WIDTHS[attribute.data_type]
    values = np.empty(count * width, dtype=dtype)
    attribute.data.foreach_get(name, values)
    return values.reshape(count, width).astype(np.float64)
