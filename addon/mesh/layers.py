"""Values of bmesh elements in bulk: those that have a mean, as rows of numbers, and those that are copied."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays.harmonic import limited_like
from ..arrays.types import Floats
from .free_normals import NAME as _OWN_NORMALS

_COPIED = ("int", "bool", "string")  # kinds of layers without a mean; BMLoop.copy_from takes Python's handle along
OF_VERTICES = ("float", "float_vector", "float_color", "color")
OF_CORNERS = ("uv", *OF_VERTICES)


class MeanLayers:
    """The layers of vertices, or of corners, whose values have a mean; a row of numbers for each element."""

    def __init__(self, layers: Any, kinds: Sequence[str]) -> None:
        self._layers = [
            (layer, kind == "uv", _WIDTHS[kind])
            for kind in kinds
            for layer in getattr(layers, kind).values()
            if layer.name != _OWN_NORMALS
        ]
        self.width = sum(width for _, _, width in self._layers)
        self.uv_names = [layer.name for layer, is_uv, _ in self._layers if is_uv]

    def read(self, elements: Sequence[Any]) -> Floats:
        """Return (n, width); columns of UVs come first, two for each of uv_names."""
        columns = [np.empty((len(elements), 0))]
        for layer, is_uv, width in self._layers:
            values = [element[layer].uv[:] if is_uv else element[layer] for element in elements]
            found = np.array([tuple(v) for v in values] if width > 1 else values, dtype=np.float64)
            columns.append(found.reshape(len(elements), width))
        return np.concatenate(columns, axis=1)

    def write(self, elements: Sequence[Any], rows: Floats, numbers: Sequence[int] | None = None) -> None:
        """Write rows (n, width); numbers: of the row that each element takes."""
        begin = 0
        for layer, is_uv, width in self._layers:
            part = rows[:, begin : begin + width]
            values = part.tolist() if width > 1 else part[:, 0].tolist()
            taken = values if numbers is None else [values[number] for number in numbers]
            if is_uv:
                for element, value in zip(elements, taken, strict=True):
                    element[layer].uv = value
            else:
                for element, value in zip(elements, taken, strict=True):
                    element[layer] = value
            begin += width


_WIDTHS = {"uv": 2, "float": 1, "float_vector": 3, "float_color": 4, "color": 4}


def copied_layers(layers: Any) -> list[Any]:
    """Return the layers whose values have no mean."""
    return [layer for kind in _COPIED for layer in getattr(layers, kind, {}).values()]


def copy(layers: Sequence[Any], examples: Sequence[Any], elements: Sequence[Any]) -> None:
    """Give each element the values of its example."""
    for layer in layers:
        for example, element in zip(examples, elements, strict=True):
            element[layer] = example[layer]


class Weights:
    """The vertex groups that some vertices are in."""

    def __init__(self, bm: Any, vertices: Sequence[Any]) -> None:
        self._layer = bm.verts.layers.deform.active
        of = [] if self._layer is None else [vertex[self._layer] for vertex in vertices]
        self._groups = sorted({group for weights in of for group in weights.keys()})  # noqa: SIM118 - not a dictionary
        self.width = len(self._groups)

    def read(self, vertices: Sequence[Any]) -> Floats:
        """Return (n, width): weights, 0 where a vertex is not in a group."""
        rows = [[vertex[self._layer].get(group, 0.0) for group in self._groups] for vertex in vertices]
        return np.array(rows, dtype=np.float64).reshape(len(vertices), self.width)

    def limited(self, rows: Floats, sources: Floats, bones: Sequence[int]) -> Floats:
        """Return rows (k, width) in as many groups of bones as one of the sources (n, width) is, at most.

        Where no group is of a bone all groups count.
        """
        counted = np.isin(self._groups, bones)
        return limited_like(rows, sources, counted if counted.any() else ~counted)

    def write(self, vertices: Sequence[Any], rows: Floats) -> None:
        """Write them; a weight of 0 is no member."""
        if not self._groups:
            return
        for vertex, row in zip(vertices, rows.tolist(), strict=True):
            own = vertex[self._layer]
            own.clear()
            for group, weight in zip(self._groups, row, strict=True):
                if weight > 0.0:
                    own[group] = weight


class Shapes:
    """Shape keys: how far each is from the shape that is shown, or where it is."""

    def __init__(self, bm: Any, keys: Any, shown: Any) -> None:
        """keys: of the mesh, shown: the one that the bmesh's positions are; None where there are none."""
        self._layers = list(bm.verts.layers.shape.values()) if keys is not None else []
        self.width = 3 * len(self._layers)
        self._shown = bm.verts.layers.shape.get(shown.name) if self._layers and shown is not None else None
        self.follow = self._shown is not None and keys.use_relative and shown == keys.reference_key
        # Keys relative to an edited Basis follow it when edit mode ends: till then their layers and its own are old.
        self._old = self._shown if self.follow else None

    def offsets(self, vertices: Sequence[Any]) -> Floats:
        """Return (n, 3 keys): from the shape that is shown to each key."""
        rows = [
            [number for layer in self._layers for number in vertex[layer] - self._start(vertex)] for vertex in vertices
        ]
        return np.array(rows, dtype=np.float64).reshape(len(vertices), self.width)

    def _start(self, vertex: Any) -> Any:
        return vertex.co if self._old is None else vertex[self._old]

    def write(self, vertices: Sequence[Any], offsets: Floats, starts: Floats) -> None:
        """Place keys at these offsets (n, 3 keys) from the starts (n, 3); the shown one is where the vertices are."""
        for k, layer in enumerate(self._layers):
            places = (starts + offsets[:, 3 * k : 3 * k + 3]).tolist()
            for vertex, place in zip(vertices, places, strict=True):
                vertex[layer] = place
        if self._shown is not None:
            for vertex in vertices:
                vertex[self._shown] = vertex.co
