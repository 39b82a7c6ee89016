"""The strip beside a seam, from line to line, and places on these lines."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from fairing._found_line import FoundLine, NoRowsError
from fairing._seam_arcs import LEFT, RIGHT, Arc, Run
from fairing._types import FloatArray

ROUND = 0.6  # of the width: a longer way around a corner of the seam begins and ends with columns of its own
_STRAIGHT = 1e-3  # of the spacing: nearer to the chord is no corner of the line


class WallPoint(NamedTuple):
    """On a wall's edge, or one of its vertices."""

    place: FloatArray
    vertex: int
    edge: int = -1
    triangle: int = -1
    along: float = 0.0


class Spot(NamedTuple):
    """A place on the line."""

    place: FloatArray
    point: int
    """Of the line, or −1:"""
    segment: int = -1
    """within that one of its segments."""


@dataclass
class Side:
    """The line on one side of a seam."""

    spots: list[Spot]
    segments: list[int]
    """Between one spot and the next."""
    feet: FloatArray
    """Ways along the seam."""
    must: list[bool]
    """Where edges outside come to the line."""

    def __post_init__(self) -> None:
        self.places = np.array([spot.place for spot in self.spots])
        self._measure()

    def _measure(self) -> None:
        steps = np.linalg.norm(np.diff(self.places, axis=0), axis=1)
        self.ways = np.concatenate([[0.0], np.cumsum(steps)])

    def index(self, place: FloatArray) -> int:
        """Of the first spot there."""
        return int(np.flatnonzero((self.places == place).all(axis=1))[0])

    @property
    def length(self) -> float:
        return float(self.ways[-1])

    def at(self, way: float) -> Spot:
        """The spot after that way."""
        k = int(np.clip(np.searchsorted(self.ways, way, side="right") - 1, 0, len(self.segments) - 1))
        step = self.ways[k + 1] - self.ways[k]
        share = (way - self.ways[k]) / step if step > 0 else 0.0
        for near, far in ((k, share), (k + 1, 1.0 - share)):
            if far * step <= 1e-9 * self.length:
                return self.spots[near]
        place = (1.0 - share) * self.spots[k].place + share * self.spots[k + 1].place
        return Spot(place, -1, self.segments[k])

    def put(self, after: int, spot: Spot, foot: float) -> None:
        """A spot between two others."""
        self.spots.insert(after + 1, spot)
        self.segments.insert(after, self.segments[after])
        self.feet = np.insert(self.feet, after + 1, foot)
        self.must.insert(after + 1, False)
        self.places = np.insert(self.places, after + 1, spot.place, axis=0)
        self._measure()

    def cut(self, first: int, last: int) -> Side:
        """From one of its spots to another."""
        return Side(
            self.spots[first : last + 1],
            self.segments[first:last],
            self.feet[first : last + 1],
            self.must[first : last + 1],
        )

    def turned_to(self, place: FloatArray) -> Side:
        """Of a closed one: begun at one of its spots."""
        k = self.index(place)
        own = [[*values[k:-1], *values[: k + 1]] for values in (self.spots, self.feet.tolist(), self.must)]
        return Side(own[0], [*self.segments[k:], *self.segments[:k]], np.array(own[1]), own[2])


@dataclass(frozen=True)
class Column:
    """Ways along both sides, and which of them stay: at edges outside, and where the line turns."""

    right: float
    left: float
    held: tuple[bool, bool] = (False, False)

    @property
    def ways(self) -> tuple[float, float]:
        return self.right, self.left

    def between(self, other: Column, share: float) -> Column:
        return Column((1 - share) * self.right + share * other.right, (1 - share) * self.left + share * other.left)


@dataclass
class Hook:
    """A long way around the end of a seam, on one side, to a wall."""

    spots: list[Spot]
    """From where the way around begins,"""
    segments: list[int]
    wall: list[WallPoint] = field(default_factory=list)
    """and from the wall back to the seam's end."""

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.diff([spot.place for spot in self.spots], axis=0), axis=1).sum())


