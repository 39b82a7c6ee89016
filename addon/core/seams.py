"""Seams of doubled vertices inside a patch, which stay where they are: what they held shows as a crest."""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints
from .bends import bends
from .region import Patch

OWN = 2.0  # times the degrees from which a kink is seen: the surface's own bend is in these, and normals there are poor


def seam_kinks(patch: Patch, points: Floats, limit: float) -> Ints:
    """Return the mesh vertices of seams across which the surface bends visibly; kinks show from `limit` degrees.

    points: (p, 3) after; vertices of the patch's border that stay in one place are one.
    """
    held = np.intersect1d(patch.fixed, patch.outline)
    places, place, uses = np.unique(points[held], axis=0, return_inverse=True, return_counts=True)
    if len(places) == len(held):
        return held[:0]
    doubled = np.zeros(len(points) + len(places), dtype=bool)
    doubled[len(points) :] = uses > 1
    number = np.arange(len(points))
    number[held] = len(points) + place.reshape(-1)
    joined = bends(np.concatenate([points, places]), number[patch.triangles])
    seen = doubled[joined.edges].all(axis=1) & (np.abs(joined.degrees) > OWN * limit)
    kinked: Ints = patch.vertices[np.isin(number, joined.edges[seen])]
    return kinked
