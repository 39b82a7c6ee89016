"""The faces of a new surface: its triangles, or quads of two of them and the triangles that are left. No bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from ..arrays.types import Floats, Ints


@dataclass(frozen=True)
class Faces:
    """f faces over m triangles; a triangle's corner is 3 · its number + its place there."""

    polygons: list[list[int]]  # vertices of each, wound like the triangles
    triangles: Ints  # (f,) the triangle, or the first of the two, that each is made of
    corners: Ints  # of the triangles, at all corners of the faces, face after face


def faces_of(triangles: Ints) -> Faces:
    """Return the triangles (m, 3) themselves."""
    return Faces(triangles.tolist(), np.arange(len(triangles)), np.arange(3 * len(triangles)))


def paired_faces(points: Floats, triangles: Ints, kept: Ints, kinds: Ints) -> Faces:
    """Return quads, as many as there are, then the triangles that are left.

    points: (n, 3). kept: (e, 2) edges that no quad runs across. kinds: (m,) numbers; triangles of two kinds are in no
    quad together.
    """
    found = fairing.maps.paired_quads(points, triangles, np.concatenate([kept, _borders(triangles, kinds)]))
    return _faces(triangles, found)


def faces_in_rows(triangles: Ints, pairs: Ints, kept: Ints) -> Faces:
    """Return quads of known pairs (q, 2), but the halves of those that run across the (e, 2) edges `kept`."""
    first, second = triangles[pairs[:, 0]], triangles[pairs[:, 1]]
    alone = (first[:, :, None] == second[:, None, :]).any(axis=2).argmin(axis=1)
    other = (second[:, :, None] == first[:, None, :]).any(axis=2).argmin(axis=1)
    row = np.arange(len(first))
    around = [first[row, alone], first[row, (alone + 1) % 3], second[row, other], first[row, (alone + 2) % 3]]
    corners = np.stack(around, axis=1).astype(np.int64).reshape(-1, 4)
    diagonals = {(a, b) for a, b in np.sort(kept, axis=1).tolist()}
    whole = np.array([tuple(sorted((b, d))) not in diagonals for _, b, _, d in corners.tolist()], dtype=bool)
    rest = np.setdiff1d(np.arange(len(triangles)), pairs[whole])
    return _faces(triangles, fairing.results.PairedQuads(corners[whole], triangles[rest], pairs[whole], rest))


def _faces(triangles: Ints, found: fairing.results.PairedQuads) -> Faces:
    first, second = found.pairs.T
    beneath = np.stack([first, first, second, first], axis=1)
    place = (triangles[beneath] == found.quads[:, :, None]).argmax(axis=2)
    rest = 3 * found.rest[:, None] + np.arange(3)
    return Faces(
        polygons=found.quads.tolist() + triangles[found.rest].tolist(),
        triangles=np.concatenate([first, found.rest]).astype(np.int64),
        corners=np.concatenate([(3 * beneath + place).ravel(), rest.ravel()]).astype(np.int64),
    )


def inner_edges(triangles: Ints) -> tuple[Ints, Ints]:
    """Return the (e, 2) edges between two triangles and the (e, 2) triangles on their sides."""
    sides = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T)
    ordered, of = sides[order], order // 3
    same = np.flatnonzero((ordered[1:] == ordered[:-1]).all(axis=1))
    return ordered[same], np.stack([of[same], of[same + 1]], axis=1)


def _borders(triangles: Ints, kinds: Ints) -> Ints:
    """Return the (e, 2) edges on whose two sides the kinds differ."""
    edges, sides = inner_edges(triangles)
    found: Ints = edges[kinds[sides[:, 0]] != kinds[sides[:, 1]]]
    return found
