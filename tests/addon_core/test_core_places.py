"""How scripts name faces and vertices."""

from typing import Any

import numpy as np
import pytest
from addon.arrays.places import as_indices, renumbered


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ([3, 1], [3, 1]),
        (range(2), [0, 1]),
        (np.array([2], dtype=np.uint8), [2]),
        ([], []),
        (np.array([False, True, False, True]), [1, 3]),
        ([True, False, False, False], [0]),
    ],
)
def test_numbers_and_masks_are_understood(given: Any, meant: list[int]) -> None:
    assert as_indices("faces", given, 4).tolist() == meant


@pytest.mark.parametrize(
    ("given", "error", "reported"),
    [
        ([1.0, 2.0], TypeError, "faces: expected numbers of faces, or a mask, got float64"),
        (["a"], TypeError, "faces: expected numbers"),
        ([True, False], ValueError, "faces: expected a mask of 4, or numbers, got 2 truth values"),
        ([4], IndexError, "faces: expected indices below 4"),
        ([-1], IndexError, "faces: expected indices below 4"),
    ],
)
def test_anything_else_is_refused_by_name(given: Any, error: type[Exception], reported: str) -> None:
    with pytest.raises(error, match=reported):
        as_indices("faces", given, 4)


def test_points_in_another_order_are_found() -> None:
    rng = np.random.default_rng(5)
    before = rng.integers(-3, 4, (200, 3)).astype(float)
    before = np.unique(before, axis=0)[rng.permutation(len(np.unique(before, axis=0)))]
    order = rng.permutation(len(before))
    now = np.empty_like(before)
    now[order] = before
    np.testing.assert_array_equal(renumbered(before, now), order)
    np.testing.assert_array_equal(renumbered(before, before), np.arange(len(before)))


def test_other_points_and_points_in_one_place_are_not() -> None:
    before = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    assert renumbered(before, before[:2]) is None
    assert renumbered(before, before + 1e-9) is None
    twice = before[[0, 1, 1]]
    assert renumbered(twice, twice[[1, 0, 2]]) is None
    np.testing.assert_array_equal(renumbered(twice, twice), [0, 1, 2])  # nothing was mixed
