"""Starts whose own shape is no texture to keep: a vertex was pulled far out of the surface, and its faces with it."""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints, Mask
from .region import MeshArrays, vertices_of

SPIKED = 1.6  # height over the edges around: scans, CAD and characters have up to 1.3, a spike of three edges has 2.7


def is_spiked(mesh: MeshArrays) -> bool:
    """Tell whether a vertex inside the patch stands out of the surface by more than the edges around it are long."""
    inside = vertices_of(mesh, mesh.in_patch) & ~vertices_of(mesh, ~mesh.in_patch)
    triangles = mesh.triangles[mesh.in_patch[mesh.triangle_faces]]
    return bool((heights(mesh.positions, triangles) > SPIKED)[inside].any())


def heights(points: Floats, triangles: Ints) -> Floats:
    """Return (n,): how far each vertex is from the mean of its neighbours, in mean lengths of the edges opposite to it.

    points: (n, 3); triangles: (m, 3). 0 for what is in no triangle, and where the edges opposite have no length.
    """
    count = len(points)
    uses = np.bincount(triangles.ravel(), minlength=count).clip(min=1)
    # In a closed ring of triangles each neighbour counts twice, and so does not matter.
    means = np.zeros((count, 3))
    lengths = np.zeros(count)
    for corner, left, right in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        at, ends = triangles[:, corner], (points[triangles[:, left]], points[triangles[:, right]])
        for axis in range(3):
            means[:, axis] += np.bincount(at, weights=0.5 * (ends[0] + ends[1])[:, axis], minlength=count)
        lengths += np.bincount(at, weights=np.linalg.norm(ends[0] - ends[1], axis=1), minlength=count)
    used: Mask = lengths > 0.0
    away = np.linalg.norm(points - means / uses[:, None], axis=1)
    found: Floats = np.where(used, away, 0.0) / np.where(used, lengths / uses, 1.0)
    return found
