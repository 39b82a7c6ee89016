"""Columns of quads across a seam: pairs of places on the lines beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from fairing._seam_arcs import LEFT, RIGHT, Arc, FoundLine, NoRowsError, Run
from fairing._types import FloatArray

_NEAR = 0.3  # of the spacing: what is that near to each other is in one column (as fillet/parted_edges' clear_of_line)
_ROUND = 0.6  # of the width: a longer way around a corner of the seam begins and ends with columns of its own
_AHEAD = 0.25  # of such a way: as far before and after the corner these are on the other side
_CORNER = 0.35  # radians, as fillet/limits' corner_angle: a line that turns by less may be passed in a chord
_CROWDED = 0.2  # of the gap on the other side
_MOST_SWEEPS = 50  # over columns in a row that make room for each other
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

    def turned_to(self, place: FloatArray) -> Side:
        """Of a closed one: begun at one of its spots."""
        k = self.index(place)
        own = [[*values[k:-1], *values[: k + 1]] for values in (self.spots, self.feet.tolist(), self.must)]
        return Side(own[0], [*self.segments[k:], *self.segments[:k]], np.array(own[1]), own[2])


class Column(NamedTuple):
    """Ways along both sides, and which of them stay: at edges outside, and where the line turns."""

    right: float
    left: float
    held: tuple[bool, bool] = (False, False)

    def between(self, other: Column, share: float) -> Column:
        return Column((1 - share) * self.right + share * other.right, (1 - share) * self.left + share * other.left)


@dataclass
class Strip:
    """What is between both sides of an arc."""

    arc: Arc
    sides: tuple[Side, Side]
    columns: list[Column]
    walled: dict[Column, tuple[list[WallPoint], list[WallPoint]]] = field(default_factory=dict)
    """Columns along walls: what is between their right or left side and the arc's end."""

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


def strip_of(
    line: FoundLine, arc: Arc, sides: tuple[Side, Side], linked: Callable[[int], int], sizes: tuple[float, float]
) -> Strip:
    """With a column at each vertex of the seam and at each edge outside.

    linked: the seam's vertex to which the edge at a point of the line leads, or −1. sizes: width and spacing.
    """
    inner = range(1, len(arc.vertices) if arc.closed else len(arc.vertices) - 1)
    marks = [[_mark(line, side, float(arc.ways[k]), sizes) for k in inner] for side in sides]
    for side, own in zip(sides, marks, strict=True):
        _take_linked(side, own, [arc.vertices[k] for k in inner], linked, sizes[1])
    if arc.closed:
        begin = _begin(marks)
        first = [own[begin] for own in marks]
        if first[RIGHT] is None or first[LEFT] is None:
            raise NoRowsError
        sides = sides[RIGHT].turned_to(first[RIGHT].spot), sides[LEFT].turned_to(first[LEFT].spot)
        marks = [[*own[begin + 1 :], *own[:begin]] for own in marks]
    anchors = _anchors(sides, marks)
    columns: list[Column] = []
    for before, after in zip(anchors, anchors[1:], strict=False):
        columns += [before, *_between(sides, before, after, sizes[1])]
    columns = _spread(_thinned([*columns, anchors[-1]], _NEAR * sizes[1]))
    return Strip(arc, sides, columns)


def _begin(marks: list[list[_Mark | None]]) -> int:
    """Where a closed strip is to begin: at a vertex that has marks, and no ways around it."""
    pairs = list(zip(*marks, strict=True))
    return next((k for k, pair in enumerate(pairs) if all(mark and mark.around is None for mark in pair)), 0)


class _Mark(NamedTuple):
    """A vertex of the seam on one side: the place that belongs to it, and the ends of the way around it."""

    spot: FloatArray
    around: tuple[FloatArray, FloatArray] | None
    held: bool
    """Whether the line turns there, or an edge outside comes to it."""


