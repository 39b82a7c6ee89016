"""How far a surface is from another one."""

from __future__ import annotations

import numpy as np
from mathutils.bvhtree import BVHTree

from ..arrays.types import Floats, Ints


def deviation(points: Floats, surface: Floats, triangles: Ints) -> Floats:
    """Return the distances (k,) of points (k, 3) from a surface, positive on the side of its normals.

    surface (n, 3), triangles (t, 3). 0 where there is no surface.
    """
    tree = BVHTree.FromPolygons(surface.tolist(), triangles.tolist(), all_triangles=True)
    found = np.zeros(len(points))
    for k, point in enumerate(points.tolist()):
        place, normal, _, distance = tree.find_nearest(point)
        if place is not None:
            above = sum((p - q) * n for p, q, n in zip(point, place, normal, strict=True)) >= 0.0
            found[k] = distance if above else -distance
    return found
