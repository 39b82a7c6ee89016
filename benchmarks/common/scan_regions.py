"""Regions of scans of any size: meshes of shared/data, subdivided, with noise on all vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

import fairing
import measures
from polygons import read_polygons, triangles_of
from real_meshes import DATA
from tetrathing import subdivided

MESHES = {"ict_head": 2752, "demosthenes-low-res": 3323}  # seed vertices of the regions, kept by subdivision
LARGEST = (0, 0, 10_000, 60_000)  # vertices of a region after so many subdivisions
FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Region:
    """vertices (n, 3), triangles (m, 3), fixed (k,) and their normals (k, 3), fitted to the faces outside."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray


def scan(name: str, wanted: int) -> tuple[FloatArray, IntArray]:
    """The mesh, subdivided as often as it takes to have regions of that size."""
    vertices, polygons = read_polygons(DATA / f"{name}.obj")
    triangles = np.asarray(triangles_of(polygons), dtype=np.int64)
    for _ in range(sum(wanted > most for most in LARGEST)):
        triangles, ends = subdivided(triangles, len(vertices))
        vertices = np.vstack([vertices, 0.5 * (vertices[ends[:, 0]] + vertices[ends[:, 1]])])
    return vertices, triangles


def shaken(vertices: FloatArray, triangles: IntArray, noise: float) -> FloatArray:
    """All vertices moved at random, by `noise` mean edges (standard deviation of each coordinate)."""
    ends = measures.edges(triangles)
    edge = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1).mean()
    return np.asarray(vertices + noise * edge * np.random.default_rng(7).normal(size=vertices.shape) / np.sqrt(3))


def region(vertices: FloatArray, triangles: IntArray, seed: int, wanted: int) -> Region:
    """The triangles whose corners are the `wanted` vertices nearest to the seed along edges."""
    ends = measures.edges(triangles)
    lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    graph = coo_array((lengths, (ends[:, 0], ends[:, 1])), shape=(len(vertices),) * 2).tocsr()
    away = dijkstra(graph, directed=False, indices=seed)
    chosen = (away <= np.sort(away)[wanted])[triangles].all(axis=1)
    chosen = _without_pinches(triangles, chosen)
    inside, outside = triangles[chosen], triangles[~chosen]
    used = np.unique(inside)
    number = np.full(len(vertices), -1)
    number[used] = np.arange(len(used))
    held = np.zeros(len(vertices), dtype=bool)
    held[outside] = True
    held[measures.border_edges(triangles)] = True
    fixed = used[held[used]]
    normals = np.array(fairing.surrounding_normals(vertices, outside, fixed).normals)
    missing = np.linalg.norm(normals, axis=1) < 0.5
    normals[missing] = fairing.vertex_normals(vertices, triangles)[fixed[missing]]
    return Region(vertices[used], number[inside], number[fixed], normals)


def _without_pinches(triangles: IntArray, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Drops triangles at vertices where the region meets itself in a point."""
    while True:
        border = measures.border_edges(triangles[chosen])
        often = np.flatnonzero(np.bincount(np.ravel(border)) > 2)
        if not len(often):
            return chosen
        chosen = chosen & ~np.isin(triangles, often).any(axis=1)


def scan_region(name: str, noise: float, wanted: int, seed: int | None = None) -> Region:
    """A disc of about that many vertices round a seed vertex (by default the mesh's), with noise in edges."""
    vertices, triangles = scan(name, wanted)
    return region(shaken(vertices, triangles, noise), triangles, MESHES[name] if seed is None else seed, wanted)
