"""Interiors to start from: given, flattened, folded, noisy. The outline stays in its place."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine import FloatArray
from meshing import IntArray


def given(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """The mesh itself."""
    return vertices


def flattened(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Projected on the plane that fits the outline best."""
    rim = vertices[fixed]
    centre = rim.mean(axis=0)
    normal = np.linalg.svd(rim - centre)[2][2]
    return np.asarray(vertices - ((vertices - centre) @ normal)[:, None] * normal)


def folded(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Everything on one side of a plane through the centroid reflected to the other."""
    centre = vertices.mean(axis=0)
    normal = np.linalg.svd(vertices - centre, full_matrices=False)[2][0]
    height = (vertices - centre) @ normal
    return np.asarray(vertices - 2 * np.maximum(height, 0)[:, None] * normal)


def noisy(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Gaussian noise of two mean edge lengths."""
    return np.asarray(vertices + 2 * h * np.random.default_rng(5).standard_normal(vertices.shape))


STARTS: dict[str, Callable[[FloatArray, IntArray, float], FloatArray]] = {
    "given": given, "flattened": flattened, "folded": folded, "noisy": noisy,
}  # fmt: skip


def moved(kind: str, vertices: FloatArray, triangles: IntArray, fixed: IntArray) -> FloatArray:
    """The start of this kind, fixed vertices in their places."""
    edges = np.linalg.norm(vertices[triangles] - np.roll(vertices[triangles], 1, axis=1), axis=2)
    result = STARTS[kind](vertices, fixed, float(edges.mean())).copy()
    result[fixed] = vertices[fixed]
    return result
