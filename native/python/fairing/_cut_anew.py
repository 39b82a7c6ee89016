"""The points of a fillet's line that a mesh of quads needs, for a second cut along it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from fairing._columns import Spot
from fairing._seam_arcs import FoundLine, NoRowsError
from fairing._types import FloatArray


class ChosenPoints:
    """Those at vertices and edges of the mesh, chosen ones between them, and some on walls."""

    def __init__(self, line: FoundLine, given: FloatArray) -> None:
        self._line, self._given = line, given
        self._points = {int(p): -1 for p in np.flatnonzero(line.is_bound())}
        self._wanted: set[int] = set()
        self._between: dict[int, dict[bytes, FloatArray]] = {}
        self._names: dict[tuple[int, bytes], int] = {}
        self._on_walls: list[tuple[int, int, FloatArray, float]] = []
        self._paths: dict[tuple[bytes, int], list[int]] = {}
        self._rows: list[tuple[int, int, int]] = []
        self._places: list[FloatArray] = []
        self._along: list[float] = []
        self._segments: list[tuple[int, int, int]] = []

    def add(self, spot: Spot) -> None:
        if spot.point >= 0:
            self._points[spot.point] = -1
            self._wanted.add(spot.point)
        else:
            self._between.setdefault(spot.segment, {})[spot.place.tobytes()] = spot.place

    def add_wall(self, spot: Spot, vertex: int, parts: int) -> None:
        """Points on a wall, which part it from a point of the line to a vertex."""
        edge = int(self._line.numbers[spot.point, 1]) if spot.point >= 0 else -1
        rows = self._line.walls[self._line.walls[:, 0] == edge] if edge >= 0 else self._line.walls[:0]
        if not len(rows) or vertex not in rows[0, 1:3]:
            raise NoRowsError
        _, tail, head, triangle, _ = rows[0].tolist()
        reach = float(self._line.along[spot.point])  # from the edge's smaller vertex
        end = 0.0 if vertex == min(tail, head) else 1.0
        path = []
        for k in range(1, parts):
            share = k / parts
            place = (1.0 - share) * spot.place + share * self._given[vertex]
            path.append(len(self._on_walls))
            self._on_walls.append((edge, triangle, place, (1.0 - share) * reach + share * end))
        self._paths[spot.place.tobytes(), vertex] = path

    def number(self) -> None:
        """Make the line anew; all points have their numbers from here on."""
        for p in self._points:
            self._points[p] = self._add_row(self._line.numbers[p].tolist(), self._line.places[p], self._line.along[p])
        for chain, segments, closed in self._line.chains():
            self._add_chain(chain, segments, closed)
        self._first_on_walls = len(self._rows)
        for edge, triangle, place, along in self._on_walls:
            self._add_row([-1, edge, triangle], place, along)
        new = np.array([row[0] < 0 for row in self._rows])
        self._vertices = np.where(new, len(self._given) + np.cumsum(new) - 1, [row[0] for row in self._rows]).tolist()
        self.vertex_count = len(self._given) + int(new.sum())

    def _add_row(self, numbers: Any, place: FloatArray, along: float) -> int:
        self._rows.append(tuple(numbers))
        self._places.append(place)
        self._along.append(along)
        return len(self._rows) - 1

    def _add_chain(self, chain: list[int], segments: list[int], closed: bool) -> None:
        found: list[tuple[int, int]] = []  # points in their order, and the triangle of the way to each
        for k, segment in enumerate(segments):
            triangle = int(self._line.segments[segment, 2])
            if chain[k] in self._points and not found and not closed:
                found.append((self._points[chain[k]], triangle))
            found += [(name, triangle) for name in self._names_in(segment)]
            if chain[k + 1] in self._points:
                found.append((self._points[chain[k + 1]], triangle))
        if closed and found:
            found.insert(0, found[-1])
        self._segments += [(a, b, triangle) for (a, _), (b, triangle) in zip(found, found[1:], strict=False)]

    def _names_in(self, segment: int) -> list[int]:
        """New points within a segment, in its order."""
        begin, end, triangle = self._line.segments[segment].tolist()
        way = self._line.places[end] - self._line.places[begin]
        inside = sorted(self._between.get(segment, {}).values(), key=lambda place: float(place @ way))
        names = []
        for place in inside:
            names.append(self._add_row((-1, -1, triangle), place, 0.0))
            self._names[segment, place.tobytes()] = names[-1]
        return names

    def vertex(self, spot: Spot) -> int:
        """Its number among the old vertices and the new points."""
        if spot.point >= 0:
            return int(self._vertices[self._points[spot.point]])
        return int(self._vertices[self._names[spot.segment, spot.place.tobytes()]])

    def wall(self, spot: Spot, vertex: int) -> list[int]:
        """The vertices on a wall from a point of the line to a vertex, which is not among them."""
        path = self._paths[spot.place.tobytes(), vertex]
        return [self.vertex(spot), *(int(self._vertices[self._first_on_walls + k]) for k in path)]

    def not_needed(self, must: Callable[[int], bool]) -> list[int]:
        """Vertices on diagonals, where no column is and nothing outside asks for one."""
        left = [p for p in self._points if p not in self._wanted and not must(p)]
        return [int(self._vertices[self._points[p]]) for p in left]

    def arrays(self) -> tuple[Any, ...]:
        """As `_core.cut_fillet` takes them."""
        return self._rows, [place.tolist() for place in self._places], self._along, self._segments

    def place(self, vertex: int) -> FloatArray:
        return self._places[self._vertices.index(vertex)]
