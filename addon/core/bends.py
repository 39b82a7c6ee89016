"""By how much a surface bends at its edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints
from .faces import inner_edges
from .vectors import area_vectors, unit


@dataclass(frozen=True)
class Bends:
    """The k edges between two triangles."""

    edges: Ints  # (k, 2) vertices, the smaller number first; ordered
    degrees: Floats  # (k,) between the two normals, convex above 0; 0 where a triangle has no area
    sides: Ints  # (k, 2) the two triangles


def bends(points: Floats, triangles: Ints) -> Bends:
    """Return the edges that two of the triangles (m, 3) share, in the winding of the first, with their bends.

    points: (q, 3). Edges are the same, in the same order, whatever the points are.
    """
    normals = unit(area_vectors(points, triangles))
    edges, sides = inner_edges(triangles)
    left, right = normals[sides[:, 0]], normals[sides[:, 1]]
    opposite = points[triangles[sides[:, 1]].sum(axis=1) - edges.sum(axis=1)]
    above = ((opposite - points[edges[:, 0]]) * left).sum(axis=1) > 0.0
    angles = np.degrees(np.arccos(np.clip((left * right).sum(axis=1), -1.0, 1.0)))
    known = (left != 0.0).any(axis=1) & (right != 0.0).any(axis=1)
    return Bends(edges, np.where(known, np.where(above, -angles, angles), 0.0), sides)
