"""Hard edges of the surroundings that run on through a patch, along edges of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from heapq import heappop, heappush

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _seams
from fairing._edge_ends import ends_at
from fairing._hard_edges import hard_edges
from fairing._matching import matched
from fairing._measure import boundary_loops, edges_with_uses
from fairing._new_mesh import read_only
from fairing._types import FloatArray, IntArray

_LEAST = 0.75  # of the way through a patch is hard: less is no edge of it
_COMPARED = 4  # rings inside with which hard edges at the boundary are compared, before all are
_HARD = 1e-3  # as much of a hard edge's length counts as a step's: the way leaves these where it must


@dataclass(frozen=True, eq=False)
class EdgesThrough:
    """What :func:`fairing.fair_edges` makes fair. All arrays are read-only."""

    edges: IntArray
    """(e, 2) edges of the patch, the smaller index first, ascending."""
    onward: IntArray
    """(o, 2) hard edges outside and along its boundary."""


def edges_through(
    vertices: npt.ArrayLike,
    inside: npt.ArrayLike,
    outside: npt.ArrayLike,
    *,
    neighbours: npt.ArrayLike | None = None,
    marked: npt.ArrayLike | None = None,
) -> EdgesThrough:
    """Find the edges of a patch along which hard edges (:func:`fairing.hard_edges`) of its surroundings run on.

    Hard edges outside that end at the boundary are matched as :func:`fairing.fill` does at a hole, and joined by the
    way over edges of the patch that is hard as far as can be. Where three quarters of it are hard, or more, the patch
    has that edge, maybe dented; elsewhere it has none.

    vertices: (n, 3); inside, outside: (m, 3) and (o, 3) triangles of the patch and around it; neighbours: (e, 2) those
    edges of the patch's triangles that count, of quads and polygons, by default all; marked: (k, 2) edges that are hard
    whatever they bend.
    """
    points = _arguments.floats("vertices", vertices)
    own, around = (_arguments.triangles_within(triangles, len(points)) for triangles in (inside, outside))
    marks = _arguments.integers("marked", [] if marked is None else marked, 2)
    found: set[tuple[int, int]] = set()
    near = _near(own, _border(own))
    onward, _ = _hard(points, (near, around), _inner(near), marks)  # edges at the far side of `near` have one face
    loops = boundary_loops(own) if len(onward) else []
    if _joined(points, around, loops, onward, marks):
        inner = _inner(own)
        onward, within = _hard(points, (own, around), inner, marks)
        graph = _Graph.of(points, _counted(inner, neighbours, len(points)), within)
        found = {edge for at in _joined(points, around, loops, onward, marks) for edge in graph.way(at)}
    result = np.array(sorted(found), dtype=np.int32).reshape(-1, 2)
    return EdgesThrough(read_only(result), read_only(onward))


def _hard(
    points: FloatArray, sides: tuple[IntArray, IntArray], inner: IntArray, marks: IntArray
) -> tuple[IntArray, IntArray]:
    """Hard edges outside and along the boundary of both sides, and those among the `inner` ones."""
    hard = hard_edges(points, np.concatenate(sides), marked=marks)
    is_inner = _among(hard, inner)
    return hard[~is_inner], hard[is_inner]


def _joined(
    points: FloatArray, around: IntArray, loops: Sequence[IntArray], hard: IntArray, marks: IntArray
) -> list[list[int]]:
    """The vertices of the loops at which hard edges end that belong together."""
    pairs = {(min(a, b), max(a, b)) for a, b in marks.tolist()}
    joined = []
    for loop in loops:
        ends = ends_at(loop, points, around, hard, pairs).ends
        joined += [[ends[k].vertex for k in joint.ends] for joint in matched(ends).joints]
    return joined


def _inner(triangles: IntArray) -> IntArray:
    """Edges with a triangle on both sides."""
    edges, uses = edges_with_uses(triangles)
    inner: IntArray = edges[uses == 2]
    return inner


def _border(triangles: IntArray) -> IntArray:
    """Vertices that no closed fan of triangles is around: going around one, each neighbour is reached and left once.

    Sums of what is reached less what is left tell them apart without a sort of all edges.
    """
    faces = triangles.astype(np.float64)
    after, before = np.roll(faces, -1, axis=1).ravel(), np.roll(faces, 1, axis=1).ravel()
    vertices, open_fan = triangles.ravel(), False
    for weight in (after - before, after**2 - before**2):
        open_fan = open_fan | (np.bincount(vertices, weight) != 0.0)
    border: IntArray = np.flatnonzero(open_fan)
    return border


def _near(triangles: IntArray, border: IntArray) -> IntArray:
    """Those that hard edges at the border's vertices are compared with."""
    reached = np.zeros(int(triangles.max(initial=-1)) + 1, dtype=bool)
    near = np.zeros(len(triangles), dtype=bool)
    reached[border] = True
    for _ in range(_COMPARED):
        near = reached[triangles].any(axis=1)
        reached[triangles[near]] = True
    found: IntArray = triangles[near]
    return found


