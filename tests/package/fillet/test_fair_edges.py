"""Chains of edges become fair between the edges that they continue."""

import numpy as np
import pytest
from numpy.typing import NDArray

import fairing

FloatArray = NDArray[np.float64]


def chain(first: int, count: int) -> list[list[int]]:
    return [[k, k + 1] for k in range(first, first + count - 1)]


def dented(exact: FloatArray, inner: slice, seed: int = 1) -> FloatArray:
    points = exact.copy()
    points[inner] += 0.1 * np.random.default_rng(seed).normal(size=points[inner].shape)
    return points


def on_line(count: int) -> FloatArray:
    return np.array([3.0, 0.0, 1.0]) + np.outer(np.linspace(0.0, 1.0, count) ** 1.3, [1.0, 2.0, -0.5])


def on_circle(count: int) -> FloatArray:
    angle = 2.0 * np.linspace(0.0, 1.0, count)
    return 0.5 * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])


@pytest.mark.parametrize("exact", [on_line(20), on_circle(20)], ids=["straight", "circle"])
def test_a_dented_edge_comes_back(exact: FloatArray) -> None:
    """Onto the line or the circle; its neighbours outside and the vertices at the outline keep their bits."""
    inner = slice(6, 14)
    given = dented(exact, inner)
    result = fairing.fair_edges(given, chain(5, 10), chain(0, 6) + chain(14, 6))
    assert result.moved.tolist() == list(range(6, 14))
    (curve,) = result.curves
    assert sorted(curve.tolist()) == list(range(5, 15))
    offset = exact[10] - exact[9]
    if np.abs(np.cross(exact[1] - exact[0], offset)).max() < 1e-12:
        way = exact[-1] - exact[0]
        distance = np.linalg.norm(np.cross(result.vertices - exact[0], way), axis=1) / np.linalg.norm(way)
    else:
        distance = np.abs(np.linalg.norm(result.vertices, axis=1) - 0.5)
    assert distance.max() < 1e-9
    still = np.setdiff1d(np.arange(20), result.moved)
    assert np.array_equal(result.vertices[still], given[still])


def test_three_edges_meet_where_their_lines_do() -> None:
    """A box corner whose tip was knocked off."""
    arms = np.array([[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]])
    points = np.concatenate([[[0.2, -0.1, 0.3]], *(np.outer(np.arange(1, 9), arm) / 8.0 for arm in arms)])
    inner, onward = [], []
    for k in range(3):
        first = 1 + 8 * k
        inner += [[0, first], *chain(first, 4)]
        onward += chain(first + 3, 5)
    points[[1, 2, 9, 10, 17, 18]] += 0.05
    result = fairing.fair_edges(points, inner, onward)
    assert np.abs(result.vertices[0]).max() < 1e-9
    assert len(result.curves) == 3
    off_axes = np.sort(np.abs(result.vertices), axis=1)[:, 1]
    assert off_axes.max() < 1e-9


def test_what_does_not_run_through_stays() -> None:
    """A chain that ends inside, one that nothing continues, and a ring."""
    exact = dented(on_circle(20), slice(6, 14))
    ring = on_circle(8)
    for edges, onward in (
        (chain(5, 6), chain(0, 6)),
        (chain(5, 10), np.empty((0, 2), int)),
        (chain(5, 10), chain(0, 6)),
    ):
        result = fairing.fair_edges(exact, edges, onward)
        assert len(result.moved) == 0
        assert np.array_equal(result.vertices, exact)
    closed = fairing.fair_edges(ring, [*chain(0, 8), [7, 0]], np.empty((0, 2), int))
    assert np.array_equal(closed.vertices, ring)


def test_bad_input_is_named() -> None:
    with pytest.raises(fairing.MeshError, match="edges: row 0 names vertex 9"):
        fairing.fair_edges(on_line(5), [[0, 9]], [[1, 2]])
    with pytest.raises(ValueError, match="onward: shape"):
        fairing.fair_edges(on_line(5), [[0, 1]], [[1, 2, 3]])
