"""Curves across holes: where they run, and new vertices on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fairing import _core, _wires
from fairing._bands import Band, pairs_across
from fairing._cut_loops import Tree
from fairing._edge_ends import EdgeEnd
from fairing._matching import Joint
from fairing._types import FloatArray, IntArray

_LONGEST_IN_BAND = 2.0  # rows across it: longer edges along it would make needles


@dataclass(frozen=True, eq=False)
class Wanted:
    """How long the edges of curves are to be."""

    length: float
    """0: ``factor`` times as long as the loop's edges at the curve's ends."""
    factor: float


class Making:
    """Collects curves, and new vertices on them."""

    def __init__(self, vertices: FloatArray, wanted: Wanted) -> None:
        self._vertices = vertices
        self._wanted = wanted
        self._added: list[FloatArray] = []
        self.curves: list[IntArray] = []
        self.rows: list[IntArray] = []
        self.bands: list[tuple[IntArray, IntArray]] = []
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

    def band(self, loop: IntArray, one: Band, other: Band, length: float) -> list[Tree]:
        """Curves between vertices across both ends of a band where the normal has turned as much."""
        row = min(float(np.linalg.norm(np.diff(each.points, axis=0), axis=1).mean()) for each in (one, other))
        edge = min(length, _LONGEST_IN_BAND * row)
        trees: list[Tree] = []
        for a, b in pairs_across(one, other):
            begin = replace(one.end, place=one.points[a])
            inner = self._new(self._curve(begin, (other.points[b], -other.end.direction), (edge, edge)))
            path = np.concatenate([loop[[one.places[a]]], inner, loop[[other.places[b]]]]).astype(np.int32)
            self.rows.append(inner)
            ends = int(one.places[a]), int(other.places[b])
            paths = (path, path[::-1].copy())
            trees.append(Tree(ends, paths) if ends[0] < ends[1] else Tree(ends[::-1], paths[::-1]))
        self.bands.append((trees[0].paths[0], trees[-1].paths[0]))
        return trees

    def drawn(self, found: _wires.Drawn, marked: set[int]) -> None:
        """Curves that are there as wires; marked: where marked hard edges come to the loop."""
        for curve in found.curves:
            ends = {int(curve[0]), int(curve[-1])} & found.reached
            self._keep(curve, ends <= marked)

    def _keep(self, curve: IntArray, is_marked: bool) -> None:
        self.curves.append(curve)
        self.marked.append(is_marked)


def _shares(length: float, ends: tuple[float, float], wanted: Wanted) -> FloatArray:
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


def lengths_at(points: FloatArray) -> FloatArray:
    """(k,) the mean length of the two edges at each vertex of a loop."""
    edges = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    mean: FloatArray = 0.5 * (edges + np.roll(edges, 1))
    return mean
