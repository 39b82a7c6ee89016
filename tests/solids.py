"""Closed solids with hard edges, and coarse ones without."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Solid = tuple[FloatArray, IntArray]  # vertices (n, 3), triangles (m, 3), counter-clockwise from outside


def box(n: int) -> Solid:
    """[−1, 1]³, n × n quads on each side, all cut the same way."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    faces = []
    for axis in range(3):
        for sign in (0, 1):
            corners = np.empty((len(i), 4, 3), dtype=np.int64)
            corners[..., axis] = sign * n
            corners[..., (axis + 1) % 3] = i[:, None] + (0, 1, 1, 0)
            corners[..., (axis + 2) % 3] = j[:, None] + (0, 0, 1, 1)
            faces.append(corners if sign else corners[:, ::-1])
    places, index = np.unique(np.concatenate(faces).reshape(-1, 3), axis=0, return_inverse=True)
    square = index.reshape(-1, 4)
    return 2.0 * places / n - 1.0, np.concatenate([square[:, [0, 1, 2]], square[:, [0, 2, 3]]])


def _ring(sides: int, radius: float, height: float) -> FloatArray:
    turns = 2 * np.pi * np.arange(sides) / sides
    return np.column_stack([radius * np.cos(turns), radius * np.sin(turns), np.full(sides, height)])


def _revolved(rings: list[FloatArray], bottom: float, top: float) -> Solid:
    """Quads between rings of one size, each cut in two, and fans over both ends."""
    sides = len(rings[0])
    vertices = np.concatenate([*rings, [[0, 0, bottom], [0, 0, top]]])
    around, last = np.arange(sides), sides * (len(rings) - 1)
    after = (around + 1) % sides
    faces = []
    for start in range(0, last, sides):
        a, b = start + around, start + after
        faces += [np.column_stack([a, b, b + sides]), np.column_stack([a, b + sides, a + sides])]
    ends = np.full(sides, len(vertices) - 2)
    faces += [np.column_stack([ends, after, around]), np.column_stack([ends + 1, last + around, last + after])]
    return vertices, np.concatenate(faces)


def cylinder(sides: int, rows: int, height: float) -> Solid:
    """Radius 1, z from 0 to height, fans as lids."""
    return _revolved([_ring(sides, 1.0, height * k / rows) for k in range(rows + 1)], 0.0, height)


def sphere(meridians: int, parallels: int) -> Solid:
    """Radius 1; `parallels` rows of faces."""
    polar = np.pi * (1 - np.arange(1, parallels) / parallels)
    return _revolved([_ring(meridians, np.sin(t), np.cos(t)) for t in polar], -1.0, 1.0)
