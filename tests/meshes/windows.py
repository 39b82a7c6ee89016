"""Window openings in cylinders and spheres of radius 1, with a noisy border."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

import measures
from curves import FloatArray
from grids import IntArray, halves, numbered

Kind = Literal["cylinder", "sphere"]


@dataclass(frozen=True)
class Window:
    """A ring-shaped patch (n, 3), (m, 3) around a window, held along its outer boundary or the part of it given."""

    kind: Kind
    vertices: FloatArray
    triangles: IntArray
    boundary: IntArray
    normals: FloatArray  # (k, 3) in its order
    border: IntArray  # of the window, those that move

    @property
    def moving(self) -> IntArray:
        return np.setdiff1d(np.arange(len(self.vertices)), self.boundary)

    @property
    def edge(self) -> float:
        """Mean length of all edges; those of the border are about half as long."""
        ends = self.vertices[measures.edges(self.triangles)]
        return float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean())

    @property
    def border_edge(self) -> float:
        loop = self.vertices[self.border]
        return float(np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1).mean())

    def noisy(self, amount: float, seed: int = 0, *, edge: float | None = None) -> FloatArray:
        """All that moves, thrown by a share of an edge (the mean one) along each axis, root mean square."""
        edge = self.edge if edge is None else edge
        result = self.vertices.copy()
        result[self.moving] += amount * edge * np.random.default_rng(seed).normal(size=(len(self.moving), 3))
        return result

    def off_surface(self, vertices: FloatArray) -> FloatArray:
        """(n,) distances to the exact surface."""
        axes = vertices[:, :2] if self.kind == "cylinder" else vertices
        return np.abs(np.linalg.norm(axes, axis=1) - 1.0)

    def off_border(self, vertices: FloatArray) -> float:
        """Largest distance of the border's vertices to the exact border."""
        loop = self.vertices[self.border]
        fine = np.concatenate([loop + s * (np.roll(loop, -1, axis=0) - loop) for s in np.linspace(0, 1, 9)[:-1]])
        return float(np.linalg.norm(vertices[self.border][:, None] - fine, axis=2).min(axis=1).max())


def window(kind: Kind, around: int, seed: int = 0, *, inner: float = 0.4, outer: float = 0.9) -> Window:
    """A round window in the chart (u, v); its border has `around` vertices."""
    rng = np.random.default_rng([seed, 8])
    growth = 1.0 + 2 * np.pi / around
    rows = max(3, round(np.log(outer / inner) / np.log(growth)))
    radius = np.repeat(inner * (outer / inner) ** (np.arange(rows + 1) / rows), around)
    angle = np.tile(2 * np.pi * np.arange(around) / around, rows + 1)
    between = np.repeat((np.arange(rows + 1) > 0) & (np.arange(rows + 1) < rows), around)
    angle = angle + between * 0.25 * 2 * np.pi / around * rng.uniform(-1, 1, len(angle))
    number = numbered(rows + 1, around)
    triangles = halves(np.column_stack([number, number[:, 0]]), rng)
    vertices = _mapped(kind, radius * np.cos(angle), radius * np.sin(angle))
    normals = vertices[number[-1]] * ([1.0, 1.0, 0.0] if kind == "cylinder" else 1.0)
    return Window(kind, vertices, triangles, number[-1], normals, number[0])


def _mapped(kind: Kind, u: FloatArray, v: FloatArray) -> FloatArray:
    if kind == "cylinder":
        return np.column_stack([np.cos(u), np.sin(u), v])
    return np.column_stack([np.sqrt(1.0 - u**2 - v**2), u, v])
