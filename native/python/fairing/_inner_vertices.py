"""Vertices inside a patch of few large faces, none of whose own is free: a new mesh begins with these."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fairing import _core
from fairing._types import FloatArray, IntArray

_HALVINGS = 4  # after which a patch has some hundred free vertices: lengths grow over ten edges and more


@dataclass(frozen=True)
class Refined:
    """The same surface with more triangles."""

    vertices: FloatArray
    """(n + c, 3) the given ones come first."""
    triangles: IntArray
    parent: IntArray
    """(m',) the given triangle that each lies in,"""
    corners: FloatArray
    """(m', 3, 3) and the barycentric coordinates of its corners there."""

    def given(self, origin: tuple[IntArray, FloatArray]) -> tuple[IntArray, FloatArray]:
        """Places on these triangles as places on the given ones: triangles and weights."""
        rows, weights = origin
        there: FloatArray = np.einsum("kc,kcw->kw", weights, self.corners[rows])
        return self.parent[rows], there


def with_inner_vertices(
    vertices: FloatArray, triangles: IntArray, fixed: IntArray | None, kept: IntArray
) -> Refined | None:
    """Edges inside that are not ``kept`` are halved, and triangles without such an edge get a vertex in their middle.

    None where a vertex is free already, as the patch has a surface of its own then, or one inside is held.
    """
    if not len(triangles) or (_core.components(triangles, fixed, len(vertices)) >= 0).any():
        return None
    border = np.concatenate([np.empty(0, np.int32), *_core.boundary_loops(triangles)])
    if not np.isin(triangles, border).all():
        return None
    count = len(triangles)
    whole = Refined(vertices, triangles, np.arange(count, dtype=np.int32), np.tile(np.eye(3), (count, 1, 1)))
    held = {(min(a, b), max(a, b)) for a, b in kept.tolist()}
    for _ in range(_HALVINGS):
        whole = _halved(whole, held)
    return whole


def _halved(whole: Refined, held: set[tuple[int, int]]) -> Refined:
    uses: dict[tuple[int, int], int] = {}
    for row in whole.triangles.tolist():
        for side in _sides(row):
            uses[side] = uses.get(side, 0) + 1
    splits = {side for side, count in uses.items() if count == 2 and side not in held}
    middle: dict[tuple[int, int], int] = {}
    points = [whole.vertices]
    rows: list[list[int]] = []
    parents: list[int] = []
    corners: list[FloatArray] = []

    def added(place: FloatArray) -> int:
        points.append(place[None])
        return len(whole.vertices) + len(points) - 2

    for t, row in enumerate(whole.triangles.tolist()):
        places = dict(zip(row, whole.corners[t], strict=True))
        inner = [side for side in _sides(row) if side in splits]
        for a, b in inner:
            if (a, b) not in middle:
                middle[a, b] = added(0.5 * (whole.vertices[a] + whole.vertices[b]))
            places[middle[a, b]] = 0.5 * (places[a] + places[b])
        if inner:
            pieces = _cut(row, {side: middle[side] for side in inner})
        else:
            hub = added(whole.vertices[row].mean(axis=0))
            places[hub] = whole.corners[t].mean(axis=0)
            pieces = [[a, b, hub] for a, b in zip(row, row[1:] + row[:1], strict=True)]
        rows += pieces
        parents += [int(whole.parent[t])] * len(pieces)
        corners += [np.stack([places[vertex] for vertex in piece]) for piece in pieces]
    return Refined(
        np.concatenate(points), np.array(rows, dtype=np.int32), np.array(parents, dtype=np.int32), np.stack(corners)
    )


def _sides(row: list[int]) -> list[tuple[int, int]]:
    return [(min(a, b), max(a, b)) for a, b in zip(row, row[1:] + row[:1], strict=True)]


def _cut(row: list[int], middle: dict[tuple[int, int], int]) -> list[list[int]]:
    """The triangles of one whose sides have middles, in its winding: one for each middle, and the rest."""
    around: list[int] = []
    for a, b in zip(row, row[1:] + row[:1], strict=True):
        around.append(a)
        if (min(a, b), max(a, b)) in middle:
            around.append(middle[min(a, b), max(a, b)])
    pieces = []
    while len(around) > 3:  # cut off a corner between two middles, or from the first middle on
        new = [k for k, vertex in enumerate(around) if vertex in middle.values()]
        beside = [{(k - 1) % len(around), (k + 1) % len(around)} for k in range(len(around))]
        ears = [k for k, vertex in enumerate(around) if vertex in row and beside[k] <= {*new}]
        at = ears[0] if ears else (new[0] + 1) % len(around)
        pieces.append([around[at - 1], around[at], around[(at + 1) % len(around)]])
        del around[at]
    return [*pieces, around]
