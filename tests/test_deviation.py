"""`fairing.deviation`: signed distances to a surface."""

from __future__ import annotations

import numpy as np
import pytest

import fairing
import solids


def outside_box(points: solids.FloatArray) -> solids.FloatArray:
    """Signed distance to the cube from -1 to 1."""
    beyond = np.abs(points) - 1
    return np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(axis=1), 0)


@pytest.mark.parametrize("n", [2, 9])
def test_distances_to_a_box_are_exact_with_their_signs(n: int) -> None:
    """At faces, edges and corners, outside and inside: the nearest feature's normal decides."""
    points = np.random.default_rng(5).uniform(-2, 2, (4000, 3))
    vertices, triangles = solids.box(n)
    assert np.abs(fairing.deviation(points, vertices, triangles) - outside_box(points)).max() < 1e-12


def test_a_sharp_fold_has_the_right_side_at_its_ridge() -> None:
    """A wedge of 20°: from beyond its tip one face's normal alone would say inside."""
    turn = np.radians(10)
    edge = np.array([[0.0, -1, 0], [0, 1, 0]])
    tail = np.array([[-np.cos(turn), y, sign * np.sin(turn)] for sign in (1, -1) for y in (-1, 1)])
    triangles = np.array([[0, 1, 3], [0, 3, 2], [0, 4, 5], [0, 5, 1]])
    for height in (-0.01, 0.01):
        found = fairing.deviation([[0.1, 0.0, height]], np.concatenate([edge, tail]), triangles)
        assert found == pytest.approx([np.hypot(0.1, height)])


def test_winding_turns_the_sign_and_motion_changes_nothing() -> None:
    vertices, triangles = solids.sphere(24, 12)
    points = 1.3 * vertices + 0.1
    before = fairing.deviation(points, vertices, triangles)
    assert np.abs(fairing.deviation(points, vertices, triangles[:, ::-1]) + before).max() < 1e-12
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    moved = fairing.deviation(points @ turn.T + 5, vertices @ turn.T + 5, triangles)
    assert np.abs(moved - before).max() < 1e-12


def test_what_is_not_finite_is_left_out() -> None:
    vertices, triangles = solids.box(4)
    spoilt = vertices.copy()
    spoilt[triangles[0, 0]] = np.nan
    found = fairing.deviation([[np.nan, 0, 0], [0, 0, -1.5]], spoilt, triangles)
    assert np.isnan(found[0])
    assert np.isfinite(found[1])
    with pytest.raises(ValueError, match="no triangle with finite corners"):
        fairing.deviation(vertices, np.full_like(vertices, np.inf), triangles)


def test_a_triangle_without_area_counts_as_its_edges() -> None:
    found = fairing.deviation([[0.5, 3.0, 0]], [[0, 0, 0], [1, 0, 0], [2, 0, 0.0]], [[0, 1, 2]])
    assert np.abs(found) == pytest.approx(3.0)
