"""Where hard edges of the surroundings end at a loop, and how they would run on."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fairing import _core
from fairing._types import FloatArray, IntArray

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
