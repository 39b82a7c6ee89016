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
_STRAIGHT = 1e-3  # of the spacing: nearer to the chord is no corner of the line


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
        steps = np.linalg.norm(np.diff([spot.place for spot in self.spots], axis=0), axis=1)
        self.ways = np.concatenate([[0.0], np.cumsum(steps)])

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
        self.__post_init__()

    def turned_to(self, place: FloatArray) -> Side:
        """Of a closed one: begun at one of its spots."""
        k = next(k for k, spot in enumerate(self.spots) if (spot.place == place).all())
        own = [[*values[k:-1], *values[: k + 1]] for values in (self.spots, self.feet.tolist(), self.must)]
        return Side(own[0], [*self.segments[k:], *self.segments[:k]], np.array(own[1]), own[2])


class Column(NamedTuple):
    """Ways along both sides."""

    right: float
    left: float
    must: bool = True

    def between(self, other: Column, share: float) -> Column:
        return Column(
            (1 - share) * self.right + share * other.right, (1 - share) * self.left + share * other.left, False
        )


@dataclass
class Strip:
    """What is between both sides of an arc."""

    arc: Arc
    sides: tuple[Side, Side]
    columns: list[Column]
    walled: dict[Column, FloatArray] = field(default_factory=dict)
    """Columns along walls, and their places between both sides."""

    def spots(self, column: Column) -> tuple[Spot, Spot]:
        return self.sides[RIGHT].at(column.right), self.sides[LEFT].at(column.left)

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
        begin = next((k for k in range(len(inner)) if all(own[k].around is None for own in marks)), 0)
        sides = sides[0].turned_to(marks[0][begin].spot), sides[1].turned_to(marks[1][begin].spot)
        marks = [[*own[begin + 1 :], *own[:begin]] for own in marks]
    anchors = _anchors(sides, marks)
    columns: list[Column] = []
    for before, after in zip(anchors, anchors[1:], strict=False):
        columns += [before, *_between(sides, before, after, sizes[1])]
    columns.append(anchors[-1])
    return Strip(arc, sides, _thinned(columns, _NEAR * sizes[1]))


class _Mark(NamedTuple):
    """A vertex of the seam on one side: the place that belongs to it, and the ends of the way around it."""

    spot: FloatArray
    around: tuple[FloatArray, FloatArray] | None
    plain: bool
    """Whether the line runs straight there."""


def _mark(line: FoundLine, side: Side, foot: float, sizes: tuple[float, float]) -> _Mark:
    """Put a spot there."""
    near = 1e-6 * float(side.feet[-1])
    last = int(np.searchsorted(side.feet, foot - near, side="left")) - 1
    first = int(np.searchsorted(side.feet, foot + near, side="right"))
    last, first = max(last, 0), min(first, len(side.spots) - 1)
    if first - last == 1:
        spot, plain = _turn(line, side, last, foot, sizes[1])
        if spot is not side.spots[last] and spot is not side.spots[first]:
            side.put(last, spot, foot)
        return _Mark(spot.place, None, plain)
    begin, end = last + 1, first - 1
    way = float(side.ways[end] - side.ways[begin])
    middle = side.at(0.5 * float(side.ways[begin] + side.ways[end]))
    around = (side.spots[begin].place, side.spots[end].place) if way > _ROUND * sizes[0] else None
    k = int(np.searchsorted(side.ways, 0.5 * (side.ways[begin] + side.ways[end]), side="right")) - 1
    if middle.point < 0:
        side.put(k, middle, foot)
    return _Mark(middle.place, around, way < sizes[1])


def _turn(line: FoundLine, side: Side, last: int, foot: float, spacing: float) -> tuple[Spot, bool]:
    """Between two spots: where the line turns, or as far along as the foot, and whether it is straight."""
    gap = float(side.feet[last + 1] - side.feet[last])
    step = float(side.ways[last + 1] - side.ways[last])
    ends = side.spots[last], side.spots[last + 1]
    if gap > 1.02 * step + 1e-3 * spacing and all(end.point >= 0 for end in ends):
        before = [spot.point for spot in side.spots[: last + 1][-4:] if spot.point >= 0]
        after = [spot.point for spot in side.spots[last + 1 :][:4] if spot.point >= 0]
        return corner_between(line, before, after, side.segments[last], spacing), False
    share = (foot - float(side.feet[last])) / gap if gap > 0 else 0.5
    return side.at(float(side.ways[last]) + np.clip(share, 0.0, 1.0) * step), True


