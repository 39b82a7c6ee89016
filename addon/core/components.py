"""The pieces of a patch that are solved each on its own. Plain numpy, no bpy.

A piece ends at its outline and at curves of fixed vertices inside, as in the engine (its
`find_cut_edges`): pinned loops split a selection.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints, Mask
from .region import Patch


@dataclass(frozen=True)
class Component:
    """One piece with at least one free vertex."""

    triangles: Ints  # rows of patch.triangles, ascending
    outline: Ints  # patch indices of the vertices it ends at, ascending


def connected(count: int, pairs: Ints) -> Ints:
    """Return (count,) labels, the lowest member of each group that the pairs (k, 2) connect."""
    label = np.arange(count)
    while True:
        lowest = label[pairs].min(axis=1)
        following = label.copy()
        np.minimum.at(following, label[pairs].ravel(), np.repeat(lowest, 2))
        np.minimum.at(following, pairs.ravel(), np.repeat(lowest, 2))
        following = following[following]  # pointer jumping: steps ~ log of the diameter
        if np.array_equal(following, label):
            return label
        label = following


def triangle_edges(triangles: Ints) -> Ints:
    """Return the (3m, 2) edges of triangles (m, 3), ends ascending; row 3t + k is side k of t."""
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges: Ints = np.sort(sides, axis=1)
    return edges


def _neighbours(triangles: Ints) -> tuple[Ints, Ints]:
    """Return the (k, 2) pairs of triangles that share an edge, and the (k, 2) ends of these edges."""
    edges = triangle_edges(triangles)
    order = np.lexsort((edges[:, 0], edges[:, 1]))
    same = (edges[order[1:]] == edges[order[:-1]]).all(axis=1)
    first, second = order[:-1][same], order[1:][same]
    return np.stack([first // 3, second // 3], axis=1), edges[first]


def _open(patch: Patch, pairs: Ints, ends: Ints, free: Mask) -> Mask:
    """Tell which pairs belong together: not cut, or the corner that a chord cuts off the border."""
    fixed_corner = ~free[patch.triangles].any(axis=1)
    inner = np.bincount(pairs.ravel(), minlength=len(patch.triangles))
    corner = fixed_corner & (inner == 1)
    joined: Mask = free[ends].any(axis=1) | corner[pairs].any(axis=1)
    return joined


def components(patch: Patch) -> tuple[Component, ...]:
    """Return the pieces of the patch that have free vertices, in the order of their triangles."""
    free = np.zeros(len(patch.vertices), dtype=bool)
    free[patch.free] = True
    pairs, ends = _neighbours(patch.triangles)
    label = connected(len(patch.triangles), pairs[_open(patch, pairs, ends, free)])
    solvable = np.unique(label[free[patch.triangles].any(axis=1)])
    return tuple(_component(patch, np.flatnonzero(label == root)) for root in solvable)


def _component(patch: Patch, triangles: Ints) -> Component:
    edges = triangle_edges(patch.triangles[triangles])
    numbers, counts = np.unique(edges[:, 0] * len(patch.vertices) + edges[:, 1], return_counts=True)
    return Component(triangles, np.unique(np.divmod(numbers[counts == 1], len(patch.vertices))))


def outline_radius(points: Floats) -> float:
    """Return the RMS distance of the points (k, 3) from their centroid."""
    return float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))
