"""Quads of a rectangle of vertices, each cut in two."""

import numpy as np
from numpy.typing import NDArray

IntArray = NDArray[np.int64]


def corners(number: IntArray) -> IntArray:
    """(q, 4) the quads between neighbouring rows and columns of a 2-D array of vertices; repeat a row to close it."""
    around = (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    return np.stack(around, axis=-1).reshape(-1, 4)


def halves(number: IntArray, rng: np.random.Generator | None = None) -> IntArray:
    """(2 q, 3) all cut from their first corners, or at random."""
    a, b, c, d = corners(number).T
    one = np.ones(len(a), dtype=bool) if rng is None else rng.random(len(a)) < 0.5
    first = np.column_stack([a, b, np.where(one, c, d)])
    return np.concatenate([first, np.column_stack([np.where(one, a, b), c, d])])


def numbered(rows: int, columns: int) -> IntArray:
    """Row by row."""
    return np.arange(rows * columns).reshape(rows, columns)