def _take_linked(
    side: Side, marks: list[_Mark], vertices: list[int], linked: Callable[[int], int], spacing: float
) -> None:
    """The nearest of the edges that lead to a vertex of the seam, or are near its mark, come to its column."""
    number = {vertex: k for k, vertex in enumerate(vertices)}
    places = np.array([mark.spot for mark in marks]).reshape(-1, 3)
    best: dict[int, tuple[float, int]] = {}
    for at, spot in enumerate(side.spots):
        if not side.must[at] or not len(places):
            continue
        far = np.linalg.norm(places - spot.place, axis=1)
        k = number.get(linked(spot.point), -1)
        if k < 0 and far.min() < _NEAR * spacing:
            k = int(far.argmin())
        if k >= 0:
            best[k] = min(best.get(k, (np.inf, -1)), (float(far[k]), at))
    for k, (_, at) in best.items():
        marks[k] = marks[k]._replace(spot=side.spots[at].place, plain=False)


def _way(side: Side, place: FloatArray, least: float) -> float:
    """Along a side to one of its spots, the first one that is not before."""
    same = [k for k, spot in enumerate(side.spots) if spot.place is place or (spot.place == place).all()]
    ways = [float(side.ways[k]) for k in same if side.ways[k] >= least]
    if not ways:
        raise NoRowsError
    return ways[0]


def _anchors(sides: tuple[Side, Side], marks: list[list[_Mark]]) -> list[Column]:
    """The columns at the seam's vertices, and at the ends of ways around them."""
    found: list[Column] = []
    for right, left in zip(*marks, strict=True):
        at = Column(
            _way(sides[RIGHT], right.spot, 0.0), _way(sides[LEFT], left.spot, 0.0), not (right.plain and left.plain)
        )
        found += _around(sides, at, (right, left))
    last = Column(sides[RIGHT].length, sides[LEFT].length)
    ordered = [Column(0.0, 0.0)]
    for column in found:
        if all(ordered[-1][side] < column[side] < last[side] for side in (RIGHT, LEFT)):
            ordered.append(column)
    return [*ordered, last]


def _around(sides: tuple[Side, Side], at: Column, marks: tuple[_Mark, _Mark]) -> list[Column]:
    """With the columns where a long way around the seam's vertex begins and ends."""
    for which, mark in enumerate(marks):
        if mark.around is None:
            continue
        begin, end = (_way(sides[which], place, 0.0) for place in mark.around)
        own, other = (at.right, at.left) if which == RIGHT else (at.left, at.right)
        if not begin < own < end:
            return [at]
        ahead = _AHEAD * (end - begin)
        pairs = [(begin, other - ahead), (own, other), (end, other + ahead)]
        return [Column(*(pair if which == RIGHT else pair[::-1])) for pair in pairs]
    return [at]


def _between(sides: tuple[Side, Side], before: Column, after: Column, spacing: float) -> list[Column]:
    """Columns at the edges outside that come to either side between two others."""
    shares: list[tuple[float, int]] = []
    for which, side in enumerate(sides):
        low, high = before[which], after[which]
        for at in np.flatnonzero(side.must).tolist():
            if low < side.ways[at] < high:
                shares.append(((float(side.ways[at]) - low) / (high - low), which))
    shares.sort()
    size = max(after.right - before.right, after.left - before.left)
    found, k = [], 0
    while k < len(shares):
        share, which = shares[k]
        pair = [share, share]
        if k + 1 < len(shares) and shares[k + 1][1] != which and (shares[k + 1][0] - share) * size < _NEAR * spacing:
            k += 1
            pair[shares[k][1]] = shares[k][0]
        found.append(
            Column(*((1 - pair[side]) * before[side] + pair[side] * after[side] for side in (RIGHT, LEFT)), True)
        )
        k += 1
    return found


def _thinned(columns: list[Column], least: float) -> list[Column]:
    """Without columns that nothing outside asks for and that are nearer than that to their neighbours."""
    kept: list[Column] = []
    for k, column in enumerate(columns):
        beside = [*kept[-1:], *(other for other in columns[k + 1 :][:1] if other.must)]
        near = any(abs(column[side] - other[side]) < least for other in beside for side in (RIGHT, LEFT))
        if column.must or not near:
            kept.append(column)
    return kept
