"""A surface over half of a symmetric hole, and its image. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints
from .symmetry import FLIP


def doubled_places(positions: Floats, on_plane: int) -> Floats:
    """Return the places of the new vertices of both sides, in the mesh's own coordinates.

    positions: (k, 3) those of the half, of which the first `on_plane` are shared and get x = 0.
    """
    shared = positions[:on_plane] * [0.0, 1.0, 1.0]
    return np.concatenate([shared, positions[on_plane:], positions[on_plane:] * FLIP])


def doubled_triangles(triangles: Ints, chain: int, on_plane: int) -> Ints:
    """Return the triangles of both sides, in numbers of the whole boundary and then of the new vertices of both.

    triangles: in numbers of the half's boundary, a chain of so many, of the new vertices on the plane, and of others.
    """
    count = int(triangles.max()) + 1
    loop = 2 * chain - 2
    own = np.arange(count)
    own[chain:] += loop - chain
    image = own.copy()
    image[1 : chain - 1] = loop - np.arange(1, chain - 1)
    image[chain + on_plane :] += count - chain - on_plane
    return np.concatenate([own[triangles], image[triangles][:, ::-1]])
