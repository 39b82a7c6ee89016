"""Hard edges of the surroundings that run on through a patch, along edges of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._edge_ends import ends_at
from fairing._hard_edges import hard_edges
from fairing._matching import matched
from fairing._measure import boundary_loops, edges_with_uses
from fairing._new_mesh import read_only
from fairing._types import FloatArray, IntArray

_COMPARED = 4  # rings inside with which hard edges at the boundary are compared, before all are


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
    found = _arguments.NO_EDGES
    near = _near(own, _border(own))
    onward, _ = _hard(points, (near, around), _inner(near), marks)  # edges at the far side of `near` have one face
    loops = boundary_loops(own) if len(onward) else []
    if _joined(points, around, loops, onward, marks):
        inner = _inner(own)
        onward, within = _hard(points, (own, around), inner, marks)
        usable = _counted(inner, neighbours, len(points))
        found = _core.hard_ways(points, usable, within, _joined(points, around, loops, onward, marks))
    return EdgesThrough(read_only(found), read_only(onward))


def _hard(
    points: FloatArray, sides: tuple[IntArray, IntArray], inner: IntArray, marks: IntArray
) -> tuple[IntArray, IntArray]:
    """Hard edges outside and along the boundary of both sides, and those among the `inner` ones."""
    hard = hard_edges(points, np.concatenate(sides), marked=marks)
    is_inner = _arguments.places_of(hard, inner) >= 0
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
    named = _arguments.vertices_of("neighbours", neighbours, count, 2)
    counted: IntArray = inner[_arguments.places_of(inner, named) >= 0]
    return counted
