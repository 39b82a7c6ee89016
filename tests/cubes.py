"""Grids of quads on a cube blown up to a sphere: four extraordinary vertices on its upper half."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class CubeCap:
    """The part of the unit sphere above its equator, each quad cut in two the same way.

    vertices (n, 3), also the exact normals; triangles (m, 3), counter-clockwise from outside; fixed (k,) the border.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    fixed: NDArray[np.int64]


def cube_cap(quads: int) -> CubeCap:
    """`quads`, even: along an edge of the cube. About 1.5 quads² free vertices."""
    steps = np.arange(quads)
    u, v = (a.ravel() for a in np.meshgrid(steps, steps, indexing="ij"))
    faces = []
    for axis in range(3):
        for sign in (0, 1):
            corners = np.empty((len(u), 4, 3), dtype=np.int64)
            corners[..., axis] = sign * quads
            corners[..., (axis + 1) % 3] = u[:, None] + (0, 1, 1, 0)
            corners[..., (axis + 2) % 3] = v[:, None] + (0, 0, 1, 1)
            faces.append(corners if sign else corners[:, ::-1])
    quad_corners = np.concatenate(faces)
    places, index = np.unique(quad_corners.reshape(-1, 3), axis=0, return_inverse=True)
    square = index.reshape(-1, 4)
    triangles = np.concatenate([square[:, [0, 1, 2]], square[:, [0, 2, 3]]])
    above = places[:, 2] > quads // 2
    triangles = triangles[above[triangles].any(axis=1)]
    used, compact = np.unique(triangles, return_inverse=True)
    points = 2.0 * places[used] / quads - 1.0
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return CubeCap(points, compact.reshape(-1, 3), np.flatnonzero(~above[used]))
