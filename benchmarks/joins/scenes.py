"""Patches in surroundings that no tangent join continues without an elbow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing
from engine import FloatArray
from meshing import IntArray
from stripes import View, facing

PIXELS = 600  # of a picture's side, which is drawn twice as fine


@dataclass(frozen=True)
class Scene:
    """vertices (n, 3); triangles within and around the patch; how it is looked at."""

    name: str
    vertices: FloatArray
    inside: IntArray
    outside: IntArray
    view: View

    def solved(self, continuity: str) -> fairing.FairResult:
        """From normals, and curvatures, that are fitted to what lies outside."""
        outline = np.intersect1d(self.inside, self.outside)
        normals = fairing.surrounding_normals(self.vertices, self.outside, outline).normals
        return fairing.fair(
            self.vertices, self.inside, fixed=outline, fixed_normals=normals, outside=self.outside,
            continuity=continuity, threads=1,
        )  # fmt: skip

    def drawn(self) -> IntArray:
        """All triangles."""
        return np.concatenate([self.inside, self.outside])


def _grid(rows: int, columns: int, closed: bool) -> IntArray:
    """Triangles of a grid of vertices numbered row by row, by alternating diagonals."""
    row, column = (part.ravel() for part in np.mgrid[: rows - 1, : columns if closed else columns - 1])
    a, b = row * columns + column, row * columns + (column + 1) % columns
    c, d = b + columns, a + columns
    even = ((row + column) % 2 == 0)[:, None]
    first = np.where(even, np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    second = np.where(even, np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return np.concatenate([first, second]).astype(np.int32)


def joint(around: int = 144) -> Scene:
    """A cylinder of radius ½ that stands on one of radius 1: the blend between them."""
    angle = 2 * np.pi * np.arange(around) / around
    far = np.linspace(2.2, 1.05, 30)
    wide = [_on_cylinder(r * np.cos(angle), r * np.sin(angle)) for r in far]
    heights = np.linspace(1.7, 2.6, 26)
    narrow = [np.stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), np.full(around, z)], 1) for z in heights]
    between = [wide[-1] + t * (narrow[0] - wide[-1]) for t in np.linspace(0, 1, 27)[1:-1]]
    vertices = np.concatenate(wide + between + narrow)
    triangles = _grid(len(vertices) // around, around, True)
    row = triangles.min(axis=1) // around
    within = (row >= len(wide) - 1) & (row < len(wide) + len(between))
    view = facing(np.array([1.0, -1.6, 0.75]), np.array([0.0, 0.0, 1.35]), 1.6, 2 * PIXELS)
    return Scene("joint", vertices, triangles[within], triangles[~within], view)


def panel(size: int = 60) -> Scene:
    """A crowned panel of a car; the patch is an oval whose outline runs in steps along the grid."""
    x, y = (part.ravel() for part in np.meshgrid(*2 * [np.linspace(-1, 1, size + 1)], indexing="ij"))
    crown = -0.25 * x**2 - 0.12 * y**2 - 0.3 * x**3 + 0.15 * x * y**2 - 0.2 * x**4
    triangles = _grid(size + 1, size + 1, False)[:, ::-1]
    row, column = np.tile(np.mgrid[:size, :size].reshape(2, -1), 2)
    middle = (np.stack([row, column], 1) + 0.5) * 2 / size - 1
    within = (middle[:, 0] / 0.62) ** 2 + (middle[:, 1] / 0.5) ** 2 < 1
    view = facing(np.array([0.3, -1.0, 1.2]), np.array([0.0, 0.0, -0.1]), 0.95, 2 * PIXELS)
    return Scene("panel", np.stack([x, y, crown], 1), triangles[within], triangles[~within], view)


def ear() -> Scene:
    """Suzanne without an ear, as in the demo (needs bpy)."""
    import bpy

    import demo_scenes

    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = demo_scenes.suzanne().data
    chosen = demo_scenes.ear_faces(mesh)
    quads = [list(polygon.vertices) for polygon in mesh.polygons]
    fans = [(q[0], q[k], q[k + 1]) for q in quads for k in range(1, len(q) - 1)]
    within = np.repeat(chosen, [len(q) - 2 for q in quads])
    vertices = np.array([vertex.co for vertex in mesh.vertices], dtype=np.float64)
    triangles = np.array(fans)
    centre = vertices[np.intersect1d(triangles[within], triangles[~within])].mean(axis=0)
    view = facing(np.array([1.0, -0.55, 0.25]), centre, 0.75, 2 * PIXELS)
    return Scene("ear", vertices, triangles[within], triangles[~within], view)


def _on_cylinder(x: FloatArray, s: FloatArray) -> FloatArray:
    return np.stack([x, np.sin(s), np.cos(s)], 1)