def _mark(line: FoundLine, side: Side, foot: float, sizes: tuple[float, float]) -> _Mark | None:
    """Put a spot there; none where the line begins behind it, or ends before."""
    near = 1e-6 * float(side.feet[-1])
    last = int(np.searchsorted(side.feet, foot - near, side="left")) - 1
    first = int(np.searchsorted(side.feet, foot + near, side="right"))
    if last < 0 or first >= len(side.spots):
        return None
    if first - last == 1:
        spot = _turn(line, side, last, foot, sizes[1])
        if spot is not side.spots[last] and spot is not side.spots[first]:
            side.put(last, spot, foot)
        return _Mark(spot.place, None, _bends(side, spot.place, sizes[1]))
    begin, end = float(side.ways[last + 1]), float(side.ways[first - 1])
    middle = side.at(0.5 * (begin + end))
    around = (side.spots[last + 1].place, side.spots[first - 1].place) if end - begin > _ROUND * sizes[0] else None
    if middle.point < 0:
        side.put(int(np.searchsorted(side.ways, 0.5 * (begin + end), side="right")) - 1, middle, foot)
    return _Mark(middle.place, around, _bends(side, middle.place, sizes[1]))


def _bends(side: Side, place: FloatArray, spacing: float) -> bool:
    way = _way(side, place)
    ways = place - side.at(max(way - spacing, 0.0)).place, side.at(min(way + spacing, side.length)).place - place
    sizes = [float(np.linalg.norm(each)) for each in ways]
    return float(ways[0] @ ways[1]) < np.cos(_CORNER) * sizes[0] * sizes[1]


def _turn(line: FoundLine, side: Side, last: int, foot: float, spacing: float) -> Spot:
    """Between two spots: where the line turns, or as far along as the foot."""
    gap = float(side.feet[last + 1] - side.feet[last])
    step = float(side.ways[last + 1] - side.ways[last])
    ends = side.spots[last], side.spots[last + 1]
    if gap > 1.02 * step + 1e-3 * spacing and all(end.point >= 0 for end in ends):
        before = [spot.point for spot in side.spots[: last + 1][-4:] if spot.point >= 0]
        after = [spot.point for spot in side.spots[last + 1 :][:4] if spot.point >= 0]
        return corner_between(line, before, after, side.segments[last], spacing)
    share = (foot - float(side.feet[last])) / gap if gap > 0 else 0.5
    return side.at(float(side.ways[last]) + np.clip(share, 0.0, 1.0) * step)


def _take_linked(
    side: Side, marks: list[_Mark | None], vertices: list[int], linked: Callable[[int], int], spacing: float
) -> None:
    """The nearest of the edges that lead to a vertex of the seam, or are near its mark, come to its column."""
    number = {vertex: k for k, vertex in enumerate(vertices)}
    places = np.array([np.full(3, np.inf) if mark is None else mark.spot for mark in marks]).reshape(-1, 3)
    best: dict[int, tuple[float, int]] = {}
    for at, spot in enumerate(side.spots):
        if not side.must[at] or not len(places):
            continue
        far = np.linalg.norm(places - spot.place, axis=1)
        k = number.get(linked(spot.point), -1)
        if k < 0 and far.min() < _NEAR * spacing:
            k = int(far.argmin())
        if k >= 0 and marks[k] is not None:
            best[k] = min(best.get(k, (np.inf, -1)), (float(far[k]), at))
    for k, (_, at) in best.items():
        mark = marks[k]
        assert mark is not None
        marks[k] = mark._replace(spot=side.spots[at].place, held=True)


def _way(side: Side, place: FloatArray) -> float:
    """Along a side to one of its spots."""
    return float(side.ways[side.index(place)])


