"""Where the vertices of rows lie on the old mesh: each on its own side of a seam, middle rows on the seam itself.

What belongs to corners, like places in a texture, often differs on both sides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fairing import _seams
from fairing._types import FloatArray, IntArray

_AT_END = 0.02  # of an edge: nearer to one of its ends a place is that, so that all sides there know it


class Wanted(NamedTuple):
    """On the side of an old triangle, on one of some edges (e, 2), or at a vertex; anywhere."""

    triangle: int = -1
    edges: IntArray | None = None
    vertex: int = -1


class RowOrigins:
    """``inside``: the old triangles (i,) beneath a fillet; ``parting``: edges (e, 2) between its sides."""

    def __init__(self, points: FloatArray, triangles: IntArray, inside: IntArray, parting: IntArray) -> None:
        self._points, self._triangles = points, triangles
        self._beside: dict[tuple[int, int], int] = {}
        for t in inside.tolist():
            a, b, c = triangles[t].tolist()
            self._beside[a, b] = self._beside[b, c] = self._beside[c, a] = t
        self._side = self._sides(set(_seams.keys_of(parting).tolist()))

    def of(self, places: FloatArray, under: IntArray, wanted: list[Wanted]) -> tuple[IntArray, FloatArray]:
        """Old triangles (k,) and weights (k, 3) there of places that lie on one of three triangles (k, 3), or near."""
        rows = zip(places, under.tolist(), self._weights(places, under), wanted, strict=True)
        found = [self._at(*row) for row in rows]
        old, weights = zip(*found, strict=True) if found else ((), ())
        names: IntArray = np.array(old, dtype=np.int32)
        return names, np.array(weights).reshape(-1, 3)

    def _at(self, place: FloatArray, under: list[int], weights: FloatArray, wish: Wanted) -> tuple[int, FloatArray]:
        if wish.edges is not None and len(wish.edges):
            return self._on_edge(place, wish.edges, -1)
        if wish.vertex >= 0:
            return self._at_vertex(wish.vertex)
        own = self._side.get(wish.triangle, -1)
        alike = [k for k, t in enumerate(under) if t >= 0 and own in (-1, self._side.get(t, -1))]
        if not alike:
            return self._on_edge(place, self._border(own), own)
        best = max(alike, key=lambda k: float(weights[k].min()))
        inside = np.clip(weights[best], 0.0, None)
        return under[best], inside / inside.sum()

    def _at_vertex(self, vertex: int) -> tuple[int, FloatArray]:
        t = next(t for (a, _), t in self._beside.items() if a == vertex)
        return t, (self._triangles[t] == vertex).astype(np.float64)

    def _border(self, side: int) -> IntArray:
        """The edges around a side."""
        pairs = [
            (a, b) for (a, b), t in self._beside.items()
            if self._side[t] == side and self._side.get(self._beside.get((b, a), -1), -1) != side
        ]  # fmt: skip
        edges: IntArray = np.array(pairs, dtype=np.int32).reshape(-1, 2)
        return edges

    def _on_edge(self, place: FloatArray, edges: IntArray, side: int) -> tuple[int, FloatArray]:
        """The nearest point of the edges, in a triangle beside it: on a side, if there is one."""
        start, way = self._points[edges[:, 0]], self._points[edges[:, 1]] - self._points[edges[:, 0]]
        squared = np.maximum((way * way).sum(axis=1), 1e-300)
        share = np.clip(((place - start) * way).sum(axis=1) / squared, 0.0, 1.0)
        k = int(np.linalg.norm(start + share[:, None] * way - place, axis=1).argmin())
        a, b = edges[k].tolist()
        share[k] = round(float(share[k])) if abs(share[k] - 0.5) > 0.5 - _AT_END else share[k]
        beside = [self._beside[pair] for pair in ((a, b), (b, a)) if pair in self._beside]
        t = next((t for t in beside if self._side[t] == side), beside[0])
        corners = self._triangles[t].tolist()
        weights = np.zeros(3)
        weights[corners.index(a)], weights[corners.index(b)] = 1.0 - share[k], share[k]
        return t, weights

    def _weights(self, places: FloatArray, under: IntArray) -> FloatArray:
        """(k, 3, 3) barycentric weights of the places' feet in the planes of the triangles under them."""
        a, b, c = np.moveaxis(self._points[self._triangles[np.maximum(under, 0)]], 2, 0)
        normal = np.cross(b - a, c - a)
        squared = np.maximum((normal * normal).sum(axis=2), 1e-300)
        u = (normal * np.cross(c - b, places[:, None] - b)).sum(axis=2) / squared
        v = (normal * np.cross(a - c, places[:, None] - c)).sum(axis=2) / squared
        return np.stack([u, v, 1.0 - u - v], axis=2)

    def _sides(self, parting: set[int]) -> dict[int, int]:
        """A number for each triangle: the same where nothing parts them."""
        side: dict[int, int] = {}
        for first in self._beside.values():
            waiting = [first]
            while waiting:
                t = waiting.pop()
                if t in side:
                    continue
                side[t] = first
                corners = self._triangles[t].tolist()
                for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
                    other = self._beside.get((b, a))
                    if other is not None and min(a, b) * _seams.LARGE + max(a, b) not in parting:
                        waiting.append(other)
        return side
