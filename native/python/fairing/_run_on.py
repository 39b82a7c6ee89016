"""Hard edges that end at a hole run on through it: curves, and the loops that they cut."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from fairing import _arguments, _core, _cut_loops, _wires
from fairing._cut_loops import Tree, gap
from fairing._edge_ends import EdgeEnd, ends_at
from fairing._hard_edges import hard_edges
from fairing._loops import Outline, listed
from fairing._matching import Joint, Matching, matched
from fairing._types import Diagnostic, FloatArray, IntArray

EDGES = ("run_on", "ignored")


@dataclass(frozen=True, eq=False)
class _Wanted:
    """How long the edges of curves are to be."""

    length: float
    """0: ``factor`` times as long as the loop's edges at the curve's ends."""
    factor: float


@dataclass(frozen=True, eq=False)
class Curves:
    """What runs through the holes."""

    points: FloatArray
    """(n + c, 3) the caller's vertices, then new ones on the curves."""
    old_count: int
    """n."""
    cut: tuple[_cut_loops.CutOutline | None, ...]
    """Of each loop, None where nothing runs through it."""
    curves: tuple[IntArray, ...]
    """Vertices of each curve, from end to end."""
    rims: IntArray
    """Vertices of the loops where these run along hard edges."""
    marked: tuple[bool, ...]
    """Whether all hard edges that each curve continues were marked."""
    warnings: tuple[Diagnostic, ...]

    @property
    def holds_any(self) -> bool:
        """Whether a loop is to be filled along curves."""
        return any(cut is not None for cut in self.cut)

    @property
    def vertices(self) -> IntArray:
        """All that lie on curves and on hard edges of the loops, ascending."""
        found: IntArray = np.unique(np.concatenate([self.rims, *self.curves])).astype(np.int32)
        return found


@dataclass(frozen=True, eq=False)
class Edges:
    """What may run through holes: hard edges around them, those among these that were marked, and wires."""

    hard: IntArray
    marked: set[tuple[int, int]]
    wires: IntArray

    @classmethod
    def of(cls, mesh: tuple[FloatArray, IntArray], given: tuple[Any, Any, Any], bridge: bool) -> Edges:
        """mesh: vertices and triangles around; given: ``edges``, ``wires`` and ``marked`` of :func:`fairing.fill`."""
        points, around = mesh
        edges, wires, marked = given
        drawn, marks = (
            _arguments.indices_within(name, _arguments.integers(name, [] if value is None else value, 2), len(points))
            for name, value in (("wires", wires), ("marked", marked))
        )
        if _arguments.choice("edges", edges, EDGES) == "ignored" or bridge:
            return cls(_arguments.NO_EDGES, set(), _arguments.NO_EDGES)
        pairs = {(min(pair), max(pair)) for pair in marks.tolist()}
        return cls(hard_edges(points, around, marked=marks), pairs, drawn)

    def run_on(
        self, outline: Outline, normals: FloatArray, mesh: tuple[FloatArray, IntArray], spacing: tuple[float, bool]
    ) -> Curves:
        """The curves through loops with their normals (Σ k, 3). spacing: a length or 0, and whether it is the same
        everywhere."""
        points = mesh[0]
        rims = np.concatenate([np.roll(points[loop], -1, axis=0) - points[loop] for loop in outline.loops])
        mean = float(np.linalg.norm(rims, axis=1).mean())
        length, even = spacing
        wanted = _Wanted((length or mean) if even else 0.0, (length or mean) / mean)
        return _run_on(outline, normals, mesh, self, wanted)


