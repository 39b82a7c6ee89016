"""Where hard edges end at a loop, and which of them belong together."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain as chained
from itertools import combinations, product

import numpy as np

from fairing import _core
from fairing.options.arguments import places_of
from fairing.results import FloatArray, IntArray

_MOST = 5  # edges of a chain that tell its tangent: the circle through more follows no curve that turns otherwise
_TURN = 0.5  # cosine of the turn at which a chain ends in a corner
_ALONG = 0.966  # cos 15°: an edge of the loop that leaves a hard edge by less is its next one, seen from one side
Links = dict[int, list[int]]


def sides_of(loop: IntArray) -> IntArray:
    """(k, 2) the edges of a loop, from each vertex to the next."""
    return np.column_stack([loop, np.roll(loop, -1)])


def links_of(edges: IntArray) -> Links:
    """Which vertices edges (e, 2) join."""
    joined: Links = defaultdict(list)
    for a, b in np.unique(np.sort(edges, axis=1), axis=0).tolist():
        if a != b:
            joined[a].append(b)
            joined[b].append(a)
    return joined


def paths_between(nodes: set[int], links: Links) -> list[list[int]]:
    """The vertices of each path over links from a node to the next one."""
    found = []
    for node in sorted(nodes):
        for first in links[node]:
            path = [node, first]
            while path[-1] not in nodes:
                path.append(next(v for v in links[path[-1]] if v != path[-2]))
            if (path[0], path[1]) < (path[-1], path[-2]):
                found.append(path)
    return found


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


def chain_end(chain: Sequence[int], vertices: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The direction in which a chain of edges comes to its first vertex, and its curvature there."""
    direction, curvature = _core.chain_end(np.ascontiguousarray(vertices[chain[: _MOST + 1]]))
    return direction.ravel(), curvature.ravel()


def ends_at(
    loop: IntArray, vertices: FloatArray, triangles: IntArray, hard: IntArray, marked: IntArray
) -> tuple[list[EdgeEnd], list[range]]:
    """Follow hard edges to the loop, along it, and into the hole.

    Their ends in the order of the loop, one for each that leads into the hole; and runs along the loop to another one.
    Where several of them end at one vertex there is a corner, and no end. hard, marked: (h, 2) edges of the triangles,
    and some of these.
    """
    joined = links_of(hard[places_of(hard, sides_of(loop)) < 0])
    ends, runs = [], []
    for at, vertex in enumerate(loop.tolist()):
        if len(joined[vertex]) != 1:
            continue
        chain = chain_from(vertex, joined[vertex][0], joined, vertices)
        edge = np.array(chain[:2])
        last, run, chain = _along(loop, at, chain, vertices)
        where = int(loop[last])
        if last != at and joined[where]:
            runs.append(run)
            continue
        is_marked = bool(places_of(edge[None], marked)[0] >= 0)
        angle = _angle(edge[0], edge[1], vertices, triangles)
        ends.append(EdgeEnd(last, where, vertices[where], *chain_end(chain, vertices), angle, is_marked, run))
    return sorted(ends, key=lambda end: end.at), runs


def _along(loop: IntArray, at: int, chain: list[int], vertices: FloatArray) -> tuple[int, range, list[int]]:
    """Where a chain that has come to the loop leaves it, the edges of the loop on its path, and the longer chain."""
    count, here, step = len(loop), at, 0
    while abs(here - at) < count - 1:
        direction = chain_end(chain, vertices)[0]
        onward = [each for each in ([step] if step else [1, -1]) if _goes_on(loop, here, each, direction, vertices)]
        if not onward:
            break
        step = onward[0]
        here += step
        chain = [int(loop[here % count]), *chain]
    return here % count, range(at, here + step, step) if step else range(0), chain


