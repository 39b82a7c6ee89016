"""Diagonals: wound as the faces, by connectivity alone, regular where that is possible."""

from __future__ import annotations

import numpy as np
import pytest

from core.region import make_patch
from core.triangulation import split_quads, zigzag
from polygon_mesh import grid, grid_points, grid_quads


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


def unevenness(edges: np.ndarray, free: np.ndarray) -> int:
    """Σ (edges at a vertex − 6 inside, − 4 on the outline)²."""
    return int(((np.bincount(edges.ravel(), minlength=len(free)) - np.where(free, 6, 4)) ** 2).sum())


def test_no_single_diagonal_could_be_turned_for_the_better() -> None:
    """On a grid whose quads begin at any of their corners, so that the first diagonals are left to chance."""
    size = 8
    turns = np.random.default_rng(6).integers(4, size=size**2)
    quads = np.array([np.roll(loop, turn) for loop, turn in zip(grid_quads(size), turns, strict=True)])
    free = np.abs(grid_points(size)).max(axis=1) < 0.99
    triangles = split_quads(quads, edges_of(quads), free)
    assert triangles.shape == (2 * size**2, 3)
    edges = edges_of(triangles)
    best = unevenness(edges, free)
    known = {tuple(edge) for edge in edges.tolist()}
    for quad in quads:
        first, second = (tuple(sorted(quad[at].tolist())) for at in ([0, 2], [1, 3]))
        old, new = (first, second) if first in known else (second, first)
        if free[list(new)].any():  # the others cost more than unevenness
            assert unevenness(np.array(sorted(known - {old} | {new})), free) >= best
    by_chance = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    assert best < 0.5 * unevenness(edges_of(by_chance), free)


def test_a_diagonal_between_fixed_vertices_is_turned_away() -> None:
    """One quad with two free corners, beside which the cost of a fixed diagonal decides."""
    quads = np.array([[0, 1, 2, 3]])
    for fixed in ([0, 2], [1, 3]):
        free = np.ones(4, dtype=bool)
        free[fixed] = False
        triangles = split_quads(quads, edges_of(quads), free)
        shared = [v for v in range(4) if (triangles == v).any(axis=1).all()]
        assert shared == sorted(set(range(4)) - set(fixed))


def test_the_shape_does_not_decide() -> None:
    flat = make_patch(grid(8, 0.8)).triangles
    crumpled = grid(8, 0.8, lambda points: points + np.random.default_rng(0).normal(size=points.shape))
    assert np.array_equal(make_patch(crumpled).triangles, flat)
    assert not np.array_equal(make_patch(crumpled, by_connectivity=False).triangles, flat)
