"""One surface turns into another over some frames."""

from __future__ import annotations

import numpy as np
from addon.live.blend import Blend

STILL = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
FIRST = np.array([[0.5, 0.2, 0.0]])


def test_the_surface_itself_is_shown_while_its_kind_stays() -> None:
    blend = Blend(1.0)
    for k in range(3):
        target = FIRST + 0.1 * k
        assert blend.towards(target, STILL, "fair", 0.1 * k) is target
        assert not blend.goes_on


def test_another_kind_begins_where_the_last_one_was_and_ends_on_its_own() -> None:
    """In between no step is longer than half as long again as the mean one; then the offset is gone for good."""
    blend = Blend(1.0)
    blend.towards(FIRST, STILL, "first", 0.0)
    target = FIRST + np.array([0.0, 1.0, 0.0])
    heights = [
        blend.towards(target, STILL, "fair", 0.0)[0, 1],
        *(blend.shown(t)[0, 1] for t in np.arange(0.1, 1.1, 0.1)),
    ]
    assert abs(heights[0] - FIRST[0, 1]) < 1e-12
    assert min(np.diff(heights)) > 0.0
    assert max(np.diff(heights)) <= 0.15 + 1e-9
    assert not blend.goes_on
    assert blend.shown(1.1) is target


def test_what_the_boundary_moves_is_no_jump() -> None:
    """The change falls on a drag's step: what was shown goes along with it."""
    blend = Blend(1.0)
    blend.towards(FIRST, STILL, "fair", 0.0)
    move = np.array([0.0, 0.0, 3.0])
    np.testing.assert_allclose(blend.towards(FIRST + move + 1.0, STILL + move, "first", 0.0), FIRST + move, atol=1e-12)


def test_without_a_time_nothing_fades() -> None:
    blend = Blend(0.0)
    blend.towards(FIRST, STILL, "first", 0.0)
    target = FIRST + 1.0
    assert blend.towards(target, STILL, "fair", 0.0) is target
