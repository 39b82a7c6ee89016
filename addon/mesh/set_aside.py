"""Attributes of the types that bmesh's Python has no access to, as arrays while a bmesh is worked on.

New elements don't get their values there, and new vertices or corners with a 4 × 4 matrix end Blender 4.2 to 5.0:
its default is written to memory that is not aligned. So all of these are taken out first, whatever their type. Each
element of the bmesh gets the number of its row instead, as an integer, which Blender copies from example to copy.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.harmonic import blended, columns
from ..arrays.types import Floats, Ints
from ..words.words import said
from .columns import has_numbers, layout_of, values_of

_REACHED = {
    "FLOAT": "float",
    "INT": "int",
    "BOOLEAN": "bool",
    "FLOAT_VECTOR": "float_vector",
    "FLOAT_COLOR": "float_color",
    "BYTE_COLOR": "color",
    "STRING": "string",
}  # the layers of bmesh by the attributes' types
_SEQUENCES = {"POINT": "verts", "EDGE": "edges", "FACE": "faces", "CORNER": "loops"}
_FLAGS = {
    *(f".{flag}_{of}" for flag in ("select", "hide") for of in ("vert", "edge", "poly")),
    *("sharp_edge", "sharp_face", ".uv_seam"),
}  # what a bmesh keeps with its elements; other hidden booleans are selections and pins of UVs
_AUTOMATIC = "custom_normal"  # as two angles: zeros, which new corners have, are the surface's own normal
ROW = ".fairing_row_"  # and the domain: an integer, the number of the row and 1


@dataclass
class _Attribute:
    """One attribute: its values, and below them those of new elements."""

    name: str
    kind: str
    domain: str
    values: Any  # (n, w)

    @property
    def has_mean(self) -> bool:
        return bool(self.values.dtype == np.float32)

    def columns(self, rows: Ints) -> Floats:
        return columns(self.kind, self.values[rows].astype(np.float64))

    def blended(self, means: Floats) -> Any:
        return blended(self.kind, means).astype(np.float32)


class SetAside:
    """What was taken out of one mesh."""

    def __init__(self, mesh: bpy.types.Mesh) -> None:
        """Read it from a mesh in object mode, or from a copy of one in edit mode."""
        out = [each for each in mesh.attributes if _is_out(each)]
        self._all = [_Attribute(each.name, each.data_type, each.domain, values_of(each)) for each in out]
        self.is_numbered = False  # whether the elements of a bmesh have rows

    def __bool__(self) -> bool:
        return bool(self._all)

    def part(self, bm: Any, domain: str) -> Part:
        """Return those of one domain, for the elements of a bmesh."""
        return Part(bm, domain, [each for each in self._all if each.domain == domain])

    def take_out(self, mesh: bpy.types.Mesh) -> None:
        """Remove them from a mesh in whichever mode."""
        for each in self._all:
            mesh.attributes.remove(mesh.attributes[each.name])

    def number(self, bm: Any) -> None:
        """Give the elements of a bmesh that has all elements of the mesh, in this order, their rows."""
        self.is_numbered = bool(self)
        for domain in self._domains:
            layer = getattr(bm, _SEQUENCES[domain]).layers.int.new(ROW + domain)
            for row, element in enumerate(_elements(bm, domain), start=1):  # 0: a new one that nobody wrote to
                element[layer] = row

    def put_back(self, mesh: bpy.types.Mesh) -> None:
        """Add them to a mesh in object mode that was made of the bmesh; new edges get Blender's default."""
        for domain in self._domains:
            rows = values_of(mesh.attributes[ROW + domain])[:, 0]
            mesh.attributes.remove(mesh.attributes[ROW + domain])
            known = rows > 0
            for each in self._all:
                if each.domain == domain:
                    attribute = mesh.attributes.new(each.name, each.kind, domain)
                    values = values_of(attribute)
                    values[known] = each.values[rows[known] - 1]
                    attribute.data.foreach_set(layout_of(attribute)[0], values.ravel())

    @property
    def _domains(self) -> list[str]:
        return sorted({each.domain for each in self._all})


class Part:
    """Values of one domain, as rows of numbers: as MeanLayers has those that bmesh knows."""

    def __init__(self, bm: Any, domain: str, attributes: list[_Attribute]) -> None:
        self._attributes = attributes
        self._means = [each for each in attributes if each.has_mean]
        self._layer = getattr(bm, _SEQUENCES[domain]).layers.int.get(ROW + domain)
        self.width = sum(each.columns(np.empty(0, dtype=np.int64)).shape[1] for each in self._means)

    def keys(self, numbers: Ints) -> list[Any]:
        """Return for each of these elements of the mesh what it has; equal where that is."""
        return [b"".join(each.values[number].tobytes() for each in self._attributes) for number in numbers.tolist()]

    def read(self, elements: Sequence[Any]) -> Floats:
        """Return (n, width): what has a mean."""
        rows = self._rows(elements) if self.width else np.empty(len(elements), dtype=np.int64)
        return np.concatenate([np.empty((len(elements), 0)), *(each.columns(rows) for each in self._means)], axis=1)

    def write(self, elements: Sequence[Any], means: Floats) -> None:
        """Give new elements, which have the rows of their examples, means (n, width) and copies of all else."""
        if not self.width:
            return
        rows = self._rows(elements)
        count, begin = len(self._attributes[0].values), 0
        for each in self._attributes:
            new = each.values[rows]
            if each.has_mean:
                end = begin + each.columns(rows[:0]).shape[1]
                new = each.blended(means[:, begin:end])
                begin = end
            each.values = np.concatenate([each.values, new])
        for row, element in enumerate(elements, start=count + 1):
            element[self._layer] = row

    def _rows(self, elements: Sequence[Any]) -> Ints:
        return np.array([element[self._layer] for element in elements], dtype=np.int64) - 1


def has_unreached(mesh: bpy.types.Mesh) -> bool:
    """Return whether a mesh in whichever mode has attributes that are to be set aside.

    Raises ValueError for one whose values are no numbers: Blender 4.2 to 5.0 has none.
    """
    found = [each for each in mesh.attributes if _is_out(each)]
    for each in found:
        if not has_numbers(each):
            raise ValueError(said("attribute_lost", name=each.name, type=each.data_type))
    return bool(found)


def _is_out(attribute: Any) -> bool:
    """Return whether bmesh has no access to an attribute, which is not part of the mesh itself either."""
    name, kind, domain = attribute.name, attribute.data_type, attribute.domain
    if attribute.is_required or domain not in _SEQUENCES or (kind, domain) == ("FLOAT2", "CORNER"):  # a UV map
        return False
    if (name, kind, domain) == (_AUTOMATIC, "INT16_2D", "CORNER"):
        return False
    if name in _FLAGS or (kind == "BOOLEAN" and name.startswith(".")):
        return False
    return not hasattr(bmesh.types.BMLayerAccessVert, _REACHED.get(kind, ""))


def _elements(bm: Any, domain: str) -> Iterator[Any]:
    if domain == "CORNER":
        return (corner for face in bm.faces for corner in face.loops)
    return iter(getattr(bm, _SEQUENCES[domain]))
