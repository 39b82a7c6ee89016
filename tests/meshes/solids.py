"""Closed solids with hard edges, and coarse ones without."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from grids import halves, numbered

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


def cube_cap(quads: int) -> tuple[FloatArray, IntArray, IntArray]:
    """The unit sphere above its equator as a cube blown up: vertices, which are the normals, triangles, the border.

    `quads`, even: along an edge of the cube. About 1.5 quads² free vertices; four have three neighbours of quads.
    """
    vertices, triangles = box(quads)
    above = vertices[:, 2] > 1e-9
    used, compact = np.unique(triangles[above[triangles].any(axis=1)], return_inverse=True)
    points = vertices[used] / np.linalg.norm(vertices[used], axis=1, keepdims=True)
    return points, compact.reshape(-1, 3), np.flatnonzero(~above[used])


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


def box_with_boss(sides: int) -> tuple[FloatArray, IntArray, IntArray]:
    """An undivided box, a round boss on its top: vertices, the triangles of the top and the boss, and the others."""
    corners = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    ring = _ring(sides, 0.4, 1.0)
    vertices = np.concatenate([
        np.column_stack([corners, np.ones(4)]), np.column_stack([corners, -np.ones(4)]),
        ring, _ring(sides, 0.4, 1.5), [[0, 0, 1.5]],
    ])  # fmt: skip
    k = np.arange(sides)
    low, after = 8 + k, 8 + (k + 1) % sides
    high, above = low + sides, after + sides
    quarter = sides // 4
    between = [[c, (c + 1) % 4, 8 + quarter * (c + 1) % sides] for c in range(4)]
    parts = [np.column_stack([k // quarter, after, low]), np.column_stack([low, after, above])]
    parts += [np.column_stack([low, above, high]), np.column_stack([np.full(sides, 8 + 2 * sides), high, above])]
    walls = [[c, 4 + c, 4 + (c + 1) % 4] for c in range(4)] + [[c, 4 + (c + 1) % 4, (c + 1) % 4] for c in range(4)]
    return vertices, np.concatenate([between, *parts]), np.array([*walls, [4, 6, 5], [4, 7, 6]])


def sphere(meridians: int, parallels: int) -> Solid:
    """Radius 1; `parallels` rows of faces."""
    polar = np.pi * (1 - np.arange(1, parallels) / parallels)
    return _revolved([_ring(meridians, np.sin(t), np.cos(t)) for t in polar], -1.0, 1.0)


@dataclass(frozen=True)
class Panel:
    """A bent panel with a crease of 45° beside a selection, and what is to go inside.

    clean, vertices (n, 3): without the crease, and with it and a dome inside; triangles inside and outside.
    """

    clean: FloatArray
    vertices: FloatArray
    inside: IntArray
    outside: IntArray

    @property
    def rim(self) -> IntArray:
        return np.intersect1d(self.inside, self.outside)

    @property
    def free(self) -> IntArray:
        return np.setdiff1d(self.inside, self.outside)

    @property
    def normals(self) -> FloatArray:
        """(n, 3) of the clean panel."""
        x, y, _ = self.clean.T
        across = np.column_stack([0.4 * x, 0.2 * y, np.ones_like(x)])
        return across / np.linalg.norm(across, axis=1)[:, None]

    def error(self, vertices: FloatArray) -> float:
        """Largest height of free vertices over the clean panel, over D."""
        x, y, z = vertices[self.free].T
        held = self.clean[self.rim]
        size = 2.0 * np.linalg.norm(held - held.mean(axis=0), axis=1).max()
        return float(np.abs(z + 0.2 * x**2 + 0.1 * y**2).max() / size)


def panel(rings: float, step: float = 0.05) -> Panel:
    """z = −.2 x² − .1 y², selected within |x| < .45 and |y| < .3; the crease runs so many rows beyond that.

    A dome stands in the middle of the selection.
    """
    x, y = (a.ravel() for a in np.meshgrid(step * np.arange(-20, 21), step * np.arange(-16, 17), indexing="ij"))
    clean = np.column_stack([x, y, -0.2 * x**2 - 0.1 * y**2])
    triangles = halves(numbered(41, 33))
    centre = np.abs(clean[triangles].mean(axis=1))
    inside = (centre[:, 0] < 0.45) & (centre[:, 1] < 0.3)
    vertices = clean.copy()
    vertices[:, 2] -= np.maximum(0.0, y - 0.3 - rings * step - 1e-12)
    away = np.hypot(x, y / 0.6)
    vertices[:, 2] += np.where(away < 0.3, 0.06 * np.exp(-((away / 0.12) ** 2)), 0.0)
    return Panel(clean, vertices, triangles[inside], triangles[~inside])