@dataclass
class Strip:
    """What is between both sides of an arc."""

    arc: Arc
    sides: tuple[Side, Side]
    columns: list[Column]
    walled: dict[Column, tuple[list[WallPoint], list[WallPoint]]] = field(default_factory=dict)
    """Columns along walls, or beside hooks: what is between their right or left side and the arc's end."""
    hooks: dict[tuple[int, int], Hook] = field(default_factory=dict)
    """By the arc's end, and the side."""

    def spots(self, column: Column) -> tuple[Spot, Spot]:
        return self.sides[RIGHT].at(column.right), self.sides[LEFT].at(column.left)

    def along_walls(self, column: Column, points: FloatArray) -> FloatArray:
        """The places between both sides."""
        right, left = ([point.place for point in way] for way in self.walled[column])
        middle = points[self.arc.vertices[0 if column == self.columns[0] else -1]]
        return np.array([*right, middle, *left[::-1]])

    def beside(self, column: Column, way: float) -> tuple[Spot, Spot]:
        """Its spots; of the first and the last column of an open strip those that far inside, where it is a strip."""
        if self.arc.closed or column not in (self.columns[0], self.columns[-1]):
            return self.spots(column)
        other = self.columns[1 if column == self.columns[0] else -2]
        size = max(abs(column.right - other.right), abs(column.left - other.left))
        return self.spots(column.between(other, way / size))


def without_hook(side: Side, end: int, width: float) -> tuple[Side, Hook | None]:
    """A side without the long way around one of its ends."""
    near = np.abs(side.feet - side.feet[-end]) <= 1e-6 * abs(float(side.feet[-1] - side.feet[0]))
    tail = np.flatnonzero(near)
    if float(np.ptp(side.ways[tail])) <= ROUND * width or near.all():
        return side, None
    if end == 0:
        around = side.cut(0, int(tail[-1]))
        return side.cut(int(tail[-1]), len(side.spots) - 1), Hook(around.spots[::-1], around.segments[::-1])
    around = side.cut(int(tail[0]), len(side.spots) - 1)
    return side.cut(0, int(tail[0])), Hook(around.spots, around.segments)


def side_of(line: FoundLine, run: Run, must: Callable[[int], bool], ends: tuple[Spot | None, Spot | None]) -> Side:
    """A run with the corners at its ends, where it has some."""
    spots = [Spot(line.places[p], p) for p in run.points]
    segments, feet = list(run.segments), run.ways
    for which, end in enumerate(ends):
        if end is None or end.point in (run.points[0 if which == 0 else -1],):
            continue
        where = 0 if which == 0 else len(spots)
        spots.insert(where, end)
        segments.insert(0 if which == 0 else len(segments), end.segment)
        feet = np.insert(feet, where, feet[0 if which == 0 else -1])
    return Side(spots, segments, feet, [spot.point >= 0 and must(spot.point) for spot in spots])


def corner_between(line: FoundLine, before: list[int], after: list[int], segment: int, spacing: float) -> Spot:
    """Where the line turns within a segment: its ways before (to `before`'s last point) and after, prolonged, meet."""
    start, end = line.places[before[-1]], line.places[after[0]]
    come, go = _direction(line, before[::-1], spacing), _direction(line, after, spacing)
    middle = Spot(0.5 * (start + end), -1, segment)
    for spot in (Spot(start, before[-1]), Spot(end, after[0])):
        if np.linalg.norm(end - start) < _STRAIGHT * spacing:
            return spot
    if come is None or go is None:
        return middle
    normal = np.cross(come, go)
    size = float(normal @ normal)
    if size < 1e-12:
        return middle
    first = float(np.cross(end - start, -go) @ -normal) / size
    second = float(np.cross(end - start, come) @ normal) / size
    if first < _STRAIGHT * spacing or second > -_STRAIGHT * spacing:
        near = (first < _STRAIGHT * spacing) and abs(first) < _STRAIGHT * spacing
        far = abs(second) < _STRAIGHT * spacing
        return Spot(start, before[-1]) if near else Spot(end, after[0]) if far else middle
    place = start + first * come
    if np.linalg.norm(place - middle.place) > np.linalg.norm(end - start):
        return middle
    return Spot(place, -1, segment)


def _direction(line: FoundLine, points: list[int], spacing: float) -> FloatArray | None:
    """From a point further on to the first one, unit."""
    for p in points[1:4]:
        way = line.places[points[0]] - line.places[p]
        size = float(np.linalg.norm(way))
        if size > _STRAIGHT * spacing:
            direction: FloatArray = way / size
            return direction
    return None


def parted(spots: list[Spot], segments: list[int], count: int, must: Callable[[int], bool]) -> list[Spot]:
    """A way in edges of one length; where edges outside come to it they take the place of the nearest spot."""
    shares = np.arange(count + 1) / count
    whole = Side(spots, segments, np.zeros(len(spots)), [must(spot.point) for spot in spots])
    found = [whole.at(share * whole.length) for share in shares]
    taken: set[int] = set()
    for k in np.flatnonzero(whole.must)[:].tolist():
        if 0 < k < len(spots) - 1:
            nearest = 1 + int(np.abs(shares[1:-1] - whole.ways[k] / whole.length).argmin())
            if nearest in taken:
                raise NoRowsError
            taken.add(nearest)
            found[nearest] = spots[k]
    return found
