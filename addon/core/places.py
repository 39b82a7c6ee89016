"""Vertices and faces as scripts name them."""

from __future__ import annotations

from typing import Any

import numpy as np

from .arrays import Ints


def as_indices(name: str, given: Any, count: int) -> Ints:
    """Return the numbers that an argument stands for: numbers themselves, or a mask of `count`.

    Raises TypeError for other kinds, such as floats; ValueError for a mask of another length; IndexError.
    """
    values = np.asarray(given)
    if values.size == 0:
        return np.empty(0, dtype=np.int64)
    if values.dtype == bool:
        if values.shape != (count,):
            raise ValueError(f"{name}: expected a mask of {count}, or numbers, got {values.size} truth values")
        return np.flatnonzero(values)
    if values.dtype.kind not in "iu":
        raise TypeError(f"{name}: expected numbers of {name}, or a mask, got {values.dtype}")
    numbers: Ints = values.astype(np.int64)
    if not 0 <= numbers.min() <= numbers.max() < count:
        raise IndexError(f"{name}: expected indices below {count}")
    return numbers
