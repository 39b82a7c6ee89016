"""Columns of quads across a seam: pairs of places on the lines beside it."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from fairing._found_line import FoundLine, NoRowsError
from fairing._seam_arcs import LEFT, RIGHT, Arc
from fairing._strips import ROUND, Column, Side, Spot, Strip, corner_between
from fairing._types import FloatArray

_NEAR = 0.3  # of the spacing, as clear_of_line in fillet/parted_edges: what is that near is in one column
_AHEAD = 0.25  # of such a way: as far before and after the corner these are on the other side
_CORNER = 0.35  # radians, as fillet/limits' corner_angle: a line that turns by less may be passed in a chord
_AROUND = 0.5  # of a side's length: places that are further from each other than that are nearer the other way around
_CROWDED = 0.2  # of the gap on the other side
_MOST_SWEEPS = 50  # over columns in a row that make room for each other


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
        right, left = (own[begin] for own in marks)
        if right is None or left is None:
            raise NoRowsError
        sides = sides[RIGHT].turned_to(right.spot), sides[LEFT].turned_to(left.spot)
        marks = [[*own[begin + 1 :], *own[:begin]] for own in marks]
    anchors = _with_musts(sides, _anchors(sides, marks, arc.closed))
    columns: list[Column] = []
    for before, after in pairwise(anchors):
        columns += [before, *_between(sides, before, after, sizes[1])]
    columns = _paired(_thinned([*columns, anchors[-1]], _NEAR * sizes[1]), _NEAR * sizes[1])
    columns = _paired(_spread(columns), 1e-6 * sizes[1])
    if any(after.right <= before.right or after.left <= before.left for before, after in pairwise(columns)):
        raise NoRowsError
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
    around = (side.spots[last + 1].place, side.spots[first - 1].place) if end - begin > ROUND * sizes[0] else None
    if middle.point < 0:
        side.put(int(np.searchsorted(side.ways, 0.5 * (begin + end), side="right")) - 1, middle, foot)
    return _Mark(middle.place, around, _bends(side, middle.place, sizes[1]))


def _bends(side: Side, place: FloatArray, spacing: float) -> bool:
    way = _way(side, place)
    ways = place - side.at(max(way - spacing, 0.0)).place, side.at(min(way + spacing, side.length)).place - place
    sizes = [float(np.linalg.norm(each)) for each in ways]
    return bool(ways[0] @ ways[1] < np.cos(_CORNER) * sizes[0] * sizes[1])


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


def _anchors(sides: tuple[Side, Side], marks: list[list[_Mark | None]], closed: bool) -> list[Column]:
    """The columns at the seam's vertices, and at the ends of ways around them, in their order."""
    last = Column(sides[RIGHT].length, sides[LEFT].length, (True, True))
    ordered = [Column(0.0, 0.0, (True, True))]
    for right, left in zip(*marks, strict=True):
        if right is None or left is None:
            continue
        ways = [_way(side, mark.spot) for side, mark in zip(sides, (right, left), strict=True)]
        shares = [way / side.length for way, side in zip(ways, sides, strict=True)]
        ahead = int(shares[LEFT] > shares[RIGHT]) if closed and abs(shares[RIGHT] - shares[LEFT]) > _AROUND else -1
        if ahead >= 0:  # before the begin of a closed strip
            ways[ahead] = 0.0
        at = Column(ways[RIGHT], ways[LEFT], (right.held and ahead != RIGHT, left.held and ahead != LEFT))
        for column in _around(sides, at, (right, left)):
            before = ordered[-1]
            ways = [min(max(column.ways[k], before.ways[k]), last.ways[k]) for k in (RIGHT, LEFT)]
            held = [column.held[k] and before.ways[k] < column.ways[k] < last.ways[k] for k in (RIGHT, LEFT)]
            if any(before.ways[k] < ways[k] < last.ways[k] for k in (RIGHT, LEFT)):
                ordered.append(Column(ways[0], ways[1], (held[0], held[1])))
    return [*ordered, last]


def _with_musts(sides: tuple[Side, Side], anchors: list[Column]) -> list[Column]:
    """The same, held where they happen to be at edges outside, and no other column holds these."""
    held = [[column.held[k] for column in anchors] for k in (RIGHT, LEFT)]
    for k, side in enumerate(sides):
        free = set(side.ways[side.must].tolist())
        free -= {column.ways[k] for column in anchors if column.held[k]}
        for at, column in enumerate(anchors):
            if column.ways[k] in free:
                free.discard(column.ways[k])
                held[k][at] = True
    return [Column(*column.ways, both) for column, both in zip(anchors, zip(*held, strict=True), strict=True)]


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
        low, high = before.ways[which], after.ways[which]
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
        ways = [(1 - pair[k]) * before.ways[k] + pair[k] * after.ways[k] for k in (RIGHT, LEFT)]
        found.append(Column(ways[0], ways[1], (held[0], held[1])))
        k += 1
    return found


def _thinned(columns: list[Column], least: float) -> list[Column]:
    """Without columns that nothing outside asks for and that are nearer than that to their neighbours."""
    kept: list[Column] = []
    for k, column in enumerate(columns):
        beside = [*kept[-1:], *(other for other in columns[k + 1 :][:1] if any(other.held))]
        near = any(abs(column.ways[k] - other.ways[k]) < least for other in beside for k in (RIGHT, LEFT))
        if any(column.held) or not near:
            kept.append(column)
    return kept


def _paired(columns: list[Column], least: float) -> list[Column]:
    """One column for two that follow each other, nearer than that, where each holds another side."""
    found: list[Column] = []
    for column in columns:
        before = found[-1] if found else column
        near = all(abs(column.ways[k] - before.ways[k]) < least for k in (RIGHT, LEFT))
        if near and sum(before.held) == sum(column.held) == 1 and before.held != column.held:
            first, second = (before, column) if before.held[RIGHT] else (column, before)
            found[-1] = Column(first.right, second.left, (True, True))
        else:
            found.append(column)
    return found


def _spread(columns: list[Column]) -> list[Column]:
    """Ways that nothing holds move where one side's are crowded."""
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
    return [Column(right, left, column.held) for (right, left), column in zip(ways.tolist(), columns, strict=True)]
