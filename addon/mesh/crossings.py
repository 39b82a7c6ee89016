"""Triangles that run into each other."""

from __future__ import annotations

import numpy as np
from mathutils.bvhtree import BVHTree

from ..core.arrays import Floats, Ints


def intersections(positions: Floats, triangles: Ints) -> int:
    """Count the pairs of triangles without a common vertex that run into each other."""
    tree = BVHTree.FromPolygons(positions.tolist(), triangles.tolist(), all_triangles=True)
    found = np.array(tree.overlap(tree), dtype=np.int64).reshape(-1, 2)
    found = found[found[:, 0] < found[:, 1]]
    first, second = triangles[found[:, 0]], triangles[found[:, 1]]
    apart = (first[:, :, None] != second[:, None, :]).all(axis=(1, 2))
    return int(np.count_nonzero(apart))
