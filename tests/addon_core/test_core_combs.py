"""Combs: teeth of one length on a circle, none on a line, a jump where curvature jumps."""

from __future__ import annotations

import numpy as np
import pytest
from addon.overlay.combs import LONGEST, comb


def chain(count: int) -> np.ndarray:
    return np.column_stack([np.arange(count - 1), np.arange(1, count)])


@pytest.mark.parametrize("radius", [0.2, 5.0])
def test_teeth_of_a_circle_are_alike_however_its_vertices_lie(radius: float) -> None:
    angles = np.sort(np.random.default_rng(1).uniform(0.0, 6.0, 40))
    points = radius * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(40)]) + (3.0, 2.0, 1.0)
    found = comb(points, chain(40))
    assert len(found.feet) == 38
    np.testing.assert_allclose(found.bends, -(found.feet - (3.0, 2.0, 1.0)) / radius**2, rtol=1e-6, atol=1e-9)
    assert found.largest == pytest.approx(1.0 / radius)
    tips = found.tips(found.largest)
    np.testing.assert_allclose(np.linalg.norm(tips - found.feet, axis=1), LONGEST * found.size, rtol=1e-6)
    assert (np.linalg.norm(tips - (3.0, 2.0, 1.0), axis=1) > radius).all()
    assert len(found.pairs) == 37


def test_a_closed_loop_has_a_tooth_at_each_vertex() -> None:
    angles = 2.0 * np.pi * np.arange(12) / 12
    points = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(12)])
    found = comb(points, np.column_stack([np.arange(12), (np.arange(12) + 1) % 12]))
    assert len(found.feet) == len(found.pairs) == 12


def test_a_line_into_an_arc_shows_where_curvature_jumps() -> None:
    """Tangents are continuous there; the teeth are none before, all of one length after."""
    angles = np.linspace(0.0, 1.5, 16)[1:]
    line = np.column_stack([np.linspace(-1.0, 0.0, 11), np.zeros(11), np.zeros(11)])
    arc = np.column_stack([np.sin(angles), 1.0 - np.cos(angles), np.zeros(15)])
    found = comb(np.concatenate([line, arc]), chain(26))
    lengths = np.linalg.norm(found.bends, axis=1)
    np.testing.assert_allclose(lengths[:9], 0.0, atol=1e-12)
    np.testing.assert_allclose(lengths[10:], 1.0, rtol=1e-6)
    assert 0.3 < lengths[9] < 0.7


def test_crossings_and_points_that_fall_together_have_no_tooth() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 2, 0], [0, 2, 0]], dtype=float)
    found = comb(points, np.array([[0, 1], [0, 2], [0, 3], [3, 4], [4, 5]]))
    assert sorted(map(tuple, found.feet)) == [(0.0, 1.0, 0.0), (0.0, 2.0, 0.0)]
    assert (found.bends == 0.0).all()
    assert comb(np.empty((0, 3)), np.empty((0, 2), dtype=np.int64)).largest == 0.0
