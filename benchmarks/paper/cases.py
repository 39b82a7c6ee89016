"""The four cases of Table 1: two from generators, two from a real head where there is one.

The blend is that of the tests. The tetrathing's base has 48 vertices and 104 triangles: four pairs
of trousers, one at each corner of a tetrahedron, joined along a circle of four vertices round each
edge; subdivided four times. Ear and face are patches of a head grown around a vertex.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

import blend
import measures
import tetrathing as generator
from polygons import read_polygons

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
HEAD = Path(__file__).resolve().parents[3] / "shared" / "data" / "ict_head.obj"


@dataclass(frozen=True)
class Case:
    """A mesh to be faired. `seconds`, `base`: what Table 1 says (Java, 500 MHz)."""

    name: str
    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray
    base: int
    seconds: float
    options: dict[str, Any]

    @property
    def diameter(self) -> float:
        """Extent of the fixed vertices, for relative distances."""
        rim = self.vertices[self.fixed]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())


def cylinder_blend(jitter: float = 0.0, seed: int = 0, n_free: int = 824) -> Case:
    """Figs. 1, 2: three cylinders at 120°."""
    made = blend.cylinder_blend(n_free, jitter=jitter, seed=seed)
    return Case(
        "cylinder blend", made.vertices, made.triangles, made.fixed, made.fixed_normals,
        140, 1.9, {},
    )  # fmt: skip


def tetrathing() -> Case:
    """Fig. 8: closed, genus 3, held by a circle round each edge of a tetrahedron."""
    made = generator.tetrathing()
    return Case(
        "tetrathing", made.vertices, made.triangles, made.fixed, made.fixed_normals,
        308, 57.0, {},
    )  # fmt: skip


def quadrangulated(vertices: FloatArray, polygons: list[list[int]]) -> tuple[FloatArray, IntArray]:
    """Each polygon in quads round its centre, without smoothing."""
    points = vertices.tolist()
    middle: dict[tuple[int, int], int] = {}
    quads = []
    for polygon in polygons:
        halves = []
        for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(0.5 * (vertices[a] + vertices[b]))
            halves.append(middle[key])
        centre = len(points)
        points.append(vertices[polygon].mean(axis=0))
        quads += [(v, halves[k], centre, halves[k - 1]) for k, v in enumerate(polygon)]
    return np.array(points), np.array(quads)


def edge_distances(vertices: FloatArray, quads: IntArray, seed: int) -> FloatArray:
    """Shortest paths along the edges of the quads from the seed."""
    ends = np.vstack([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    graph = csr_array((lengths, tuple(ends.T)), shape=(len(vertices),) * 2)
    return np.asarray(dijkstra(graph.maximum(graph.T), indices=seed))


def head_patch(name: str, seed: int, size: int, base: int, seconds: float) -> Case:
    """The quads of the subdivided head within a distance of a vertex that `size` vertices fill.

    The normals at the outline average all adjacent triangles of the head, before the construction.
    """
    vertices, quads = quadrangulated(*read_polygons(HEAD))
    whole = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    normals = _averaged(vertices, whole)
    away = edge_distances(vertices, quads, seed)[quads].max(axis=1)
    order = np.argsort(away, kind="stable")
    low, high = 20, len(quads)
    while high - low > 1:
        middle = (low + high) // 2
        count = len(np.unique(_solid(quads[order[:middle]])))
        low, high = (middle, high) if count < size else (low, middle)
    patch = _solid(quads[order[:low]])
    used, local = np.unique(patch, return_inverse=True)
    local = local.reshape(-1, 4)
    faces = np.vstack([local[:, [0, 1, 2]], local[:, [0, 2, 3]]])
    points = vertices[used]
    fixed = np.unique(measures.border_edges(faces))
    options = {"inner_fairness": "conformal", "reference": points}
    return Case(name, points, faces, fixed, normals[used][fixed], base, seconds, options)


def _solid(quads: IntArray) -> IntArray:
    """Drops quads that hang on by one edge or a corner only."""
    while True:
        ends = np.sort(np.vstack([quads[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
        _, inverse, uses = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
        open_sides = (uses[inverse.ravel()] == 1).reshape(4, -1).sum(axis=0)
        if (open_sides < 3).all():
            return quads
        quads = quads[open_sides < 3]


def _averaged(points: FloatArray, triangles: IntArray) -> FloatArray:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None])


def all_cases() -> list[Case]:
    """In the order of Table 1; ear and face only where the head is."""
    cases = [cylinder_blend()]
    if HEAD.exists():
        cases.append(head_patch("face size, on the scalp", 10527, 2926, 256, 12.0))
        cases.append(head_patch("ear", 6893, 4665, 248, 21.0))
    return [*cases, tetrathing()]
