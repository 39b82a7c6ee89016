"""Patches of exact sides through which hard edges run, thrown about: with those edges made fair again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import creased
import fairing
import measures
from hard_holes import FloatArray, IntArray

Side = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Dented:
    """All but the patch's inner vertices and edges are exact; the vertices of `curve` are where fair_edges has them."""

    vertices: FloatArray
    patch: IntArray
    fixed: IntArray  # ascending: its outline, and the curve
    normals: FloatArray  # at these
    curve: IntArray  # the vertices of hard edges within, with those where they enter
    edges: IntArray  # (h, 2) the hard edges between them
    sides: tuple[Side, ...]
    """Distances of points (k, 3) to the surfaces that meet."""

    @property
    def edge(self) -> float:
        """The mean length of the patch's edges."""
        ends = self.vertices[measures.edges(self.patch)]
        return float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean())

    def error(self, points: FloatArray) -> float:
        """The largest distance to the nearest side, over the size of the box around the outline."""
        outline = np.setdiff1d(self.fixed, self.curve)
        size = np.linalg.norm(np.ptp(self.vertices[outline], axis=0))
        return float(np.min([side(points) for side in self.sides], axis=0).max() / size)


def dented(
    vertices: FloatArray, triangles: IntArray, sides: tuple[Side, ...], centre: tuple[float, ...], radius: float
) -> Dented:
    """The patch within a ball, thrown about by a twentieth of its edges."""
    inside = (np.linalg.norm(vertices - centre, axis=1) < radius)[triangles].all(axis=1)
    patch, outside = triangles[inside], triangles[~inside]
    outline = np.unique(np.concatenate(fairing.boundary_loops(patch)))
    moving = np.setdiff1d(patch, outline)
    on = np.array([side(vertices) < 1e-9 for side in sides])
    edges = measures.edges(triangles)
    edges = edges[np.count_nonzero(on[:, edges].all(axis=2), axis=0) > 1]
    within = np.isin(edges, moving).any(axis=1)
    normals = fairing.boundary_normals(vertices, patch, outline, outside=outside, creases=edges).normals
    ends = vertices[measures.edges(patch)]
    thrown = vertices.copy()
    thrown[moving] += 0.2 * np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean() * noise(len(moving))
    faired = fairing.fair_edges(thrown, edges[within], edges[~within])
    curve = np.unique(np.concatenate(faired.curves))
    fixed = np.union1d(outline, curve)
    at_fixed = np.tile([0.0, 0.0, 1.0], (len(fixed), 1))
    at_fixed[np.isin(fixed, outline)] = normals
    return Dented(faired.vertices, patch, fixed, at_fixed, curve, edges[within], sides)


def noise(count: int) -> FloatArray:
    """(count, 3), of mean square 1."""
    return np.random.default_rng(0).normal(size=(count, 3))


def box_edge(n: int, seed: int) -> Dented:
    exact = creased.box_edge(n, seed)
    return dented(exact.vertices, exact.triangles, exact.distances, (0.0, 0.5, 0.0), 0.35)


def box_corner(n: int, seed: int) -> Dented:
    exact = creased.box_corner(n, seed)
    return dented(exact.vertices, exact.triangles, exact.distances, (0.0, 0.0, 0.0), 0.6)


def lid_rim(rings: int, seed: int) -> Dented:
    exact = creased.lid(rings, seed)
    return dented(exact.vertices, exact.triangles, exact.distances, (1.0, 0.0, 0.0), 0.5)


def bent_sheet(n: int, seed: int, bend: float = 0.5) -> Dented:
    """The box edge with z shifted by bend · (y − ½)²."""
    exact = creased.box_edge(n, seed)
    height = lambda points: bend * (points[:, 1] - 0.5) ** 2  # noqa: E731
    vertices = exact.vertices.copy()
    vertices[:, 2] += height(vertices)

    def above(points: FloatArray) -> FloatArray:
        slope = 2 * bend * (points[:, 1] - 0.5)
        return np.abs(points[:, 2] - height(points)) / np.sqrt(1 + slope**2)

    return dented(
        vertices, exact.triangles, (above, lambda points: np.abs(points[:, 0])), (0.0, 0.5, 0.0), 0.3
    )  # fmt: skip
