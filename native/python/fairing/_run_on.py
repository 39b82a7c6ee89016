"""Hard edges that end at a hole run on through it: curves, and the loops that they cut."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from fairing import _arguments, _cut_loops, _wires
from fairing._bands import bands_at
from fairing._crossings import crossing_edges, touches
from fairing._cut_loops import Tree, crosses, gap
from fairing._edge_ends import EdgeEnd, ends_at
from fairing._hard_edges import hard_edges
from fairing._loops import Outline, listed
from fairing._making import Making, Wanted, lengths_at
from fairing._matching import Matching, matched
from fairing._types import Diagnostic, FloatArray, IntArray

EDGES = ("run_on", "ignored")


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
    rows: IntArray
    """New vertices on curves along bands."""
    bands: tuple[tuple[IntArray, ...], ...]
    """The vertices along the rows of each, from side to side."""
    warnings: tuple[Diagnostic, ...]

    def left_alone(self, loops: Sequence[IntArray]) -> Curves:
        """Nothing, and a warning; loops: those that they cut, over which no surface holds them."""
        rows = [row for band in self.bands for row in band]
        held = np.intersect1d(np.concatenate(loops), np.concatenate([self.vertices, *rows])).astype(np.int32)
        text = f"no surface holds the edges that would run on from {listed(held)}: they are left alone"
        figures = {"ends": float(len(held)), "no_surface": 1.0}
        warning = Diagnostic("EDGES_LEFT_ALONE", text, held, "vertex", figures)
        nothing = tuple(None for _ in self.cut)
        return replace(self, cut=nothing, curves=(), marked=(), bands=(), warnings=(*self.warnings, warning))

    @property
    def vertices(self) -> IntArray:
        """All whose slope each side finds: on curves, along bands and on hard edges of the loops, ascending."""
        found: IntArray = np.unique(np.concatenate([self.rims, self.rows, *self.curves])).astype(np.int32)
        return found


@dataclass(frozen=True, eq=False)
class Edges:
    """What may run through holes: hard edges around them, those among these that were marked, and wires."""

    hard: IntArray
    marked: set[tuple[int, int]]
    wires: IntArray
    run_through: bool = True
    """Whether anything may: bands, too."""

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
            return cls(_arguments.NO_EDGES, set(), _arguments.NO_EDGES, False)
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
        wanted = Wanted((length or mean) if even else 0.0, (length or mean) / mean)
        return _run_on(outline, normals, mesh, self, wanted)


def _run_on(
    outline: Outline,
    normals: FloatArray,
    mesh: tuple[FloatArray, IntArray],
    edges: Edges,
    wanted: Wanted,
) -> Curves:
    points = mesh[0]
    old_count = len(points)
    found: list[_Through] = []
    cuts: list[_cut_loops.CutOutline | None] = []
    names, passes = np.unique(outline.vertices, return_counts=True)
    pinches = names[passes > 1]
    for loop, rows in zip(outline.loops, outline.split(normals), strict=True):
        if np.isin(loop, pinches).any():  # which pass an edge ends at is not known
            cuts.append(None)
            continue
        finder = _Finder(loop, rows, mesh, edges, wanted)
        through, cut = finder.through(points)
        points = through.making.points
        found.append(through)
        cuts.append(cut)
    return Curves(
        points,
        old_count,
        tuple(cuts),
        tuple(curve for each in found for curve in each.making.curves),
        np.concatenate([np.empty(0, np.int32), *(each.rim for each in found)]),
        tuple(is_marked for each in found for is_marked in each.making.marked),
        np.concatenate([np.empty(0, np.int32), *(row for each in found for row in each.making.rows)]),
        tuple(band for each in found for band in each.making.bands),
        tuple(warning for each in found for warning in each.warnings),
    )


@dataclass(frozen=True, eq=False)
class _Through:
    """What runs through one loop, and along it."""

    loop: IntArray
    normals: FloatArray
    making: Making
    trees: list[Tree]
    along: list[range]
    warnings: list[Diagnostic]

    @property
    def rim(self) -> IntArray:
        """The loop's vertices on hard edges along it."""
        return self.loop[sorted({place % len(self.loop) for run in self.along for place in run})]

    def cut(self, triangles: IntArray) -> _cut_loops.CutOutline | None:
        """The loop in parts; None where nothing runs through it or along it."""
        if not self.trees and not self.along:
            return None
        points = self.making.points
        sides = _cut_loops.outside_normals(self.loop, points, triangles)
        missing = ~sides.any(axis=1)
        sides[missing] = self.normals[missing]
        normals = self.normals.copy()
        for run in self.along:
            _take_other_side(run, sides, normals)
        return _cut_loops.cut(self.loop, normals, sides, self.trees, points)


