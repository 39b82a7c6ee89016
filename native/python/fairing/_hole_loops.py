"""The loops around holes, also where borders touch each other or themselves (pinches).

Around a vertex, fans of triangles and open sectors take turns. A loop goes through a sector: it comes from the fan at
one end of the sector and leaves along the fan at the other end. Surfaces over such loops close every sector, so that
the mesh is a manifold there. (Loops that follow the fans instead, as :func:`fairing.boundary_loops` do, would leave two
umbrellas that touch in a point.)
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing._types import FloatArray, IntArray

Edge = tuple[int, int]


@dataclass(frozen=True, eq=False)
class HoleLoops:
    """All borders of a mesh."""

    loops: tuple[IntArray, ...]
    """Closed, each with the hole on its left, starting at its smallest vertex; ordered by that vertex."""
    torn: tuple[IntArray, ...]
    """Chains of border vertices that close to no loop: triangles are wound against each other at one of their ends."""


def hole_loops(vertices: npt.ArrayLike, triangles: npt.ArrayLike, border: npt.ArrayLike | None = None) -> HoleLoops:
    """The loops that :func:`fairing.fill` fills by default, and what is no loop.

    Edges with one triangle make loops, whatever the rest of the mesh is like. Where a border touches itself or another
    one in a vertex, loops are parted so that surfaces over all of them leave a manifold: two holes that meet in a
    corner are two loops; a face that hangs into a hole by a corner makes the loop pass that vertex twice.

    ``border``: (e, 2) the edges with one triangle, where they are known, each in the direction that has the hole on its
    left. Then of the triangles those at pinches are enough.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    if border is None:
        return _loops_along(_border(faces, len(points)), points, faces)
    edges = _arguments.indices_within("border", _arguments.integers("border", border, 2), len(points))
    return _loops_along(edges, points, faces)


def recut(loops: Sequence[IntArray], points: FloatArray, triangles: IntArray) -> list[tuple[int, IntArray]]:
    """Loops along the border, with the hole on their left, parted as around holes where they touch.

    Each with the number of the one in which it begins. A vertex some of whose sectors belong to no loop named stays as
    it is.
    """
    edges = np.concatenate([np.column_stack([loop, np.roll(loop, -1)]) for loop in loops])
    of = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
    first = np.cumsum([0, *map(len, loops)])
    after = {int(k): int(k) + 1 for k in range(len(edges))} | {int(e) - 1: int(b) for b, e in pairwise(first)}
    found = _loops_along(edges, points, triangles, after)
    number = {tuple(edge): k for k, edge in enumerate(edges.tolist())}
    begins = [
        min(number[a, b] for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))
        for loop in found.loops
    ]
    order = np.argsort(begins)
    return [
        (int(of[begins[k]]), np.roll(loop, -loop.tolist().index(int(edges[begins[k], 0]))))
        for k, loop in ((k, found.loops[k]) for k in order.tolist())
    ]


def _border(triangles: IntArray, count: int) -> IntArray:
    """(e, 2) border edges in the direction that has the hole on its left."""
    tails, heads = np.roll(triangles, -1, axis=1).ravel(), triangles.ravel()
    key = np.minimum(tails, heads).astype(np.int64) * count + np.maximum(tails, heads)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    new = np.concatenate([[True], ordered[1:] != ordered[:-1], [True]]) if len(key) else np.ones(1, dtype=bool)
    once = np.sort(order[new[1:] & new[:-1]])
    edges: IntArray = np.column_stack([tails[once], heads[once]])
    return edges


