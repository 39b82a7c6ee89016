"""Meshes of polygons, as they stand in OBJ files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from curves import FloatArray
from meshing import IntArray

Polygons = list[list[int]]


def read_polygons(path: Path) -> tuple[FloatArray, Polygons]:
    """Vertices (n, 3) and polygons of an OBJ file, indices from 0."""
    vertices, polygons = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(x) for x in words[1:4]])
        elif words[:1] == ["f"]:
            polygons.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return np.array(vertices), polygons


def triangles_of(polygons: Polygons) -> IntArray:
    """Fans round the first corner, (m, 3)."""
    fans = [(p[0], p[k], p[k + 1]) for p in polygons for k in range(1, len(p) - 1)]
    return np.array(fans, dtype=np.int64).reshape(-1, 3)


def edges_of(polygons: Polygons, unique: bool = True) -> IntArray:
    """Edges (e, 2), smaller index first: each once, or in the order of the corners."""
    ends = [(min(a, b), max(a, b)) for p in polygons for a, b in zip(p, p[1:] + p[:1], strict=True)]
    edges = np.array(ends, dtype=np.int64).reshape(-1, 2)
    return np.unique(edges, axis=0) if unique else edges