def _counted(inner: IntArray, neighbours: npt.ArrayLike | None, count: int) -> IntArray:
    """Those of the inner edges that count."""
    if neighbours is None:
        return inner
    named = _arguments.indices_within("neighbours", _arguments.integers("neighbours", neighbours, 2), count)
    counted: IntArray = inner[_among(inner, named)]
    return counted


def _among(pairs: IntArray, others: IntArray) -> npt.NDArray[np.bool_]:
    """(k,) which of the pairs (k, 2) are among others."""
    among: npt.NDArray[np.bool_] = np.isin(_seams.keys_of(pairs), _seams.keys_of(others))
    return among


@dataclass(frozen=True, eq=False)
class _Graph:
    """Edges of a patch, each in both directions, those from one vertex together."""

    begin: list[int]
    heads: list[int]
    lengths: list[float]
    soft: list[float]
    """As much of each is not hard."""
    most: float
    """Longer than that no soft part of a way may be."""
    total: float
    """The sum of the lengths."""

    @classmethod
    def of(cls, points: FloatArray, edges: IntArray, hard: IntArray) -> _Graph:
        both = np.concatenate([edges, edges[:, ::-1]])
        both = both[np.argsort(both[:, 0], kind="stable")]
        lengths = np.linalg.norm(points[both[:, 0]] - points[both[:, 1]], axis=1)
        soft = lengths * ~_among(both, hard)
        begin = np.searchsorted(both[:, 0], np.arange(len(points) + 1))
        most = (1.0 / _LEAST - 1.0) * 0.5 * float((lengths - soft).sum())
        return cls(begin.tolist(), both[:, 1].tolist(), lengths.tolist(), soft.tolist(), most, float(lengths.sum()))

    def way(self, ends: list[int]) -> set[tuple[int, int]]:
        """The edges of the ways from each end to the place where all of them meet; none where they are soft."""
        targets = [ends[1]] if len(ends) == 2 else []
        trees = [self._tree(end, targets) for end in (ends[:1] if targets else ends)]
        reached = set(targets or trees[0]).intersection(*trees)
        if not reached:
            return set()
        meeting = min(reached, key=lambda vertex: (sum(tree[vertex][0] for tree in trees), vertex))
        found, length, soft = set(), 0.0, 0.0
        for tree in trees:
            vertex = meeting
            while tree[vertex][1] >= 0:
                step, before = tree[vertex][2], tree[vertex][1]
                found.add((min(vertex, before), max(vertex, before)))
                length += self.lengths[step]
                soft += self.soft[step]
                vertex = before
        return found if soft <= (1.0 - _LEAST) * length else set()

    def _tree(self, start: int, targets: list[int]) -> dict[int, tuple[float, int, int]]:
        """Of each vertex within reach: how far it is, which one comes before (−1: none), and the step from there."""
        done: dict[int, tuple[float, int, int]] = {}
        waiting = [(0.0, start, -1, -1)]
        farthest = (1.0 + _HARD) * self.most + _HARD * self.total
        while waiting:
            far, vertex, before, by = heappop(waiting)
            if vertex in done or far > farthest:
                continue
            done[vertex] = (far, before, by)
            if vertex in targets:
                break
            for step in range(self.begin[vertex], self.begin[vertex + 1]):
                if self.heads[step] not in done:
                    onward = far + self.soft[step] + _HARD * self.lengths[step]
                    heappush(waiting, (onward, self.heads[step], vertex, step))
        return done
