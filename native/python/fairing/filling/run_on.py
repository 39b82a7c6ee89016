"""Hard edges around a hole that run on through it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filling import loops
from fairing.filling.ends import EdgeEnd, Matching, ends_at, matched
from fairing.filling.loops import Tree, crosses, gap
from fairing.filling.making import Making, Wanted, bands_at, lengths_at
from fairing.measure import hard_edges
from fairing.options import arguments
from fairing.options.arguments import listed
from fairing.results import Diagnostic, FloatArray, IntArray, MeshError

EDGES = ("run_on", "ignored")


@dataclass(frozen=True, eq=False)
class Curves:
    """What runs through one loop, and along it: None of ``cut`` where all is left alone."""

    loop: IntArray
    normals: FloatArray
    making: Making
    trees: list[Tree]
    along: list[range]
    warnings: list[Diagnostic]
    cut: loops.CutOutline | None = None

    def left_alone(self) -> tuple[Diagnostic, ...]:
        """The warnings where no surface holds the edges."""
        rows = [row for band in self.making.bands for row in band]
        held = np.intersect1d(self.loop, np.concatenate([self.vertices, *rows])).astype(np.int32)
        text = f"no surface holds the edges that would run on from {listed(held)}: they are left alone"
        figures = {"ends": float(len(held)), "no_surface": 1.0}
        return (*self.warnings, Diagnostic("EDGES_LEFT_ALONE", text, held, "vertex", figures))

    @property
    def vertices(self) -> IntArray:
        """All whose slope each side finds: on curves, along bands and on hard edges of the loop, ascending."""
        rim = self.loop[sorted({place % len(self.loop) for run in self.along for place in run})]
        found: IntArray = np.unique(np.concatenate([rim, *self.making.rows, *self.making.curves])).astype(np.int32)
        return found

    @property
    def for_engine(self) -> tuple[FloatArray, list[IntArray], list[FloatArray], IntArray, IntArray] | None:
        """What a surface along them is made of; None where all are left alone."""
        if self.cut is None:
            return None
        chains = [*self.making.curves, *(row for band in self.making.bands for row in band)]
        edges = [np.column_stack([chain[:-1], chain[1:]]) for chain in chains]
        kept = np.concatenate([arguments.NO_EDGES, *edges]).astype(np.int32)
        return self.making.added, list(self.cut.loops), list(self.cut.normals), self.vertices, kept

    def parted(self, points: FloatArray, triangles: IntArray) -> Curves:
        """With the loop cut, where anything runs through it or along it."""
        if not self.trees and not self.along:
            return self
        sides = loops.outside_normals(self.loop, points, triangles)
        missing = ~sides.any(axis=1)
        sides[missing] = self.normals[missing]
        normals = self.normals.copy()
        for run in self.along:
            _take_other_side(run, sides, normals)
        return replace(self, cut=loops.cut(self.loop, normals, sides, self.trees, self.making.at))


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
            arguments.vertices_of(name, value, len(points), 2) for name, value in (("wires", wires), ("marked", marked))
        )
        if arguments.choice("edges", edges, EDGES) == "ignored" or bridge:
            return cls(arguments.NO_EDGES, set(), arguments.NO_EDGES, False)
        pairs = {(min(pair), max(pair)) for pair in marks.tolist()}
        return cls(hard_edges(points, around, marked=marks), pairs, drawn)

    def through(
        self, holes: _core.Holes, points: FloatArray, spacing: tuple[float, bool]
    ) -> list[Curves | Diagnostic | None]:
        """What runs through each hole, found by what is around it alone, or why it can't be filled.

        spacing: a length or 0, and whether it is the same everywhere.
        """
        if not self.run_through:
            return []
        loops, slopes = [loops[0] for loops in holes.loops], holes.slopes(spacing[0])
        near = _touched(loops, np.concatenate([self.hard, self.wires]), len(points))
        near |= [bool(bands_at(loop, points, normals)) for loop, (normals, _) in zip(loops, slopes, strict=True)]
        found: list[Curves | Diagnostic | None] = [None] * len(loops)
        for k in np.flatnonzero(near).tolist():
            if not slopes[k][1]:
                continue
            names, triangles = holes.around(k)
            near_by = np.isin(self.hard, np.append(names, self.wires)).all(axis=1)
            local = replace(self, hard=self.hard[near_by])
            try:
                found[k] = local.run_on(loops[k], slopes[k][0], (points, names[triangles]), spacing)
            except MeshError as error:
                found[k] = error.diagnostic
        return found

    def run_on(
        self, loop: IntArray, normals: FloatArray, mesh: tuple[FloatArray, IntArray], spacing: tuple[float, bool]
    ) -> Curves | None:
        """The curves through a loop with its normals (k, 3); None where nothing runs through it or is left alone."""
        points = mesh[0]
        mean = float(np.linalg.norm(np.roll(points[loop], -1, axis=0) - points[loop], axis=1).mean())
        length, even = spacing
        wanted = Wanted((length or mean) if even else 0.0, (length or mean) / mean)
        found = _Finder(loop, normals, mesh, self, wanted).found()
        return found if found.cut is not None or found.warnings else None


def _touched(loops: Sequence[IntArray], edges: IntArray, count: int) -> npt.NDArray[np.bool_]:
    """(l,) the loops with a vertex at which one of the edges ends."""
    at = np.zeros(count, dtype=bool)
    at[edges] = True
    return np.array([at[loop].any() for loop in loops], dtype=bool)


@dataclass(frozen=True, eq=False)
class _Finder:
    """Looks at one loop."""

    loop: IntArray
    normals: FloatArray
    mesh: tuple[FloatArray, IntArray]
    edges: Edges
    wanted: Wanted

    def found(self) -> Curves:
        """Where curves meet the boundary or each other, bands are left out, and then all but drawn edges."""
        vertices, triangles = self.mesh
        drawn = loops.drawn(self.loop, self.edges.wires)
        there = ends_at(self.loop, vertices, triangles, self.edges.hard, self.edges.marked)
        free = [end for end in there.ends if end.vertex not in drawn.reached]
        marked = {end.vertex for end in there.ends if end.marked}
        for ends, with_bands in ((free, self.edges.run_through), (free, False), ([], False)):
            making = Making(vertices, self.wanted)
            making.drawn(drawn, marked)
            trees, warnings = self._edges(ends, drawn.trees, making)
            if with_bands:
                warnings = self._bands(trees, warnings, making)
            if len(ends) < len(free):
                warnings = _told(free, range(len(free)), "crossing", "the way on crosses the outline")
            leaves = {leaf for tree in trees for leaf in tree.leaves}
            along = there.along + [end.run for end in ends if end.at in leaves and len(end.run)]
            found = Curves(self.loop, self.normals, making, trees, along, warnings)
            if not crosses(trees):
                found = found.parted(vertices, triangles)
            if not trees if found.cut is None else not _is_tangled(found.cut, making):
                return found
        raise loops.refusal("meet its boundary or each other", drawn.vertices, "move them apart")

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


def _is_tangled(cut: loops.CutOutline, making: Making) -> bool:
    """Whether a part crosses or touches itself, or bounds nothing."""
    for loop in cut.loops:
        names, place = np.unique(loop, return_inverse=True)
        around, points = np.column_stack([place, np.roll(place, -1)]).astype(np.int32), making.at(names)
        if (
            len(loop) < 3
            or len(_core.crossing_edges(around, points))
            or any(map(len, _core.touching_edges(around, points)))
        ):
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
