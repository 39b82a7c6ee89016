"""Narrow bands of high curvature around a hole, bevels and rolled edges: where they come to its loop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing._edge_ends import EdgeEnd
from fairing._types import FloatArray, IntArray

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
    edges = np.roll(points, -1, axis=0) - points
    turns = 2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(np.roll(normals, -1, axis=0) - normals, axis=1), 0.0, 1.0))
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    found: list[Band] = []
    for run in _runs(turns, np.linalg.norm(edges, axis=1), _NARROW * size):
        band = _band(run, points, normals, turns, len(found))
        if band is not None:
            found.append(band)
    return found


def may_have_bands(loops: Sequence[FloatArray], normals: Sequence[FloatArray]) -> npt.NDArray[np.bool_]:
    """(l,) loops (k, 3) that turn by far more at some edges than at others: bands come to no other ones."""
    first = np.cumsum([0, *map(len, loops)])[:-1]
    points, slopes = np.concatenate(loops), np.concatenate(normals)
    after = np.arange(1, len(points) + 1)
    after[np.append(first[1:], len(points)) - 1] = first
    turns = 2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(slopes[after] - slopes, axis=1), 0.0, 1.0))
    bend = turns / np.maximum(np.linalg.norm(points[after] - points, axis=1), _TINY)
    extents = np.maximum.reduceat(points, first) - np.minimum.reduceat(points, first)
    sizes = _NARROW * np.linalg.norm(extents, axis=1)
    limits = np.radians(_LEAST_TURN) / np.maximum(sizes, _TINY)
    found: npt.NDArray[np.bool_] = np.maximum.reduceat(bend, first) > limits
    return found


def _runs(turns: FloatArray, lengths: FloatArray, widest: float) -> list[IntArray]:
    """Runs of edges that turn by far more than their like: the narrowest that hold nearly all of a turn."""
    count = len(turns)
    bend = turns / np.maximum(lengths, _TINY)
    strong = bend > np.radians(_LEAST_TURN) / widest
    if strong.all() or not strong.any():
        return []
    start = int(np.flatnonzero(~strong)[0])
    runs: list[list[int]] = []
    for k in range(start, start + count):
        if not strong[k % count]:
            continue
        if runs and k - runs[-1][-1] <= 2:  # an edge along the band turns by nothing
            runs[-1] += range(runs[-1][-1] + 1, k + 1)
        else:
            runs.append([k])
    return [np.array(run) for run in runs]


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
    count = len(turns)
    most = 0.0
    for begin, step in ((int(run[-1]) + 1, 1), (int(run[0]) - 1, -1)):
        k, total = begin, 0.0
        origin = points[(begin + (step < 0)) % count]
        for _ in range(count - len(run)):
            way = points[(k + (step > 0)) % count] - origin
            total += float(turns[k % count])
            if np.linalg.norm(way - (way @ axis) * axis) > width:
                break
            k += step
        most = max(most, total)
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
