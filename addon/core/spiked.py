"""Starts whose own shape is no texture to keep: a vertex was pulled far out, or all of it is crumpled."""

from __future__ import annotations

import numpy as np

import fairing

from .around import nearby
from .arrays import Floats, Ints, Mask
from .region import MeshArrays, vertices_of

SPIKED = 1.6  # height over the edges around: scans, CAD and characters have up to 1.3, a spike of three edges has 2.7
# By the median height: of 180 random patches of 14 meshes none is crumpled, with noise of a tenth of an edge one in 25
# is, of a quarter five in six, of a half all.
CRUMPLED = 0.25
MORE_THAN_AROUND = 2.0  # a scan that is as rough everywhere has a texture all the same


def is_spoilt(mesh: MeshArrays) -> bool:
    """Return whether the patch is spiked or crumpled."""
    inside = vertices_of(mesh, mesh.in_patch) & ~vertices_of(mesh, ~mesh.in_patch)
    found = heights(mesh.positions, mesh.triangles[mesh.in_patch[mesh.triangle_faces]])[inside]
    if not len(found):
        return False
    return bool((found > SPIKED).any()) or _is_crumpled(mesh, float(np.median(found)))


def _is_crumpled(mesh: MeshArrays, height: float) -> bool:
    """Return whether the median height of the patch is beyond what is usual, and beyond what is usual around it."""
    if height < CRUMPLED:
        return False
    border = vertices_of(mesh, mesh.in_patch) & vertices_of(mesh, ~mesh.in_patch)
    outside = mesh.triangles[~mesh.in_patch[mesh.triangle_faces]]
    edges, uses = fairing.edges_with_uses(outside)  # at an open border heights say nothing
    beside = np.setdiff1d(nearby(outside, border), edges[uses == 1])
    with np.errstate(invalid="ignore", over="ignore"):  # far away
        others = heights(mesh.positions, outside)[beside]
    others = others[np.isfinite(others)]
    return not len(others) or height > MORE_THAN_AROUND * float(np.median(others))


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
