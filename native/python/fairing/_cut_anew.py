"""The points of a fillet's line that a mesh of quads needs, for a second cut along it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from fairing._found_line import FoundLine, NoRowsError
from fairing._strips import Spot, WallPoint
from fairing._types import FloatArray


def wall_way(line: FoundLine, given: FloatArray, spot: Spot, vertex: int, parts: int) -> list[WallPoint]:
    """The points on walls that part the way from a point of the line to a vertex; vertices between are among them."""
    edge = int(line.numbers[spot.point, 1]) if spot.point >= 0 else -1
    walls = {number: (tail, head, triangle) for number, tail, head, triangle, _ in line.walls.tolist()}
    if edge not in walls:
        raise NoRowsError
    steps = _steps(walls, vertex, edge)
    places = [spot.place, *(given[v] for v, _ in steps)]
    ways = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    slots = np.rint(parts * ways / ways[-1]).astype(int)
    if (np.diff(slots) <= 0).any():
        raise NoRowsError
    found: list[WallPoint] = []
    for k, (reached, over) in enumerate(steps):
        low = min(walls[over][:2])
        size = float(np.linalg.norm(given[walls[over][0]] - given[walls[over][1]]))
        for slot in range(slots[k] + 1, slots[k + 1]):
            share = (slot - slots[k]) / (slots[k + 1] - slots[k])
            place = (1.0 - share) * places[k] + share * places[k + 1]
            along = float(np.linalg.norm(place - given[low])) / size
            found.append(WallPoint(place, -1, over, walls[over][2], along))
        if k + 1 < len(steps):
            found.append(WallPoint(given[reached], reached))
    return found


def _steps(walls: dict[int, tuple[int, int, int]], vertex: int, edge: int) -> list[tuple[int, int]]:
    """The vertices passed from an edge to a vertex, which comes last, and the edges over which each is reached."""
    before: dict[int, tuple[int, int]] = {vertex: (-1, -1)}
    waiting = [vertex]
    for at in waiting:
        if at in walls[edge][:2]:
            break
        for number, (tail, head, _) in walls.items():
            if at in (tail, head) and number != edge:
                other = tail + head - at
                if other not in before:
                    before[other] = at, number
                    waiting.append(other)
    reached = next((v for v in waiting if v in walls[edge][:2]), -1)
    if reached < 0:
        raise NoRowsError
    steps = [(reached, edge)]
    while steps[-1][0] != vertex:
        steps.append(before[steps[-1][0]])
    return steps


class ChosenPoints:
    """Those at vertices and edges of the mesh, chosen ones between them, and some on walls."""

    def __init__(self, line: FoundLine, given: FloatArray) -> None:
        self._line, self._given = line, given
        self._points = {int(p): -1 for p in np.flatnonzero(line.is_bound())}
        self._wanted: set[int] = set()
        self._between: dict[int, dict[bytes, FloatArray]] = {}
        self._names: dict[tuple[int, bytes], int] = {}
        self._on_walls: list[WallPoint] = []
        self._paths: dict[tuple[bytes, int], list[WallPoint]] = {}
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

    def add_wall(self, spot: Spot, vertex: int, way: list[WallPoint]) -> None:
        """Points on walls between a point of the line and a vertex."""
        self._on_walls += [point for point in way if point.vertex < 0]
        self._paths[spot.place.tobytes(), vertex] = way

    def number(self) -> None:
        """Make the line anew; all points have their numbers from here on."""
        for p in self._points:
            self._points[p] = self._add_row(self._line.numbers[p].tolist(), self._line.places[p], self._line.along[p])
        for chain, segments, closed in self._line.chains():
            self._add_chain(chain, segments, closed)
        rows = {
            point.place.tobytes(): self._add_row([-1, point.edge, point.triangle], point.place, point.along)
            for point in self._on_walls
        }
        new = np.array([row[0] < 0 for row in self._rows])
        self._vertices = np.where(new, len(self._given) + np.cumsum(new) - 1, [row[0] for row in self._rows]).tolist()
        self._walls = {place: int(self._vertices[row]) for place, row in rows.items()}
        self.vertex_count = len(self._given) + int(new.sum())

    def _add_row(self, numbers: Any, place: FloatArray, along: float) -> int:
        self._rows.append(tuple(numbers))
        self._places.append(place)
        self._along.append(along)
        return len(self._rows) - 1

    def _add_chain(self, chain: list[int], segments: list[int], closed: bool) -> None:
        found: list[tuple[int, int]] = []  # points in their order, and the triangle of the way to each
        for k, segment in enumerate(segments):
            triangle = int(self._line.segments[segment, 2]) if segment >= 0 else -1
            if chain[k] in self._points and not found and not closed:
                found.append((self._points[chain[k]], triangle))
            found += [(name, triangle) for name in self._names_in(segment)]
            if chain[k + 1] in self._points:
                found.append((self._points[chain[k + 1]], triangle))
        if closed and found:
            found.insert(0, found[-1])
        pairs = pairwise(found)
        self._segments += [(a, b, triangle) for (a, _), (b, triangle) in pairs if triangle >= 0]

    def _names_in(self, segment: int) -> list[int]:
        """New points within a segment, in its order."""
        if segment < 0:
            return []
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

    def is_walled(self, spot: Spot) -> bool:
        return spot.point >= 0 and bool(np.isin(self._line.numbers[spot.point, 1], self._line.walls[:, 0]))

    def triangle(self, spot: Spot) -> int:
        """An old one that it is in, or beside."""
        row = self._line.numbers[spot.point] if spot.point >= 0 else self._line.segments[spot.segment]
        return int(row[2])

    def triangle_at(self, vertex: int) -> int:
        """The same of one of the line's points."""
        return int(self._rows[self._vertices.index(vertex)][2])

    def wall(self, spot: Spot, vertex: int) -> list[int]:
        """The vertices on a wall from a point of the line to a vertex, which is not among them."""
        way = self._paths[spot.place.tobytes(), vertex]
        inner = [point.vertex if point.vertex >= 0 else self._walls[point.place.tobytes()] for point in way]
        return [self.vertex(spot), *inner]

    def not_needed(self, must: Callable[[int], bool]) -> list[int]:
        """Vertices on diagonals, where no column is and nothing outside asks for one."""
        left = [p for p in self._points if p not in self._wanted and not must(p)]
        return [int(self._vertices[self._points[p]]) for p in left]

    def arrays(self) -> tuple[Any, ...]:
        """As `_core.cut_fillet` takes them."""
        return self._rows, [place.tolist() for place in self._places], self._along, self._segments

    def place(self, vertex: int) -> FloatArray:
        found: FloatArray = self._places[self._vertices.index(vertex)]
        return found
