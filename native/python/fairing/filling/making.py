"""Curves across holes: where they run, and new vertices on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filling.ends import EdgeEnd, Joint
from fairing.filling.loops import Tree
from fairing.results import FloatArray, IntArray

_LEAST_TURN = 35.0  # degrees of the normal across a band, as of a hard edge
_NARROW = 1.0 / 3.0  # of the loop's size: what is wider is a shape, not an edge
_CONTRAST = 4.0  # so many times as much as beside it does the normal turn within a band, over the same length
_ALONG = 0.866  # cos 30°: an edge of the loop that leaves the band's direction by less runs along it
_TINY = 1e-300


@dataclass(frozen=True, eq=False)
class Band:
    """Where a band comes to a loop: the vertices across it, from one side to the other."""

    places: IntArray
    """(b,) in the loop, ascending but for wrapping around; the first and the last lie beside the band. Where the loop
    runs along the band, only the vertex furthest inside is one of them."""
    covered: frozenset[int]
    """All places in the loop from the first to the last."""
    points: FloatArray
    """(b, 3)"""
    shares: FloatArray
    """(b,) 0 … 1: how much of the whole turn the normal has made."""
    end: EdgeEnd
    """Its middle: the direction into the hole, the turn as angle, and as `at` its place in the list of bands."""


def bands_at(loop: IntArray, vertices: FloatArray, normals: FloatArray) -> list[Band]:
    """The bands across a loop with the hole on its left, in its order; normals: (k, 3) unit."""
    points = vertices[loop]
    lengths = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    turns = 2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(np.roll(normals, -1, axis=0) - normals, axis=1), 0.0, 1.0))
    widest = _NARROW * float(np.linalg.norm(np.ptp(points, axis=0)))
    found: list[Band] = []
    for run in _runs(turns / np.maximum(lengths, _TINY) > np.radians(_LEAST_TURN) / widest):
        band = _band(run, points, normals, turns, len(found))
        if band is not None:
            found.append(band)
    return found


def _runs(strong: npt.NDArray[np.bool_]) -> list[IntArray]:
    """Runs of edges that turn by far more than their like; one edge along the band, which does not, parts none."""
    calm = np.flatnonzero(~strong & ~np.roll(strong, 1))
    if not len(calm):
        return []
    places = calm[0] + np.flatnonzero(np.roll(strong, -calm[0]))
    parts = np.split(places, np.flatnonzero(np.diff(places) > 2) + 1)
    return [np.arange(part[0], part[-1] + 1) for part in parts if len(part)]


def _band(run: IntArray, points: FloatArray, normals: FloatArray, turns: FloatArray, number: int) -> Band | None:
    """None where it turns too little, or not far more than beside it."""
    places = np.arange(run[0], run[-1] + 2) % len(points)
    axis = np.linalg.svd(normals[places])[2][2]
    flat = normals[places] - np.outer(normals[places] @ axis, axis)
    steps = np.arctan2(np.cross(flat[:-1], flat[1:]) @ axis, (flat[:-1] * flat[1:]).sum(axis=1))
    whole = float(steps.sum())
    around = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    inward = np.cross(normals[places], around[places]).sum(axis=0)
    if axis @ inward < 0.0:
        axis, whole = -axis, -whole
    across = points[places[-1]] - points[places[0]]
    width = float(np.linalg.norm(across - (across @ axis) * axis))
    if abs(whole) < np.radians(_LEAST_TURN) or _CONTRAST * _beside(run, turns, points, width, axis) > abs(whole):
        return None
    shares = np.concatenate([[0.0], np.cumsum(np.abs(steps))]) / np.abs(steps).sum()
    places, shares = _furthest_inside(places, shares, points, axis)
    if len(places) < 2:  # the loop runs along all of it
        return None
    middle = points[places].mean(axis=0)
    end = EdgeEnd(number, number, middle, axis, np.zeros(3), float(np.degrees(whole)), False)
    covered = (places[0] + np.arange((places[-1] - places[0]) % len(points) + 1)) % len(points)
    return Band(places, frozenset(covered.tolist()), points[places], shares, end)


def _furthest_inside(
    places: IntArray, shares: FloatArray, points: FloatArray, axis: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Without vertices from which the loop goes on inwards along the band, and with those beside it where it ends."""
    count = len(points)

    def is_along(a: int, b: int) -> bool:
        edge = points[b % count] - points[a % count]
        return bool(abs(edge @ axis) > _ALONG * np.linalg.norm(edge))

    def depth(a: int) -> float:
        return float(points[a % count] @ axis)

    chosen = list(zip(places.tolist(), shares.tolist(), strict=True))
    for end, step in ((-1, 1), (0, -1)):
        place, share = chosen[end]
        while is_along(place, place + step) and depth(place + step) > depth(place) and len(chosen) < count - 1:
            place += step
            chosen.insert(len(chosen) if end else 0, (place % count, share))
    kept = [chosen[0]]
    for place, share in chosen[1:]:
        if not is_along(kept[-1][0], place):
            kept.append((place, share))
        elif depth(place) > depth(kept[-1][0]):
            kept[-1] = (place, share)
    return np.array([place for place, _ in kept]), np.array([share for _, share in kept])