def _anchors(sides: tuple[Side, Side], marks: list[list[_Mark | None]]) -> list[Column]:
    """The columns at the seam's vertices, and at the ends of ways around them, in their order."""
    last = Column(sides[RIGHT].length, sides[LEFT].length, (True, True))
    ordered = [Column(0.0, 0.0, (True, True))]
    for right, left in zip(*marks, strict=True):
        if right is None or left is None:
            continue
        at = Column(_way(sides[RIGHT], right.spot), _way(sides[LEFT], left.spot), (right.held, left.held))
        for column in _around(sides, at, (right, left)):
            before = ordered[-1]
            ways = [min(max(column[side], before[side]), last[side]) for side in (RIGHT, LEFT)]
            held = [column.held[side] and before[side] < column[side] < last[side] for side in (RIGHT, LEFT)]
            if any(before[side] < ways[side] < last[side] for side in (RIGHT, LEFT)):
                ordered.append(Column(ways[0], ways[1], (held[0], held[1])))
    return [*ordered, last]


def _around(sides: tuple[Side, Side], at: Column, marks: tuple[_Mark, _Mark]) -> list[Column]:
    """With the columns where a long way around the seam's vertex begins and ends."""
    for which, mark in enumerate(marks):
        if mark.around is None:
            continue
        begin, end = (_way(sides[which], place) for place in mark.around)
        own, other = (at.right, at.left) if which == RIGHT else (at.left, at.right)
        if not begin < own < end:
            return [at]
        ahead = _AHEAD * (end - begin)
        turns = [(begin, other - ahead), (end, other + ahead)]
        first, second = (Column(*(pair if which == RIGHT else pair[::-1])) for pair in turns)
        return [first, at, second]
    return [at]


def _between(sides: tuple[Side, Side], before: Column, after: Column, spacing: float) -> list[Column]:
    """Columns at the edges outside that come to either side between two others."""
    shares: list[tuple[float, int]] = []
    for which, side in enumerate(sides):
        low, high = before[which], after[which]
        shares += [
            ((float(side.ways[at]) - low) / (high - low), which)
            for at in np.flatnonzero(side.must).tolist()
            if low < side.ways[at] < high
        ]
    shares.sort()
    size = max(after.right - before.right, after.left - before.left)
    found, k = [], 0
    while k < len(shares):
        share, which = shares[k]
        pair, held = [share, share], [which == RIGHT, which == LEFT]
        if k + 1 < len(shares) and shares[k + 1][1] != which and (shares[k + 1][0] - share) * size < _NEAR * spacing:
            k += 1
            pair[shares[k][1]], held = shares[k][0], [True, True]
        ways = [(1 - pair[side]) * before[side] + pair[side] * after[side] for side in (RIGHT, LEFT)]
        found.append(Column(ways[0], ways[1], (held[0], held[1])))
        k += 1
    return found


def _thinned(columns: list[Column], least: float) -> list[Column]:
    """Without columns that nothing outside asks for and that are nearer than that to their neighbours."""
    kept: list[Column] = []
    for k, column in enumerate(columns):
        beside = [*kept[-1:], *(other for other in columns[k + 1 :][:1] if any(other.held))]
        near = any(abs(column[side] - other[side]) < least for other in beside for side in (RIGHT, LEFT))
        if any(column.held) or not near:
            kept.append(column)
    return kept


def _spread(columns: list[Column]) -> list[Column]:
    """Ways that nothing holds move where one side's are crowded; raises NoRowsError where that is of no avail."""
    ways = np.array([[column.right, column.left] for column in columns])
    for _ in range(_MOST_SWEEPS):
        gaps = np.diff(ways, axis=0)
        crowded = gaps < _CROWDED * gaps[:, ::-1]
        moved = False
        for k in range(1, len(columns) - 1):
            for side in (RIGHT, LEFT):
                if columns[k].held[side] or not (crowded[k - 1, side] or crowded[k, side]):
                    continue
                other = ways[k - 1 : k + 2, 1 - side]
                share = (other[1] - other[0]) / (other[2] - other[0]) if other[2] > other[0] else 0.5
                ways[k, side] = (1 - share) * ways[k - 1, side] + share * ways[k + 1, side]
                moved = True
        if not moved:
            break
    if (np.diff(ways, axis=0) <= 0.0).any():
        raise NoRowsError
    return [Column(*pair, column.held) for pair, column in zip(ways.tolist(), columns, strict=True)]
