"""Hard edges around a hole that run on through it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from fairing import _core
from fairing.filling import loops
from fairing.filling.ends import EdgeEnd, ends_at, matched, sides_of
from fairing.filling.loops import Tree, crosses, gap
from fairing.filling.making import Making, bands_at, lengths_at
from fairing.options import arguments
from fairing.options.arguments import listed
from fairing.results import Diagnostic, FloatArray, IntArray, MeshError

EDGES = ("run_on", "ignored")


@dataclass(frozen=True, eq=False)
class Curves:
    """What runs through one loop, and along it."""

    loop: IntArray
    making: Making
    trees: list[Tree]
    along: list[range]
    warnings: list[Diagnostic]
    cut: tuple[list[IntArray], list[FloatArray]] | None = None
    """The loops that are left, and their normals; None where all is left alone."""

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
        return np.unique(np.concatenate([rim, *self.making.rows, *self.making.curves])).astype(np.int32)

    @property
    def for_engine(self) -> tuple[FloatArray, list[IntArray], list[FloatArray], IntArray, IntArray] | None:
        """What a surface along them is made of; None where all are left alone."""
        if self.cut is None:
            return None
        chains = [*self.making.curves, *(row for band in self.making.bands for row in band)]
        edges = [np.column_stack([chain[:-1], chain[1:]]) for chain in chains]
        kept = np.concatenate([arguments.NO_EDGES, *edges]).astype(np.int32)
        return self.making.added, *self.cut, self.vertices, kept

    def parted(self, normals: FloatArray, points: FloatArray, triangles: IntArray) -> Curves:
        """With the loop cut, where anything runs through it or along it; normals: (k, 3) at its vertices."""
        if not self.trees and not self.along:
            return self
        sides = loops.outside_normals(self.loop, points, triangles)
        missing = ~sides.any(axis=1)
        sides[missing] = normals[missing]
        normals = normals.copy()
        for run in self.along:
            _take_other_side(run, sides, normals)
        return replace(self, cut=loops.cut(self.loop, normals, sides, self.trees, self.making.at))


@dataclass(frozen=True, eq=False)
class Edges:
    """What may run through holes: hard edges around them, of which some were marked, and wires."""

    marked: IntArray
    wires: IntArray
    spacing: tuple[float, bool]
    """A length or 0, and whether it is the same everywhere."""

    @classmethod
    def of(cls, count: int, wires: Any, marked: Any, spacing: tuple[float, bool]) -> Edges:
        """count: of vertices; wires, marked: of :func:`fairing.fill`."""
        drawn, marks = (
            arguments.vertices_of(name, value, count, 2) for name, value in (("wires", wires), ("marked", marked))
        )
        return cls(marks, drawn, spacing)

    def through(self, holes: _core.Holes, points: FloatArray) -> list[Curves | Diagnostic | None]:
        """What runs through each hole, found by what is around it alone, or why it can't be filled."""
        found: list[Curves | Diagnostic | None] = []
        for k, ((loop, *_), slopes) in enumerate(zip(holes.loops, holes.slopes(self.spacing[0]), strict=True)):
            normals, hard, may = slopes
            found.append(None)
            lines = np.concatenate([hard, self.wires])
            if not may or not (np.isin(loop, lines).any() or bands_at(loop, points, normals)):
                continue
            names, triangles = holes.around(k)
            try:
                curves = self.run_on(loop, normals, (points, names[triangles]), hard)
            except MeshError as error:
                found[k] = error.diagnostic
            else:
                found[k] = curves if curves.cut is not None or curves.warnings else None
        return found

    def run_on(self, loop: IntArray, normals: FloatArray, mesh: tuple[FloatArray, IntArray], hard: IntArray) -> Curves:
        """The curves through a loop with its normals (k, 3) and the hard edges around (h, 2).

        Where they meet the boundary or each other, bands are left out, and then all but drawn edges.
        """
        points, triangles = mesh
        lengths, (length, even) = lengths_at(points[loop]), self.spacing
        mean = float(lengths.mean())
        drawn = loops.drawn(loop, self.wires)
        all_ends, runs = ends_at(loop, points, triangles, hard, self.marked)
        free = [end for end in all_ends if end.vertex not in drawn.reached]
        marked = {end.vertex for end in all_ends if end.marked}
        for ends, with_bands in ((free, True), (free, False), ([], False)):
            making = Making(points, (length or mean) if even else 0.0, (length or mean) / mean)
            for curve in drawn.curves:
                making.keep(curve, {int(curve[0]), int(curve[-1])} & drawn.reached <= marked)
            trees, warnings = list(drawn.trees), []
            for group in _apart(ends, drawn.trees):
                joints, left = matched(group)
                warnings += [each for why, which in left.items() for each in _left(group, which, why)]
                trees += [making.joined(loop, joint, group, lengths) for joint in joints]
            if with_bands:
                warnings = _bands(loop, normals, trees, warnings, making)
            if len(ends) < len(free):
                warnings = _left(free, range(len(free)), "crossing")
            leaves = {leaf for tree in trees for leaf in tree.leaves}
            along = runs + [end.run for end in ends if end.at in leaves and len(end.run)]
            found = Curves(loop, making, trees, along, warnings)
            if not crosses(trees):
                found = found.parted(normals, points, triangles)
            if not trees if found.cut is None else not _is_tangled(found.cut[0], making):
                return found
        where = np.unique(np.concatenate([arguments.NO_EDGES.ravel(), *drawn.curves]))
        raise loops.refusal("touch its boundary or each other", where, "move them apart")


def _bands(
    loop: IntArray, normals: FloatArray, trees: list[Tree], warnings: list[Diagnostic], making: Making
) -> list[Diagnostic]:
    """Add curves along bands that no hard edge runs in, and return the warnings about ends in none of them."""
    leaves = {leaf for tree in trees for leaf in tree.leaves}
    bands = [each for each in bands_at(loop, making.vertices, normals) if not leaves & each.covered]
    inside: set[int] = set()
    for joint in matched([band.end for band in bands])[0]:
        if joint.centre is None:
            one, other = (bands[k] for k in joint.ends)
            if one.covered & other.covered:  # adjacent: nothing lies between
                continue
            trees += making.band(loop, one, other, float(lengths_at(making.vertices[loop]).mean()))
            inside |= set(loop[sorted(one.covered | other.covered)].tolist())
    return [each for each in warnings if not inside >= set(each.elements.tolist())]


def _is_tangled(parts: list[IntArray], making: Making) -> bool:
    """Whether a part crosses or touches itself, or bounds nothing."""
    for loop in parts:
        names, place = np.unique(loop, return_inverse=True)
        around, points = sides_of(place.astype(np.int32)), making.at(names)
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


_WHY = {
    "lonely": "no edge across it matches",
    "ambiguous": "they may be joined in several ways",
    "too_many": "they are too many to be joined",
    "crossing": "they would cross the boundary",
}


def _left(ends: Sequence[EdgeEnd], which: Sequence[int], why: str) -> list[Diagnostic]:
    """Name the ends that are left alone, if there are any."""
    if not which:
        return []
    where = np.sort(np.array([ends[k].vertex for k in which], dtype=np.int32))
    what = "1 hard edge ends" if len(where) == 1 else f"{len(where)} hard edges end"
    text = f"{what} at a hole, at {listed(where)}: {_WHY[why]}"
    return [Diagnostic("EDGES_LEFT_ALONE", text, where, "vertex", {"ends": float(len(where)), why: 1.0})]