def _loops_along(
    edges: IntArray, points: FloatArray, triangles: IntArray, otherwise: dict[int, int] | None = None
) -> HoleLoops:
    """otherwise: the edge after each, where its end has other sectors."""
    ends = edges.tolist()
    coming: dict[int, list[int]] = {}
    leaving: dict[int, list[int]] = {}
    for number, (tail, head) in enumerate(ends):
        leaving.setdefault(tail, []).append(number)
        coming.setdefault(head, []).append(number)
    following = dict(otherwise or {})
    following |= {coming[v][0]: out[0] for v, out in leaving.items() if len(out) == 1 == len(coming.get(v, ()))}
    several = [v for v, out in leaving.items() if len(out) > 1 and len(coming.get(v, ())) == len(out)]
    numbers = {(tail, head): number for number, (tail, head) in enumerate(ends)}
    for vertex, pairs in _sectors(np.array(sorted(several), dtype=np.int64), points, triangles):
        passes = [(numbers.get((tail, vertex)), numbers.get((vertex, head))) for tail, head in pairs]
        known = [(one, other) for one, other in passes if one is not None and other is not None]
        if len(known) == len(passes) == len(leaving[vertex]):
            following.update(known)
    return _walked(ends, following)


def _walked(ends: list[list[int]], following: dict[int, int]) -> HoleLoops:
    loops: list[list[int]] = []
    torn: list[list[int]] = []
    seen = [False] * len(ends)
    firsts = sorted(set(range(len(ends))) - set(following.values()))
    for closed, starts in ((False, firsts), (True, range(len(ends)))):
        for start in starts:
            if seen[start]:
                continue
            chain = [ends[start][0]]
            edge: int | None = start
            while edge is not None and not seen[edge]:
                seen[edge] = True
                chain.append(ends[edge][1])
                edge = following.get(edge)
            (loops if closed else torn).append(chain[:-1] if closed else chain)
    begun = sorted((_from_smallest(loop) for loop in loops), key=lambda loop: loop.tolist())
    return HoleLoops(tuple(begun), tuple(np.array(chain, dtype=np.int32) for chain in torn))


def _from_smallest(loop: list[int]) -> IntArray:
    at = loop.index(min(loop))
    return np.array(loop[at:] + loop[:at], dtype=np.int32)


def _sectors(
    vertices: npt.NDArray[np.int64], points: FloatArray, triangles: IntArray
) -> Iterator[tuple[int, list[Edge]]]:
    """Each vertex with the open sectors around it: where the loop through each comes from, and where it goes."""
    if not len(vertices):
        return
    near = triangles[np.isin(triangles, vertices).any(axis=1)]
    rows, corners = np.nonzero(np.isin(near, vertices))
    star: dict[int, list[Edge]] = {}
    for row, corner in zip(rows.tolist(), corners.tolist(), strict=True):
        spokes = int(near[row, (corner + 1) % 3]), int(near[row, (corner + 2) % 3])
        star.setdefault(int(near[row, corner]), []).append(spokes)
    for vertex in vertices.tolist():
        fans = _in_order(vertex, _fans(star[vertex]), points, star[vertex])
        before = [fans[-1], *fans[:-1]]
        # Counter-clockwise a sector begins at the last spoke of a fan, along which its loop leaves.
        yield vertex, [(first, last) for (first, _), (_, last) in zip(fans, before, strict=True)]


def _fans(spokes: list[Edge]) -> list[Edge]:
    """The first and the last spoke of each open fan, counter-clockwise; spokes: those of each triangle."""
    after = dict(spokes)
    if len(after) < len(spokes) or len(set(after.values())) < len(spokes):
        return [(-1, -1)]  # two triangles on one side of an edge
    fans = []
    for first in sorted(set(after) - set(after.values())):
        last = first
        while last in after:
            last = after[last]
        fans.append((first, last))
    return fans or [(-1, -1)]


def _in_order(vertex: int, fans: list[Edge], points: FloatArray, spokes: list[Edge]) -> list[Edge]:
    """The fans counter-clockwise around the vertex. Of two fans each follows on the other."""
    if len(fans) < 3:
        return fans
    arms = points[np.array(spokes)] - points[vertex]
    normal = np.cross(arms[:, 0], arms[:, 1]).sum(axis=0)
    axis = np.eye(3)[int(np.abs(normal).argmin())]
    first = np.cross(axis, normal)
    second = np.cross(normal, first)
    away = points[[fan[0] for fan in fans]] - points[vertex]
    size = max(float(np.linalg.norm(normal)), 1e-300)
    order = np.argsort(np.arctan2(away @ second / size, away @ first))
    return [fans[k] for k in order.tolist()]
