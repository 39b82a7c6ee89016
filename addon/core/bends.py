"""By how much a surface bends at its edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints
from .vectors import area_vectors, unit


@dataclass(frozen=True)
class Bends:
    """The k edges between two triangles."""

    edges: Ints  # (k, 2) vertices, the smaller number first; ordered
    degrees: Floats  # (k,) between the two normals, convex above 0; 0 where a triangle has no area


def bends(points: Floats, triangles: Ints) -> Bends:
    """Return the edges that two of the triangles (m, 3) share, in the winding of the first, with their bends.

    points: (q, 3). Edges are the same, in the same order, whatever the points are.
    """
    normals = unit(area_vectors(points, triangles))
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    order = np.lexsort(sides.T)
    pairs = np.flatnonzero((sides[order[1:]] == sides[order[:-1]]).all(axis=1))
    first, second = order[pairs], order[pairs + 1]
    left, right = normals[first % len(triangles)], normals[second % len(triangles)]
    opposite = points[triangles.T[[2, 0, 1]].ravel()[second]]
    above = ((opposite - points[sides[first, 0]]) * left).sum(axis=1) > 0.0
    angles = np.degrees(np.arccos(np.clip((left * right).sum(axis=1), -1.0, 1.0)))
    known = (left != 0.0).any(axis=1) & (right != 0.0).any(axis=1)
    return Bends(sides[first], np.where(known, np.where(above, -angles, angles), 0.0))
