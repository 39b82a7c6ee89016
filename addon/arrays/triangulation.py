"""Diagonals for the quads and n-gons of a patch, chosen by connectivity alone.

Blender splits a face by its shape, which says nothing about the fair surface: where the selection
is crumpled the diagonals would be too, and the result would depend on it. Here they balance the
number of edges per vertex instead (six inside, four on the boundary), which the engine likes best.
"""

from __future__ import annotations

import numpy as np

from .types import Ints, Mask

INSIDE, BOUNDARY = 6, 4  # edges per vertex of a regular triangulation
FIXED_DIAGONAL = 50  # cost of a diagonal between fixed vertices: it may cut off a triangle


def zigzag(polygons: Ints) -> Ints:
    """Return the (q (n − 2), 3) triangles of strips across the polygons (q, n), wound alike."""
    size = polygons.shape[1]
    order = [(k + 1) // 2 if k % 2 else (size - k // 2) % size for k in range(size)]
    strips = polygons[:, order]
    corners = [[k, k + 1 + k % 2, k + 2 - k % 2] for k in range(size - 2)]
    triangles: Ints = strips[:, corners].reshape(-1, 3)
    return triangles


def split_quads(quads: Ints, edges: Ints, free: Mask) -> Ints:
    """Return the (2q, 3) triangles of the `quads` (q, 4), wound alike.

    edges: (e, 2) all edges of the patch, without diagonals; free: (n,) mask of the vertices, which
    are numbers below n. The same connectivity gives the same diagonals, whatever the positions.
    """
    excess = np.bincount(edges.ravel(), minlength=len(free)) - np.where(free, INSIDE, BOUNDARY)
    turned = np.zeros(len(quads), dtype=bool)  # False: diagonal from corner 0 to 2
    np.add.at(excess, quads[:, ::2], 1)
    while True:
        gains = _gains(np.where(turned[:, None], np.roll(quads, -1, axis=1), quads), excess, free)
        chosen = _independent(quads, gains)
        if not chosen.any():
            break
        change = np.where(turned[chosen], 1, -1)[:, None]
        np.add.at(excess, quads[chosen][:, ::2], change)
        np.add.at(excess, quads[chosen][:, 1::2], -change)
        turned ^= chosen
    a, b, c, d = np.where(turned[:, None], np.roll(quads, -1, axis=1), quads).T
    triangles: Ints = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    return triangles


def _gains(quads: Ints, excess: Ints, free: Mask) -> Ints:
    """Return (q,): how much Σ excess² + costs falls when the diagonal 0–2 is turned to 1–3."""
    a, b, c, d = excess[quads].T
    fixed = ~free[quads]
    now = (fixed[:, 0] & fixed[:, 2]).astype(np.int64)
    then = (fixed[:, 1] & fixed[:, 3]).astype(np.int64)
    gains: Ints = 2 * (a + c - b - d) - 4 + FIXED_DIAGONAL * (now - then)
    return gains


def _independent(quads: Ints, gains: Ints) -> Mask:
    """Choose quads with a positive gain of which no two share a vertex, the best ones first."""
    order = np.argsort(-gains, kind="stable")
    rank = np.empty(len(quads), dtype=np.int64)
    rank[order] = np.arange(len(quads))
    rank[gains <= 0] = len(quads)
    first = np.full(int(quads.max(initial=-1)) + 1, len(quads), dtype=np.int64)
    np.minimum.at(first, quads, rank[:, None])
    chosen: Mask = (first[quads] == rank[:, None]).all(axis=1) & (gains > 0)
    return chosen
