"""Edges that cross the line where a fillet ends: which of them count, and to which vertex of a seam they lead."""

from __future__ import annotations

import numpy as np

from fairing import _seams
from fairing._found_line import FoundLine
from fairing._types import FloatArray, IntArray

_FARTHEST = 32  # edges from the line to the seam


class SeamEdges:
    """Of a mesh's triangles, those around a fillet suffice; ``counted``: edges of quads and polygons, or all."""

    def __init__(self, line: FoundLine, points: FloatArray, triangles: IntArray, counted: IntArray | None) -> None:
        self._line, self._points = line, points
        self._counted = None if counted is None else set(_seams.keys_of(counted).tolist())
        self._seam = set(line.seams.ravel().tolist())
        self._third: dict[tuple[int, int], int] = {}
        for a, b, c in triangles.tolist():
            self._third[a, b], self._third[b, c], self._third[c, a] = c, a, b

    def must(self, point: int) -> bool:
        """Whether the mesh outside needs a point of the line."""
        vertex, edge, _ = self._line.numbers[point].tolist()
        return vertex >= 0 or (edge >= 0 and self._counts(*self._line.ends[point].tolist()))

    def linked(self, point: int) -> int:
        """The seam's vertex to which the edge leads, straight over vertices of four edges, or −1."""
        a, b = self._line.ends[point].tolist()
        if a < 0:
            return self._beside(int(self._line.numbers[point, 0]), point)
        inner, outer = (a, b) if self._far(a, point) < self._far(b, point) else (b, a)
        for _ in range(_FARTHEST):
            if inner in self._seam:
                return int(inner)
            around = self._around(inner)
            if len(around) != 4 or outer not in around:
                return -1
            inner, outer = around[(around.index(outer) + 2) % 4], inner
        return -1

    def _counts(self, a: int, b: int) -> bool:
        return self._counted is None or min(a, b) * _seams.LARGE + max(a, b) in self._counted

    def _beside(self, vertex: int, point: int) -> int:
        found = [v for v in self._around(vertex) if v in self._seam]
        return min(found, key=lambda v: self._far(v, point)) if found else -1

    def _far(self, vertex: int, point: int) -> float:
        """From the seam's edge that the point is reached from, about."""
        ends = self._points[self._line.feet[point]]
        return float(np.linalg.norm(ends - self._points[vertex], axis=1).min())

    def _around(self, vertex: int) -> list[int]:
        """Its neighbours by edges that count, clockwise; none at a border."""
        first = next((b for a, b in self._third if a == vertex), -1) if vertex >= 0 else -1
        found, at = [], first
        while at >= 0:
            found.append(at)
            at = self._third.get((vertex, at), -1)
            if at == first:
                return [v for v in found if self._counts(vertex, v)]
        return []
