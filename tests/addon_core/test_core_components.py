"""The pieces of a patch: by hand, and as the engine cuts them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.components import components, connected, outline_radius
from core.region import make_patch
from polygon_mesh import grid, grid_points, grid_quads, polygon_mesh


def test_groups_and_radius_of_known_sets() -> None:
    labels = connected(7, np.array([[5, 6], [0, 2], [2, 4], [6, 1]]))
    assert labels.tolist() == [0, 1, 0, 3, 0, 1, 1]
    square = np.array([[1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]])
    assert outline_radius(square + 5.0) == pytest.approx(np.sqrt(2.0))


def test_a_pinned_loop_divides_a_square() -> None:
    mesh = grid(12, 0.8)  # the inner 10 × 10 quads
    height = np.abs(mesh.positions[:, :2]).max(axis=1)
    inner, outer = components(make_patch(replace(mesh, pinned=np.isclose(height, 0.5))))[::-1]
    assert (len(inner.triangles), len(outer.triangles)) == (2 * 6**2, 2 * (10**2 - 6**2))
    assert (len(inner.outline), len(outer.outline)) == (24, 24 + 40)


def test_a_pinned_point_divides_nothing() -> None:
    mesh = grid(12, 0.8)
    pinned = np.zeros(len(mesh.positions), dtype=bool)
    pinned[13 * 6 + 6] = True
    (piece,) = components(make_patch(replace(mesh, pinned=pinned)))
    assert len(piece.outline) == 40  # a point within is no part of the outline


def test_the_triangle_in_a_corner_stays_with_its_patch() -> None:
    """A diagonal between two vertices of the border cuts a corner off a square, which is no piece of its own."""
    quads = grid_quads(4)
    diagonals = [(loop[0], loop[1], loop[3]) for loop in quads], [(loop[1], loop[2], loop[3]) for loop in quads]
    patch = make_patch(polygon_mesh(grid_points(4), [*diagonals[0], *diagonals[1]], [True] * 32))
    assert any(not np.isin(triangle, patch.free).any() for triangle in patch.triangles)
    (piece,) = components(patch)
    assert len(piece.triangles) == 32
    assert 0 in piece.outline


def test_a_patch_that_is_pinned_has_no_pieces() -> None:
    mesh = grid(6, 0.67)
    assert components(make_patch(replace(mesh, pinned=np.ones(len(mesh.positions), dtype=bool)))) == ()