class _Making:
    """Collects curves, and new vertices on them."""

    def __init__(self, vertices: FloatArray, wanted: _Wanted) -> None:
        self._vertices = vertices
        self._wanted = wanted
        self._added: list[FloatArray] = []
        self.curves: list[IntArray] = []
        self.marked: list[bool] = []

    @property
    def points(self) -> FloatArray:
        return np.concatenate([self._vertices, *self._added])

    def _new(self, places: FloatArray) -> IntArray:
        first = len(self._vertices) + sum(map(len, self._added))
        self._added.append(places)
        return np.arange(first, first + len(places), dtype=np.int32)

    def _curve(self, begin: EdgeEnd, end: tuple[FloatArray, FloatArray], lengths: tuple[float, float]) -> FloatArray:
        """Places of new vertices on the way from the end of an edge to a place with its direction, without both."""
        places, ways = np.array([begin.place, end[0]]), np.array([begin.direction, end[1]])
        dense = np.linspace(0.0, 1.0, 65)
        whole = _core.fair_curve(places, ways, dense.tolist())
        length = float(np.linalg.norm(np.diff(whole, axis=0), axis=1).sum())
        inner: FloatArray = _core.fair_curve(places, ways, _shares(length, lengths, self._wanted).tolist())
        return inner

    def joined(self, loop: IntArray, joint: Joint, ends: Sequence[EdgeEnd], lengths: FloatArray) -> Tree:
        """The curves of one joint; lengths: (k,) of the loop's edges at each vertex."""
        mine = [ends[k] for k in joint.ends]
        leaves = tuple(end.at for end in mine)
        is_marked = all(end.marked for end in mine)
        if joint.centre is None:
            a, b = mine
            inner = self._new(self._curve(a, (b.place, -b.direction), (lengths[a.at], lengths[b.at])))
            path = np.concatenate([loop[[a.at]], inner, loop[[b.at]]]).astype(np.int32)
            self._keep(path, is_marked)
            return Tree(leaves, (path, path[::-1].copy()))
        centre = self._new(joint.centre[None])
        mean = float(np.mean([lengths[end.at] for end in mine]))
        arms = []
        for end in mine:
            inner = self._new(self._curve(end, (joint.centre, np.zeros(3)), (lengths[end.at], mean)))
            arms.append(np.concatenate([loop[[end.at]], inner, centre]).astype(np.int32))
            self._keep(arms[-1], end.marked)
        return Tree(
            leaves, tuple(np.concatenate([a, b[-2::-1]]) for a, b in zip(arms, arms[1:] + arms[:1], strict=True))
        )

    def drawn(self, found: _wires.Drawn, marked: set[int]) -> None:
        """Curves that are there as wires; marked: where marked hard edges come to the loop."""
        for curve in found.curves:
            ends = {int(curve[0]), int(curve[-1])} & found.reached
            self._keep(curve, ends <= marked)

    def _keep(self, curve: IntArray, is_marked: bool) -> None:
        self.curves.append(curve)
        self.marked.append(is_marked)


def _shares(length: float, ends: tuple[float, float], wanted: _Wanted) -> FloatArray:
    """Shares of a curve's length at which its inner vertices lie: edges as long as at the ends, and as wanted between.

    As for all new edges lengths grow or shrink by half of the distance on the way there.
    """
    along = np.linspace(0.0, length, 1025)
    here = ends[0] + (ends[1] - ends[0]) * along / length
    goal = np.full_like(along, wanted.length) if wanted.length else wanted.factor * here
    away = 0.5 * np.minimum(along, length - along)
    edges = np.clip(goal, here - away, here + away)
    edges = np.maximum(edges, 1e-3 * min(ends))
    count = np.concatenate([[0.0], np.cumsum(0.5 * (1.0 / edges[1:] + 1.0 / edges[:-1]) * np.diff(along))])
    whole = max(1, round(float(count[-1])))
    result: FloatArray = np.interp(np.arange(1, whole) / whole * count[-1], count, along) / length
    return result


