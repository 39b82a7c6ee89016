"""What is counted about triangles: turned over, flat, distorted; and when crossings are looked for."""

from __future__ import annotations

import numpy as np
import pytest

from core import quality
from core.arrays import Floats, Ints
from core.vectors import area_vectors

QUAD = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])


def test_flipped_triangles() -> None:
    # a fan of six triangles around the origin; two of them turned over by moving a corner across
    angles = np.radians(np.arange(6) * 60.0)
    fan = np.vstack([[0.0, 0.0, 0.0], np.column_stack([np.cos(angles), np.sin(angles), np.zeros(6)])])
    triangles = np.array([[0, 1 + k, 1 + (k + 1) % 6] for k in range(6)])
    assert quality.flipped(fan, triangles).sum() == 0
    fan[1, :2] = (-0.4, 0.6)  # crosses the next spoke
    turned = area_vectors(fan, triangles)[:, 2] < 0.0
    assert turned.any()
    np.testing.assert_array_equal(quality.flipped(fan, triangles), turned)


def test_degenerate_triangles() -> None:
    assert quality.degenerate(QUAD, TWO).sum() == 0
    flat = QUAD.copy()
    flat[1] = (0.5, 0.5 - 1e-4, 0.0)  # next to the diagonal
    np.testing.assert_array_equal(quality.degenerate(flat, TWO), [True, False])
    flat[1] = np.nan
    assert quality.degenerate(flat, TWO)[0]


@pytest.mark.parametrize(("stretch", "distortion"), [(1.0, 0.0), (2.0, 1.0), (0.5, 1.0), (1.5, 0.5)])
def test_texture_distortion_of_a_stretched_square(stretch: float, distortion: float) -> None:
    stretched = QUAD * (stretch, 1.0, 1.0)  # singular values 1 and stretch: ratio max/min − 1
    assert quality.texture_distortion(QUAD, stretched, TWO) == pytest.approx(distortion, abs=1e-12)
    turned = 3.0 * QUAD[:, [1, 2, 0]] + 7.0  # a similarity
    assert quality.texture_distortion(QUAD, turned, TWO) == pytest.approx(0.0, abs=1e-12)


class Counter:
    """Answers with a number for each height of the first vertex, and remembers what it was asked."""

    def __init__(self, before: int, after: int) -> None:
        self.asked: list[str] = []
        self._answers = {"before": before, "after": after}

    def __call__(self, positions: Floats, _triangles: Ints) -> int:
        name = "after" if positions[0, 2] else "before"
        self.asked.append(name)
        return self._answers[name]


LIFTED = QUAD + np.array([0.0, 0.0, 1.0])


def test_crossings_are_counted_on_both_sides() -> None:
    counter = Counter(3, 5)
    before, after = quality.compare((QUAD, LIFTED), TWO, False, counter)
    assert (before.intersections, after.intersections) == (3, 5)


def test_a_result_that_is_known_to_be_clear_is_not_looked_at() -> None:
    counter = Counter(3, 5)
    before, after = quality.compare((QUAD, LIFTED), TWO, True, counter)
    assert (before.intersections, after.intersections) == (3, 0)
    assert counter.asked == ["before"]


@pytest.mark.parametrize(("after", "told"), [(0, None), (5, 3)])
def test_a_large_patch_is_looked_at_before_only_where_it_crosses_afterwards(after: int, told: int | None) -> None:
    many = np.tile(TWO, (quality.LARGE // 2 + 1, 1))
    before, found = quality.compare((QUAD, LIFTED), many, False, Counter(3, after))
    assert (before.intersections, found.intersections) == (told, after)