def _goes_on(loop: IntArray, at: int, step: int, direction: FloatArray, vertices: FloatArray) -> bool:
    edge = vertices[loop[(at + step) % len(loop)]] - vertices[loop[at % len(loop)]]
    return bool(edge @ direction > _ALONG * np.linalg.norm(edge))


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
_MOST_ENDS = 8  # at one loop: 1430 pairings without crossings
_CLEARLY = 2.0  # so many times as much do the edges miss in any other pairing,
_UNSURE = 0.5  # and by so many degrees more at each end, or the ends are ambiguous
_MARK = 5.0  # degrees that it counts that one edge of a pair is marked and the other is not
_BEND = 0.25  # as much of the difference between their dihedral angles counts


@dataclass(frozen=True, eq=False)
class Joint:
    """Ends that are joined, by their places in the list; with the point where more than two meet."""

    ends: tuple[int, ...]
    centre: FloatArray | None = None


def matched(ends: Sequence[EdgeEnd]) -> tuple[list[Joint], dict[str, Sequence[int]]]:
    """Join the ends at one loop, in its order, so that as few as can be are left over and all miss least.

    And those that are left alone: "lonely" lead nowhere, "ambiguous" have two pairings that are as good.
    """
    everyone = tuple(range(len(ends)))
    if len(ends) > _MOST_ENDS:
        return [], {"too_many": everyone}
    blocks = _blocks(ends)
    pairings = sorted(
        ((sum(len(block) == 1 for block in each), sum(blocks[block][0] for block in each), each)
         for each in _pairings(everyone, blocks)),
        key=lambda found: found[:2],
    )  # fmt: skip
    single, miss, best = pairings[0]
    rivals = {
        block
        for other, missed, each in pairings[1:]
        if other == single and missed < _CLEARLY * miss + _UNSURE * len(ends)
        for block in each
    }
    unsure = set(chained.from_iterable(rivals - set(best)))
    unsure |= {end for block in best if unsure & set(block) for end in block}
    lonely = sorted({block[0] for block in best if len(block) == 1} - unsure)
    joints = [Joint(block, blocks[block][1]) for block in best if len(block) > 1 and not unsure & set(block)]
    return joints, {"lonely": lonely, "ambiguous": sorted(unsure)}


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


def _pairings(left: tuple[int, ...], blocks: Blocks) -> Iterator[tuple[tuple[int, ...], ...]]:
    """All that join them without crossings: what lies between two ends of a block stays among itself."""
    if not left:
        yield ()
        return
    for block in (block for block in blocks if block[0] == left[0] and set(block) <= set(left)):
        parts = [tuple(k for k in left if a < k < b) for a, b in zip(block, (*block[1:], left[-1] + 1), strict=True)]
        for rest in product(*(tuple(_pairings(part, blocks)) for part in parts)):
            yield (block, *chained.from_iterable(rest))


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
    """Degrees between the direction to a place and the straight line or the circle that the edge follows."""
    chord = place - end.place
    distance = float(np.linalg.norm(chord))
    if not distance > 0.0:
        return 180.0
    cosine = max(float(onward @ chord) / distance for onward in (end.direction, _on_circle(end, distance)))
    return float(np.degrees(np.arccos(min(max(cosine, -1.0), 1.0))))


def _on_circle(end: EdgeEnd, distance: float) -> FloatArray:
    """The unit chord of that length, or the diameter's."""
    bend = float(np.linalg.norm(end.curvature))
    if not bend > 0.0:
        return end.direction
    sine = min(0.5 * distance * bend, 1.0)
    return np.sqrt(1.0 - sine * sine) * end.direction + sine / bend * end.curvature


def meeting_point(places: Sequence[FloatArray], directions: Sequence[FloatArray]) -> FloatArray | None:
    """The point nearest to straight lines in least squares; None where they are parallel, or too few."""
    parallel = 1e-3  # the least eigenvalue of their mean projection across
    across = [np.eye(3) - np.outer(direction, direction) for direction in directions]
    matrix = np.sum([np.zeros((3, 3)), *across], axis=0)
    if not np.linalg.eigvalsh(matrix)[0] > parallel * len(places):
        return None
    right = np.sum([each @ place for each, place in zip(across, places, strict=True)], axis=0)
    return np.linalg.solve(matrix, right)
