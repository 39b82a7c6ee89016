"""How scripts name faces and vertices."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from core.places import as_indices


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