def _beside(run: IntArray, turns: FloatArray, points: FloatArray, width: float, axis: FloatArray) -> float:
    """By how many radians the normal turns within a band's width beside it, the larger of both sides."""
    count, most = len(turns), 0.0
    for begin, step in ((int(run[-1]) + 1, 1), (int(run[0]) - 1, -1)):
        edges = begin + step * np.arange(count - len(run))
        away = points[(edges + (step > 0)) % count] - points[(begin + (step < 0)) % count]
        beyond = np.flatnonzero(np.linalg.norm(away - np.outer(away @ axis, axis), axis=1) > width)
        near = edges[: beyond[0] + 1] if len(beyond) else edges
        most = max(most, float(turns[near % count].sum()))
    return most


def pairs_across(one: Band, other: Band) -> list[tuple[int, int]]:
    """Which places of two bands that face each other belong together: where the normal has turned as much.

    The loop passes them in opposite directions. Each place is in one pair at most, the order is kept, and the sides are
    joined with each other.
    """
    back = 1.0 - other.shares[::-1]
    swapped = len(back) < len(one.shares)
    few, many = (back, one.shares) if swapped else (one.shares, back)
    chosen = [0]
    for k in range(1, len(few) - 1):
        allowed = np.arange(chosen[-1] + 1, len(many) - len(few) + 1 + k)
        chosen.append(int(allowed[np.abs(many[allowed] - few[k]).argmin()]))
    chosen.append(len(many) - 1)
    last = len(other.places) - 1
    return [(b, last - a) if swapped else (a, last - b) for a, b in enumerate(chosen)]


_LONGEST_IN_BAND = 2.0  # rows across it: longer edges along it would make slivers


class Making:
    """Collects curves, and new vertices on them.

    length: of their edges; 0: ``factor`` times as long as the loop's edges at the curve's ends.
    """

    def __init__(self, vertices: FloatArray, length: float, factor: float) -> None:
        self.vertices = vertices
        self._wanted = length, factor
        self._added: list[FloatArray] = []
        self.curves: list[IntArray] = []
        self.rows: list[IntArray] = []
        self.bands: list[tuple[IntArray, ...]] = []
        self.marked: list[bool] = []

    @property
    def added(self) -> FloatArray:
        """(c, 3) the new vertices."""
        return np.concatenate([np.empty((0, 3)), *self._added])

    def at(self, numbers: IntArray) -> FloatArray:
        """(k, 3) where vertices are, given and new ones."""
        is_new = numbers >= len(self.vertices)
        places: FloatArray = self.vertices[np.where(is_new, 0, numbers)]
        places[is_new] = self.added[numbers[is_new] - len(self.vertices)]
        return places

    def _new(self, places: FloatArray) -> IntArray:
        first = len(self.vertices) + sum(map(len, self._added))
        self._added.append(places)
        return np.arange(first, first + len(places), dtype=np.int32)

    def _curve(self, begin: EdgeEnd, end: tuple[FloatArray, FloatArray], lengths: tuple[float, float]) -> FloatArray:
        """Places of new vertices from the end of an edge to a place with its direction, without both."""
        places, directions = np.array([begin.place, end[0]]), np.array([begin.direction, end[1]])
        whole = _core.fair_curve(places, directions, np.linspace(0.0, 1.0, 65))
        length = float(np.linalg.norm(np.diff(whole, axis=0), axis=1).sum())
        return _core.fair_curve(places, directions, _shares(length, lengths, *self._wanted))

    def joined(self, loop: IntArray, joint: Joint, ends: Sequence[EdgeEnd], lengths: FloatArray) -> Tree:
        """The curves of one joint; lengths: (k,) of the loop's edges at each vertex."""
        mine = [ends[k] for k in joint.ends]
        leaves = tuple(end.at for end in mine)
        is_marked = all(end.marked for end in mine)
        if joint.centre is None:
            a, b = mine
            inner = self._new(self._curve(a, (b.place, -b.direction), (lengths[a.at], lengths[b.at])))
            path = np.concatenate([loop[[a.at]], inner, loop[[b.at]]]).astype(np.int32)
            self.keep(path, is_marked)
            return Tree(leaves, (path, path[::-1].copy()))
        centre = self._new(joint.centre[None])
        mean = float(np.mean([lengths[end.at] for end in mine]))
        arms = []
        for end in mine:
            inner = self._new(self._curve(end, (joint.centre, np.zeros(3)), (lengths[end.at], mean)))
            arms.append(np.concatenate([loop[[end.at]], inner, centre]).astype(np.int32))
            self.keep(arms[-1], end.marked)
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
        self.bands.append(tuple(tree.paths[0] for tree in trees))
        return trees

    def keep(self, curve: IntArray, is_marked: bool) -> None:
        self.curves.append(curve)
        self.marked.append(is_marked)


def _shares(length: float, ends: tuple[float, float], wanted: float, factor: float) -> FloatArray:
    """Shares of a curve's length at which its inner vertices lie: edges as long as at the ends, and as wanted between.

    As for all new edges lengths grow or shrink by half of the distance.
    """
    along = np.linspace(0.0, length, 1025)
    here = ends[0] + (ends[1] - ends[0]) * along / length
    goal = np.full_like(along, wanted) if wanted else factor * here
    away = 0.5 * np.minimum(along, length - along)
    edges = np.clip(goal, here - away, here + away)
    edges = np.maximum(edges, 1e-3 * min(ends))
    count = np.concatenate([[0.0], np.cumsum(0.5 * (1.0 / edges[1:] + 1.0 / edges[:-1]) * np.diff(along))])
    whole = max(1, round(float(count[-1])))
    return np.interp(np.arange(1, whole) / whole * count[-1], count, along) / length


def lengths_at(points: FloatArray) -> FloatArray:
    """(k,) the mean length of the two edges at each vertex of a loop."""
    edges = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    return 0.5 * (edges + np.roll(edges, 1))