@dataclass(frozen=True, eq=False)
class _Finder:
    """Looks at one loop."""

    loop: IntArray
    normals: FloatArray
    mesh: tuple[FloatArray, IntArray]
    edges: Edges
    wanted: Wanted

    def through(self, points: FloatArray) -> tuple[_Through, _cut_loops.CutOutline | None]:
        """What runs through, and the loop cut along it. points: all vertices so far.

        Where curves meet the outline or each other, bands are left out, and then all but drawn edges.
        """
        vertices, triangles = self.mesh
        drawn = _wires.drawn(self.loop, self.edges.wires)
        there = ends_at(self.loop, vertices, triangles, self.edges.hard, self.edges.marked)
        free = [end for end in there.ends if end.vertex not in drawn.reached]
        marked = {end.vertex for end in there.ends if end.marked}
        for ends, with_bands in ((free, self.edges.run_through), (free, False), ([], False)):
            making = Making(points, self.wanted)
            making.drawn(drawn, marked)
            trees, warnings = self._edges(ends, drawn.trees, making)
            if with_bands:
                warnings = self._bands(trees, warnings, making)
            if len(ends) < len(free):
                warnings = _told(free, range(len(free)), "crossing", "the way on crosses the outline")
            leaves = {leaf for tree in trees for leaf in tree.leaves}
            along = there.along + [end.run for end in ends if end.at in leaves and len(end.run)]
            through = _Through(self.loop, self.normals, making, trees, along, warnings)
            cut = None if crosses(trees) else through.cut(triangles)
            if (cut is None and not trees) or (cut is not None and not _is_tangled(cut, making.points)):
                return through, cut
        raise _wires.refusal("meet its outline or each other", drawn.vertices, "move them apart")

    def _edges(self, ends: list[EdgeEnd], drawn: Sequence[Tree], making: Making) -> tuple[list[Tree], list[Diagnostic]]:
        lengths = lengths_at(self.mesh[0][self.loop])
        trees, warnings = list(drawn), []
        for group in _apart(ends, drawn):
            matching = matched(group)
            warnings += _warnings(group, matching)
            trees += [making.joined(self.loop, joint, group, lengths) for joint in matching.joints]
        return trees, warnings

    def _bands(self, trees: list[Tree], warnings: list[Diagnostic], making: Making) -> list[Diagnostic]:
        """Add curves along bands that no hard edge runs in, and return the warnings about ends in none of them."""
        points = self.mesh[0][self.loop]
        leaves = {leaf for tree in trees for leaf in tree.leaves}
        bands = [each for each in bands_at(self.loop, self.mesh[0], self.normals) if not leaves & each.covered]
        mean = float(lengths_at(points).mean())
        inside: set[int] = set()
        for joint in matched([band.end for band in bands]).joints:
            if joint.centre is None:
                one, other = (bands[k] for k in joint.ends)
                if one.covered & other.covered:  # beside each other: nothing lies between
                    continue
                trees += making.band(self.loop, one, other, mean)
                inside |= set(self.loop[sorted(one.covered | other.covered)].tolist())
        return [each for each in warnings if not inside >= set(each.elements.tolist())]


def _is_tangled(cut: _cut_loops.CutOutline, points: FloatArray) -> bool:
    """Whether a part crosses or touches itself, or bounds nothing."""
    for loop in cut.loops:
        if len(loop) < 3 or len(crossing_edges([loop], points)):
            return True
        found = touches([loop], points)
        if len(found.on_edges) or len(found.pairs):
            return True
    return False


def _take_other_side(run: range, sides: FloatArray, normals: FloatArray) -> None:
    """The faces at a hard edge along the loop lie beyond it: normals there are those next to where the edge comes."""
    count = len(sides)
    before = run[0] - 1 if run.step > 0 else run[0]
    for place, after in pairwise(run):
        sides[min(place, after) % count] = sides[before % count]
    normals[np.array(run) % count] = sides[before % count]


def _apart(ends: Sequence[EdgeEnd], trees: Sequence[Tree]) -> list[list[EdgeEnd]]:
    """Ends between which no tree lies."""
    groups: dict[tuple[int, ...], list[EdgeEnd]] = {}
    for end in ends:
        groups.setdefault(tuple(gap(tree, end.at) for tree in trees), []).append(end)
    return list(groups.values())


def _warnings(ends: Sequence[EdgeEnd], matching: Matching) -> list[Diagnostic]:
    """Name the ends that are left alone."""
    return [
        *_told(ends, matching.lonely, "lonely", "no other one goes on from there"),
        *_told(ends, matching.ambiguous, "ambiguous", "they may be joined in several ways"),
        *_told(ends, matching.too_many, "too_many", "they are too many to be joined"),
    ]


def _told(ends: Sequence[EdgeEnd], which: Sequence[int], figure: str, why: str) -> list[Diagnostic]:
    if not which:
        return []
    where = np.sort(np.array([ends[k].vertex for k in which], dtype=np.int32))
    what = "1 hard edge ends" if len(where) == 1 else f"{len(where)} hard edges end"
    text = f"{what} at a hole, at {listed(where)}: {why}"
    return [Diagnostic("EDGES_LEFT_ALONE", text, where, "vertex", {"ends": float(len(where)), figure: 1.0})]
