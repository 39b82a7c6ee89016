"""Where hard edges end at a loop, and which of them belong together."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fairing import _core
from fairing.results import FloatArray, IntArray

_MOST = 5  # edges of a chain that tell its tangent: the circle through more follows no curve that turns otherwise
_TURN = 0.5  # cosine of the turn at which a chain ends in a corner
_ALONG = 0.966  # cos 15°: an edge of the loop that leaves a hard edge by less is its next one, seen from one side


@dataclass(frozen=True, eq=False)
class EdgeEnd:
    """The end of a hard edge at a loop."""

    at: int
    """Its place in the loop."""
    vertex: int
    place: FloatArray
    direction: FloatArray
    """(3,) unit, into the hole."""
    curvature: FloatArray
    """(3,) of the circle that it follows, to the centre, length⁻¹."""
    angle: float
    """Degrees between the faces beside it, convex above 0."""
    marked: bool
    run: range = range(0)
    """Places in the loop from where the edge comes to it to where it leaves it, along it; not wrapped around."""


@dataclass(frozen=True, eq=False)
class EndsAt:
    """What hard edges do at one loop."""

    ends: list[EdgeEnd]
    """In the order of the loop, one for each hard edge that leads into the hole."""
    along: list[range]
    """Such runs of hard edges that meet another one without having left the loop."""


def ends_at(
    loop: IntArray, vertices: FloatArray, triangles: IntArray, hard: IntArray, marked: set[tuple[int, int]]
) -> EndsAt:
    """Follow hard edges to the loop, along it, and into the hole.

    Where several of them end at one vertex there is a corner, and no end. hard: (h, 2) edges of the triangles; marked:
    the pairs that were marked, the smaller index first.
    """
    joined = _inner_links(loop, hard)
    ends, runs = [], []
    for at, vertex in enumerate(loop.tolist()):
        if len(joined[vertex]) != 1:
            continue
        chain = chain_from(vertex, joined[vertex][0], joined, vertices)
        angle = _angle(chain[0], chain[1], vertices, triangles)
        is_marked = _pair(chain[0], chain[1]) in marked
        last, run, chain = _along(loop, at, chain, vertices)
        if last == at:
            run = range(0)
        elif joined[int(loop[last])]:
            runs.append(run)
            continue
        direction, curvature = _core.chain_end(np.ascontiguousarray(vertices[chain]))
        where = int(loop[last])
        ends.append(EdgeEnd(last, where, vertices[where], direction.ravel(), curvature.ravel(), angle, is_marked, run))
    return EndsAt(sorted(ends, key=lambda end: end.at), runs)


def _inner_links(loop: IntArray, hard: IntArray) -> dict[int, list[int]]:
    """Which vertices hard edges join, without the loop's own."""
    own = {_pair(a, b) for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)}
    joined = defaultdict(list)
    for a, b in hard.tolist():
        if _pair(a, b) not in own:
            joined[a].append(b)
            joined[b].append(a)
    return joined


def _along(loop: IntArray, at: int, chain: list[int], vertices: FloatArray) -> tuple[int, range, list[int]]:
    """Where a chain that has come to the loop leaves it, the edges of the loop on the way, and the longer chain."""
    count, here, step = len(loop), at, 0
    while abs(here - at) < count - 1:
        direction, _ = _core.chain_end(np.ascontiguousarray(vertices[chain[: _MOST + 1]]))
        ways = [step] if step else [1, -1]
        onward = [way for way in ways if _goes_on(loop, here, way, direction.ravel(), vertices)]
        if not onward:
            break
        step = onward[0]
        here += step
        chain = [int(loop[here % count]), *chain]
    return here % count, range(at, here + step, step or 1), chain[: _MOST + 1]


def _goes_on(loop: IntArray, at: int, way: int, direction: FloatArray, vertices: FloatArray) -> bool:
    edge = vertices[loop[(at + way) % len(loop)]] - vertices[loop[at % len(loop)]]
    return bool(edge @ direction > _ALONG * np.linalg.norm(edge))


def _pair(a: int, b: int) -> tuple[int, int]:
    return (a, b) if a < b else (b, a)


def chain_from(first: int, second: int, joined: Mapping[int, list[int]], vertices: FloatArray) -> list[int]:
    """The vertices of a hard edge from its end on, as far as it goes on without a corner."""
    chain = [first, second]
    while len(chain) <= _MOST:
        onward = [v for v in joined[chain[-1]] if v != chain[-2]]
        if len(onward) != 1 or onward[0] in chain:
            break
        before, after = vertices[chain[-1]] - vertices[chain[-2]], vertices[onward[0]] - vertices[chain[-1]]
        if before @ after < _TURN * np.linalg.norm(before) * np.linalg.norm(after):
            break
        chain.append(onward[0])
    return chain


def _angle(a: int, b: int, vertices: FloatArray, triangles: IntArray) -> float:
    """Degrees between the two triangles at the edge, convex above 0; 0 where there are not two."""
    both = triangles[(triangles == a).any(axis=1) & (triangles == b).any(axis=1)]
    if len(both) != 2:
        return 0.0
    corners = vertices[both]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sizes = np.linalg.norm(normals, axis=1)
    if not (sizes > 0.0).all():
        return 0.0
    normals /= sizes[:, None]
    across = vertices[both[1].sum() - a - b] - vertices[a]
    size = np.degrees(np.arccos(np.clip(normals[0] @ normals[1], -1.0, 1.0)))
    return float(-size if across @ normals[0] > 0.0 else size)


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
