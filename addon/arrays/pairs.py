"""Pairs of numbers as one number each, to compare and to look up.

In 64 bits whatever comes in: on Windows NumPy before 2 counts in 32, in which a face times all vertices overflows.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .types import Ints

Whole = NDArray[np.integer[Any]]


def pair_keys(first: Whole, second: Whole) -> Ints:
    """Return a number for each pair, in the same order as the pairs; each of them is from 0 to 2³² − 1."""
    keys: Ints = first.astype(np.int64) << 32 | second.astype(np.int64)
    return keys


def edge_keys(edges: Whole) -> Ints:
    """Return (e,): the same number for an edge (e, 2) from either end."""
    return pair_keys(edges.min(axis=1), edges.max(axis=1))


def places_of(wanted: Ints, keys: Ints) -> Ints:
    """Return where each of the wanted keys is among `keys`, which has them all."""
    order = np.argsort(keys)
    found: Ints = order[np.searchsorted(keys, wanted, sorter=order)]
    return found
