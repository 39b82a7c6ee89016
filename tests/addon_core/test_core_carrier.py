"""Vertices carried along: exact for common shifts, bounded by the largest shift, near ones follow their neighbours."""

from __future__ import annotations

import numpy as np
from addon.live import carrier
from addon.live.carrier import Carrier

RNG = np.random.default_rng(9)
FIXED = RNG.normal(size=(30, 3))
FREE = RNG.normal(size=(50, 3))


def test_a_common_shift_is_followed_exactly_and_none_moves_nothing() -> None:
    shift = np.array([0.3, -2.0, 0.7])
    np.testing.assert_allclose(Carrier(FIXED, FREE).carried(FIXED + shift), FREE + shift, atol=1e-12)
    np.testing.assert_array_equal(Carrier(FIXED, FREE).carried(FIXED), FREE)


def test_a_vertex_on_a_fixed_one_and_what_is_not_finite() -> None:
    broken = FIXED.copy()
    broken[3] = np.nan
    carried = Carrier(FIXED, np.vstack([FREE, FIXED[:1]])).carried(broken)
    assert np.isfinite(carried).all()
    np.testing.assert_allclose(carried[-1], FIXED[0], atol=1e-9)


def test_many_are_carried_by_some() -> None:
    limit = carrier.MOST
    try:
        carrier.MOST = 300
        shift = np.array([1.0, 0.0, 0.0])
        np.testing.assert_allclose(Carrier(FIXED, FREE).carried(FIXED + shift), FREE + shift, atol=1e-12)
        few = Carrier(FIXED, FREE)
        few.carried(FIXED)
        assert few._weights is not None
        assert few._weights.size <= 300
    finally:
        carrier.MOST = limit
