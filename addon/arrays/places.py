"""Vertices and faces: as scripts name them, and by where they are."""

from __future__ import annotations

from typing import Any

import numpy as np

from .types import Floats, Ints


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


def renumbered(before: Floats, now: Floats) -> Ints | None:
    """Return the number that each of the points (n, 3) has among the same points in any order.

    None where others are there, or where the order differs and two lie in one place.
    """
    if np.array_equal(before, now):
        return np.arange(len(before))
    if before.shape != now.shape:
        return None
    first, second = np.lexsort(before.T), np.lexsort(now.T)
    ordered = before[first]
    if not np.array_equal(ordered, now[second]) or (np.diff(ordered, axis=0) == 0.0).all(axis=1).any():
        return None
    numbers = np.empty(len(before), dtype=np.int64)
    numbers[first] = second
    return numbers
