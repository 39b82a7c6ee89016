"""Small round holes that a fan around one new vertex closes: of five to eight edges, as long as the edges wanted.

A hub in the middle of a regular polygon of eight edges has spokes of 1.31 edges, below the 4/3 beyond which edges are
split. The equation is solved on the fan itself, for all such holes at once, without a finer mesh first.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairing._types import FloatArray, IntArray

_SPLIT = 4.0 / 3.0  # of the wanted length, here the mean of the loop's edges: longer edges are split
_LEAST_ANGLE = 26.0  # degrees, as in every new mesh


def takes_hub(points: FloatArray, normals: FloatArray, hub: FloatArray) -> bool:
    """Whether a fan around the hub (3,) is a good mesh over a loop (k, 3) with these normals."""
    if not 5 <= len(points) <= 8:
        return False
    after = np.roll(points, -1, axis=0)
    edges, spokes = after - points, points - hub
    long = np.linalg.norm(edges, axis=1)
    size = np.linalg.norm(spokes, axis=1)
    if not size.max() <= _SPLIT * long.mean():
        return False
    areas = np.cross(spokes, np.roll(spokes, -1, axis=0))
    if not (areas @ normals.sum(axis=0) > 0.0).all():
        return False
    sides = np.stack([long, size, np.roll(size, -1)])
    twice = np.linalg.norm(areas, axis=1)
    opposite = np.stack([sides[1] * sides[2], sides[0] * sides[2], sides[0] * sides[1]])
    return bool((twice >= np.sin(np.radians(_LEAST_ANGLE)) * opposite).all())


def fans(loops: Sequence[IntArray], first: int) -> IntArray:
    """The triangles between each loop and its hub; hubs are numbered from `first` on."""
    rows = [np.column_stack([loop, np.roll(loop, -1), np.full(len(loop), first + k)]) for k, loop in enumerate(loops)]
    triangles: IntArray = np.concatenate(rows).astype(np.int32)
    return triangles
