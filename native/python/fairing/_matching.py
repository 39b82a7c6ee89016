"""Which ends of hard edges around a hole belong together: pairs that run on, and more that meet in a point."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fairing._edge_ends import EdgeEnd
from fairing._types import FloatArray

_LARGEST = 40.0  # degrees by which an edge may miss where it goes: two edges at a right angle miss each other by 45
_MOST_ENDS = 8  # at one loop: 1430 ways to join them without crossings
_CLEARLY = 2.0  # so many times as much do the edges miss in any other way,
_UNSURE = 0.5  # and by so many degrees more at each end, or the ends are ambiguous
_MARK = 5.0  # degrees that it counts that one edge of a pair is marked and the other is not
_BEND = 0.25  # as much of the difference between their dihedral angles counts


@dataclass(frozen=True, eq=False)
class Joint:
    """Ends that are joined, by their places in the list; with the point where more than two meet."""

    ends: tuple[int, ...]
    centre: FloatArray | None = None


@dataclass(frozen=True, eq=False)
class Matching:
    """Ends that run on, and those that are left alone."""

    joints: tuple[Joint, ...]
    lonely: tuple[int, ...] = ()
    """They lead nowhere."""
    ambiguous: tuple[int, ...] = ()
    """They may be joined in two ways that are as good."""
    too_many: tuple[int, ...] = ()


def matched(ends: Sequence[EdgeEnd]) -> Matching:
    """Join the ends at one loop, in its order, so that as few as can be are left over and all miss least."""
    everyone = tuple(range(len(ends)))
    if len(ends) > _MOST_ENDS:
        return Matching((), too_many=everyone)
    blocks = _blocks(ends)
    ways = sorted(
        ((sum(len(block) == 1 for block in way), sum(blocks[block][0] for block in way), way)
         for way in _ways(everyone, blocks)),
        key=lambda found: found[:2],
    )  # fmt: skip
    single, miss, best = ways[0]
    rivals = {
        block
        for other, missed, way in ways[1:]
        if other == single and missed < _CLEARLY * miss + _UNSURE * len(ends)
        for block in way
    }
    unsure = {end for block in rivals - set(best) for end in block if rivals}
    unsure |= {end for block in best if unsure & set(block) for end in block}
    return Matching(
        tuple(Joint(block, blocks[block][1]) for block in best if len(block) > 1 and not unsure & set(block)),
        lonely=tuple(sorted({block[0] for block in best if len(block) == 1} - unsure)),
        ambiguous=tuple(sorted(unsure)),
    )


Blocks = dict[tuple[int, ...], tuple[float, "FloatArray | None"]]


def _blocks(ends: Sequence[EdgeEnd]) -> Blocks:
    """What each set of ends that may be joined misses, in degrees added up, and where more than two meet."""
    result: Blocks = {(k,): (0.0, None) for k in range(len(ends))}
    for i, j in combinations(range(len(ends)), 2):
        miss = _pair_miss(ends[i], ends[j])
        if miss is not None:
            result[i, j] = (miss, None)
    reach = max((float(np.linalg.norm(a.place - b.place)) for a, b in combinations(ends, 2)), default=0.0)
    for size in range(3, len(ends) + 1):
        for block in combinations(range(len(ends)), size):
            mine = [ends[k] for k in block]
            centre = meeting_point([end.place for end in mine], [end.direction for end in mine])
            if centre is None or max(float(np.linalg.norm(centre - ends[k].place)) for k in block) > reach:
                continue
            misses = [_miss(ends[k], centre) for k in block]
            if max(misses) <= _LARGEST:
                result[block] = (sum(misses), centre)
    return result


def _ways(left: tuple[int, ...], blocks: Blocks) -> Iterator[tuple[tuple[int, ...], ...]]:
    """All ways to join them, none crossing: what lies between two ends of a block stays among itself."""
    if not left:
        yield ()
        return
    for block in (block for block in blocks if block[0] == left[0] and set(block) <= set(left)):
        parts = [tuple(k for k in left if a < k < b) for a, b in zip(block, (*block[1:], left[-1] + 1), strict=True)]
        yield from ((block, *rest) for rest in _together(parts, blocks))


def _together(parts: list[tuple[int, ...]], blocks: Blocks) -> Iterator[tuple[tuple[int, ...], ...]]:
    if not parts:
        yield ()
        return
    for first in _ways(parts[0], blocks):
        yield from ((*first, *rest) for rest in _together(parts[1:], blocks))


def _pair_miss(a: EdgeEnd, b: EdgeEnd) -> float | None:
    """Degrees, or None where the two are no edge that runs on."""
    chord = b.place - a.place
    if a.angle * b.angle < 0.0 or min(a.direction @ chord, -b.direction @ chord) <= 0.0:
        return None
    misses = _miss(a, b.place), _miss(b, a.place)
    if max(misses) > _LARGEST:
        return None
    return sum(misses) + _BEND * abs(a.angle - b.angle) + _MARK * (a.marked != b.marked)


def _miss(end: EdgeEnd, place: FloatArray) -> float:
    """Degrees between the way to a place and the way there on the straight line or the circle that the edge follows."""
    way = place - end.place
    distance = float(np.linalg.norm(way))
    if not distance > 0.0:
        return 180.0
    cosine = max(float(onward @ way) / distance for onward in (end.direction, _on_circle(end, distance)))
    return float(np.degrees(np.arccos(min(max(cosine, -1.0), 1.0))))


def _on_circle(end: EdgeEnd, distance: float) -> FloatArray:
    """The unit chord of that length, or the diameter's."""
    bend = float(np.linalg.norm(end.curvature))
    if not bend > 0.0:
        return end.direction
    sine = min(0.5 * distance * bend, 1.0)
    chord: FloatArray = np.sqrt(1.0 - sine * sine) * end.direction + sine / bend * end.curvature
    return chord


def meeting_point(places: Sequence[FloatArray], directions: Sequence[FloatArray]) -> FloatArray | None:
    """The point nearest to straight lines in least squares; None where they are parallel, or too few."""
    parallel = 1e-3  # the least eigenvalue of their mean projection across
    across = [np.eye(3) - np.outer(direction, direction) for direction in directions]
    matrix = np.sum([np.zeros((3, 3)), *across], axis=0)
    if not np.linalg.eigvalsh(matrix)[0] > parallel * len(places):
        return None
    right = np.sum([each @ place for each, place in zip(across, places, strict=True)], axis=0)
    point: FloatArray = np.linalg.solve(matrix, right)
    return point
