"""What a surface has lost of the shape that it belongs to: its girth, its rim, the shape of a key."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..arrays.harmonic import harmonic
from ..arrays.region import nothing
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem

MOST_MOVED = 0.04  # of the selection's size: by how much an open border may move in the mean
MOST_OF_A_KEY = 0.05  # of the selection's size: by how much a key may stand off what its surroundings make of it


@dataclass(frozen=True)
class Lost:
    """What is gone, and where; mesh vertices."""

    border: Ints = field(default_factory=nothing)  # of an open border that has moved far
    key: Ints = field(default_factory=nothing)  # where a shape key that is shown has kept a shape of its own


def moved_border(problem: Problem, after: Floats) -> Ints:
    """Return the mesh vertices of an open border inside that has moved far, as a whole; after: (q, 3)."""
    patch = problem.patch
    border = np.intersect1d(patch.boundary, patch.free)
    if not len(border):
        return nothing()
    own = problem.own_points
    distances = np.linalg.norm(after[border] - own[border], axis=1)
    return patch.vertices[border] if distances.mean() > MOST_MOVED * np.ptp(own, axis=0).max() else nothing()


def kept_key(problem: Problem, after: Floats, offsets: Floats | None) -> Ints:
    """Return the mesh vertices where the keys that are shown, (n, 3) off the mesh, have a shape of their own.

    after: (q, 3). On a fair surface the offsets of a fair key run from those of the boundary as smoothly as heat does.
    """
    patch = problem.patch
    if offsets is None or not len(patch.free) or len(offsets) <= patch.vertices.max():  # images have no keys
        return nothing()
    given = offsets[patch.vertices]
    order = np.concatenate([patch.fixed, patch.free])
    number = np.empty(len(order), dtype=np.int64)
    number[order] = np.arange(len(order))
    smooth = harmonic(after[order], number[patch.triangles], given[patch.fixed])
    apart = np.linalg.norm(given[patch.free] - smooth, axis=1)
    far = apart > MOST_OF_A_KEY * np.ptp(problem.own_points, axis=0).max()
    found: Ints = patch.vertices[patch.free[far]]
    return found