def _run_on(
    outline: Outline,
    normals: FloatArray,
    mesh: tuple[FloatArray, IntArray],
    edges: Edges,
    wanted: _Wanted,
) -> Curves:
    vertices, triangles = mesh
    making = _Making(vertices, wanted)
    warnings: list[Diagnostic] = []
    found = []
    for loop, rows in zip(outline.loops, outline.split(normals), strict=True):
        drawn = _wires.drawn(loop, edges.wires)
        there = ends_at(loop, vertices, triangles, edges.hard, edges.marked)
        ends = [end for end in there.ends if end.vertex not in drawn.reached]
        lengths = _lengths_at(vertices[loop])
        trees = list(drawn.trees)
        for group in _apart(ends, drawn.trees):
            matching = matched(group)
            warnings += _warnings(group, matching)
            trees += [making.joined(loop, joint, group, lengths) for joint in matching.joints]
        making.drawn(drawn, {end.vertex for end in there.ends if end.marked})
        found.append(_Through(loop, rows, trees, there.along))
    points = making.points
    return Curves(
        points,
        len(vertices),
        tuple(each.cut(points, triangles) for each in found),
        tuple(making.curves),
        np.concatenate([np.empty(0, np.int32), *(each.rim for each in found)]),
        tuple(making.marked),
        tuple(warnings),
    )


@dataclass(frozen=True, eq=False)
class _Through:
    """What runs through one loop, and along it."""

    loop: IntArray
    normals: FloatArray
    trees: list[Tree]
    along: list[range]

    @property
    def rim(self) -> IntArray:
        """The loop's vertices on hard edges along it."""
        return self.loop[sorted({place % len(self.loop) for run in self.along for place in run})]

    def cut(self, points: FloatArray, triangles: IntArray) -> _cut_loops.CutOutline | None:
        """The loop in parts; None where nothing runs through it or along it."""
        if not self.trees and not self.along:
            return None
        sides = _cut_loops.outside_normals(self.loop, points, triangles)
        missing = ~sides.any(axis=1)
        sides[missing] = self.normals[missing]
        normals = self.normals.copy()
        for run in self.along:
            _take_other_side(run, sides, normals)
        return _cut_loops.cut(self.loop, normals, sides, self.trees, points)


def _take_other_side(run: range, sides: FloatArray, normals: FloatArray) -> None:
    """The faces at a hard edge along the loop lie beyond it: normals there are those next to where the edge comes."""
    count = len(sides)
    before = run[0] - 1 if run.step > 0 else run[0]
    for place, after in pairwise(run):
        sides[min(place, after) % count] = sides[before % count]
    normals[np.array(run) % count] = sides[before % count]


def _lengths_at(points: FloatArray) -> FloatArray:
    """(k,) the mean length of the two edges at each vertex of a loop."""
    edges = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    mean: FloatArray = 0.5 * (edges + np.roll(edges, 1))
    return mean


def _apart(ends: Sequence[EdgeEnd], trees: Sequence[Tree]) -> list[list[EdgeEnd]]:
    """Ends between which no tree lies."""
    groups: dict[tuple[int, ...], list[EdgeEnd]] = {}
    for end in ends:
        groups.setdefault(tuple(gap(tree, end.at) for tree in trees), []).append(end)
    return list(groups.values())


def _warnings(ends: Sequence[EdgeEnd], matching: Matching) -> list[Diagnostic]:
    """Name the ends that are left alone."""
    cases = (
        (matching.lonely, "lonely", "no other one goes on from there"),
        (matching.ambiguous, "ambiguous", "they may be joined in several ways"),
        (matching.too_many, "too_many", "they are too many to be joined"),
    )
    found = []
    for which, figure, why in cases:
        if which:
            where = np.sort(np.array([ends[k].vertex for k in which], dtype=np.int32))
            what = "1 hard edge ends" if len(where) == 1 else f"{len(where)} hard edges end"
            text = f"{what} at a hole, at {listed(where)}: {why}"
            figures = {"ends": float(len(where)), figure: 1.0}
            found.append(Diagnostic("EDGES_LEFT_ALONE", text, where, "vertex", figures))
    return found
