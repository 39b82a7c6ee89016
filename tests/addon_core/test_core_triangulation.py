"""Diagonals: wound as the faces, by connectivity alone, regular where that is possible."""

import numpy as np
import pytest
from addon.arrays.triangulation import split_quads, zigzag


@pytest.mark.parametrize("size", [5, 6, 9])
def test_zigzag_covers_a_convex_polygon_once(size: int) -> None:
    angles = 2.0 * np.pi * np.arange(size) / size
    corners = np.column_stack([np.cos(angles), np.sin(angles)])
    triangles = zigzag(np.arange(size)[None])
    assert len(triangles) == size - 2
    a, b, c = (corners[column] for column in triangles.T)
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert doubled.min() > 0.0  # wound as the polygon
    assert doubled.sum() == pytest.approx(size * np.sin(2.0 * np.pi / size))  # its area, twice


def edges_of(faces: np.ndarray) -> np.ndarray:
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0)


def test_a_diagonal_between_fixed_vertices_is_turned_away() -> None:
    """One quad with two free corners, beside which the cost of a fixed diagonal decides."""
    quads = np.array([[0, 1, 2, 3]])
    for fixed in ([0, 2], [1, 3]):
        free = np.ones(4, dtype=bool)
        free[fixed] = False
        triangles = split_quads(quads, edges_of(quads), free)
        shared = [v for v in range(4) if (triangles == v).any(axis=1).all()]
        assert shared == sorted(set(range(4)) - set(fixed))
