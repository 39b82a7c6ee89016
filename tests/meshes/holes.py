"""Exact surfaces with a hole cut into them, for `fairing.fill`."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mesh = tuple[FloatArray, IntArray]


def bowl(edges: int, half_angle: float = 90.0) -> Mesh:
    """The unit sphere without the cap of this half-angle (degrees) around the north pole; `edges` at the rim.

    Rings of vertices at about the rim's spacing, triangles counter-clockwise from outside; the rim comes first.
    """
    half = np.radians(half_angle)
    rows = max(2, round((np.pi - half) / (2 * np.pi * np.sin(half) / edges)))
    ring = np.arange(edges)
    after = (ring + 1) % edges
    vertices, triangles = [], []
    for row in range(rows):
        polar, turn = half + (np.pi - half) * row / rows, 2 * np.pi * (ring + 0.5 * (row % 2)) / edges
        radius, height = np.sin(polar), np.full(edges, np.cos(polar))
        vertices.append(np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height]))
        a, b = row * edges, (row + 1) * edges
        if row == rows - 1:
            triangles.append(np.column_stack([a + ring, np.full(edges, b), a + after]))
        elif row % 2:
            triangles += [np.column_stack([a + ring, b + ring, b + after]),
                          np.column_stack([a + ring, b + after, a + after])]  # fmt: skip
        else:
            triangles += [np.column_stack([a + ring, b + ring, a + after]),
                          np.column_stack([a + after, b + ring, b + after])]  # fmt: skip
    return np.concatenate([*vertices, [[0.0, 0.0, -1.0]]]), np.concatenate(triangles)


def sheet(
    place: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]],
    cells: tuple[int, int],
    hole: Callable[[FloatArray, FloatArray], NDArray[np.bool_]],
    *,
    closed: bool = False,
) -> Mesh:
    """Triangles over a jittered grid of u and v in [0, 1], without those whose cell's centre lies in the hole.

    `place` gives x, y, z of u and v; `closed`: u = 1 is u = 0.
    """
    n, m = cells
    columns = n if closed else n + 1
    u, v = (index.ravel() for index in np.mgrid[:columns, : m + 1])
    inner = (v > 0) & (v < m) & (closed | ((u > 0) & (u < n)))
    jitter = 0.2 * np.random.default_rng(0).uniform(-1, 1, (2, len(u))) * inner
    points = np.column_stack(place((u + jitter[0]) / n, (v + jitter[1]) / m))
    i, j = (index.ravel() for index in np.mgrid[:n, :m])
    a, b = i * (m + 1) + j, (i + 1) % columns * (m + 1) + j
    triangles = np.concatenate([np.column_stack([a, b, b + 1]), np.column_stack([a, b + 1, a + 1])])
    outside = ~hole((i + 0.5) / n, (j + 0.5) / m)
    return points, triangles[np.tile(outside, 2)]


def disc(u: FloatArray, v: FloatArray) -> NDArray[np.bool_]:
    """A hole in the middle of a sheet."""
    return np.asarray((u - 0.5) ** 2 + (v - 0.5) ** 2 < 0.09)


def band(u: FloatArray, v: FloatArray) -> NDArray[np.bool_]:
    """The middle half of a closed sheet."""
    return np.asarray(np.abs(v - 0.5) + 0 * u < 0.25)


def angles(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """(m, 3) degrees at the corners."""
    corners = vertices[triangles]
    forth = np.roll(corners, -1, axis=1) - corners
    back = np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(forth, back), axis=2)
    return np.degrees(np.arctan2(sine, (forth * back).sum(axis=2)))


def cylinder_side(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return np.cos(2.4 * u), np.sin(2.4 * u), 2.4 * v


def saddle(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    height = 1.6 * v - 0.8
    return np.cosh(height) * np.cos(2 * u), np.cosh(height) * np.sin(2 * u), height


def torus(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    radius, turn = 2 + 0.7 * np.cos(2 * v - 1), 0.8 * u
    return radius * np.cos(turn), radius * np.sin(turn), 0.7 * np.sin(2 * v - 1)


def tube(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 3 * v - 1.5


def catenoid(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    height = 2 * v - 1
    return np.cosh(height) * np.cos(2 * np.pi * u), np.cosh(height) * np.sin(2 * np.pi * u), height
