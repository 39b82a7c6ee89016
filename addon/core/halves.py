"""Holes at the plane of a Mirror modifier: half of a boundary, which its image closes. Plain numpy, no bpy.

The whole hole is filled first. Where its surface meets the plane runs a curve; the half is filled once more between
that curve, with the slopes there, and its own part of the boundary, so that it has vertices on the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints
from .border import Left
from .reflected import with_image_across
from .region import MeshArrays, Reflection
from .symmetry import FLIP, NEAR

_NO_HALF = "The border follows a Mirror modifier's plane, which closes it there: apply the modifier first"


@dataclass(frozen=True)
class Half:
    """A part of a border between two vertices on a plane, the hole on its left."""

    chain: Ints  # (r,) mesh vertices; the first and the last lie on the plane
    reflection: Reflection
    image: Ints | None = None  # (r,) of the chain, where the mesh has both sides

    def whole(self, mesh: MeshArrays) -> tuple[MeshArrays, Ints]:
        """Return the mesh with its image after it, and the boundary of the whole hole there."""
        if self.image is not None:
            return mesh, np.concatenate([self.chain, self.image[-2:0:-1]])
        whole, image = with_image_across(mesh, self.reflection)
        return whole, np.concatenate([self.chain, image[self.chain[-2:0:-1]]])


def halves_of(mesh: MeshArrays, loop: Ints) -> tuple[list[Half], list[Left]] | None:
    """Return the halves of holes along a border that follows planes of reflection; None where it follows none.

    What lies between two vertices on a plane is half of a hole, unless it is an edge along the plane. Where two planes
    meet in a hole it stays open.
    """
    on = [reflection.on_plane(mesh.positions[loop]) for reflection in mesh.reflections]
    if not any((there & np.roll(there, -1)).any() for there in on):
        return None
    cuts = np.flatnonzero(np.any(on, axis=0))
    halves, left = [], []
    for begin, end in zip(cuts.tolist(), [*cuts[1:].tolist(), int(cuts[0]) + len(loop)], strict=True):
        places = np.arange(begin, end + 1) % len(loop)
        planes = [k for k, there in enumerate(on) if there[places[0]] and there[places[-1]]]
        if end - begin == 1 and planes:
            continue
        chain = loop[places]
        if len(planes) == 1 and chain[0] != chain[-1]:
            halves.append(Half(chain, mesh.reflections[planes[0]]))
        else:
            left.append(Left(np.unique(chain), _NO_HALF, np.unique(chain[[0, -1]])))
    return halves, left


def symmetric_half(mesh: MeshArrays, loop: Ints) -> Half | None:
    """Return the half x ≥ 0 of a border that is symmetric across x = 0 and crosses that plane in two vertices."""
    points = mesh.positions[loop]
    on = np.flatnonzero(np.abs(points[:, 0]) <= NEAR)
    if len(on) != 2 or on[1] - on[0] in (1, len(loop) - 1):
        return None
    first, last = (int(k) for k in (on if points[on[0] + 1, 0] > 0.0 else on[::-1]))
    count = (last - first) % len(loop) + 1
    chain = loop[(first + np.arange(count)) % len(loop)]
    image = loop[(first - np.arange(count)) % len(loop)]
    if 2 * count - 2 != len(loop):
        return None
    apart = np.linalg.norm(mesh.positions[chain] * FLIP - mesh.positions[image], axis=1)
    if not (apart <= NEAR).all():
        return None
    return Half(chain, Reflection(np.diag([*FLIP, 1.0]), 2.0 * NEAR), image)


@dataclass(frozen=True)
class Curve:
    """Where a surface meets a plane, from one end to the other."""

    places: Floats  # (c, 3)
    normals: Floats  # (c, 3) of the surface there, unit


def curve_on_plane(points: Floats, normals: Floats, triangles: Ints, heights: Floats, ends: tuple[int, int]) -> Curve:
    """Return the curve over the plane on which the heights (n,) of the points are 0, from one vertex to another.

    Raises ValueError where the surface does not lead there.
    """
    onward: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for row in triangles.tolist():
        crossed = _crossings(row, heights)
        if len(crossed) == 2:
            onward.setdefault(crossed[0], []).append(crossed[1])
            onward.setdefault(crossed[1], []).append(crossed[0])
    way = _way(onward, (ends[0], ends[0]), (ends[1], ends[1]))
    a, b = np.array(way).T
    span = heights[b] - heights[a]
    share = np.where(a == b, 0.0, -heights[a] / np.where(a == b, 1.0, span))[:, None]
    found = normals[a] + share * (normals[b] - normals[a])
    return Curve(points[a] + share * (points[b] - points[a]), found)


def _crossings(row: Sequence[int], heights: Floats) -> list[tuple[int, int]]:
    """Return where a triangle meets the plane: corners (twice the same vertex) and sides, each with its smaller end."""
    found = {(vertex, vertex) for vertex in row if heights[vertex] == 0.0}
    for a, b in zip(row, (*row[1:], row[0]), strict=True):
        if heights[a] * heights[b] < 0.0:
            found.add((min(a, b), max(a, b)))
    return sorted(found)


def _way(
    onward: dict[tuple[int, int], list[tuple[int, int]]], begin: tuple[int, int], end: tuple[int, int]
) -> list[tuple[int, int]]:
    """Return the shortest way, by the number of its steps."""
    before = {begin: begin}
    ahead = [begin]
    while ahead and end not in before:
        following = []
        for place in ahead:
            for other in onward.get(place, ()):
                if other not in before:
                    before[other] = place
                    following.append(other)
        ahead = following
    if end not in before:
        raise ValueError("The surface over the whole hole does not meet the Mirror modifier's plane in one curve")
    way = [end]
    while way[-1] != begin:
        way.append(before[way[-1]])
    return way[::-1]


def spread(curve: Curve, edge: float) -> Curve:
    """Return places along a curve, without its ends, so that all edges are about so long."""
    steps = np.linalg.norm(np.diff(curve.places, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(1, round(float(along[-1]) / edge))
    at = along[-1] * np.arange(1, count) / count
    places, normals = (
        np.stack([np.interp(at, along, column) for column in values.T], axis=1)
        for values in (curve.places, curve.normals)
    )
    return Curve(places, normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None])
