"""Small arithmetic of numbers and vectors: elements as scripts name them, pairs as one number, sums at places."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

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


def as_matrix(given: Any) -> Floats:
    """Return the (4, 4) map that a script gives, or leaves out; raises ValueError for another shape."""
    matrix = np.eye(4) if given is None else np.array(given, dtype=np.float64)
    if matrix.shape != (4, 4):
        raise ValueError(f"matrix: expected 4×4 numbers, got shape {matrix.shape}")
    return matrix


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


def numbers_in(chosen: Ints, count: int) -> Ints:
    """Return (count,): which of the chosen ones each is, in their order; -1 for none."""
    numbers = np.full(count, -1, dtype=np.int64)
    numbers[chosen] = np.arange(len(chosen))
    return numbers


def no_pairs() -> Ints:
    return np.empty((0, 2), dtype=np.int64)


def area_vectors(positions: Floats, triangles: Ints) -> Floats:
    """Return (m, 3): twice the area times the normal of each triangle."""
    a, b, c = (positions[column] for column in triangles.T)
    vectors: Floats = np.cross(b - a, c - a)
    return vectors


def unit(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    units: Floats = vectors / np.where(lengths > 0.0, lengths, 1.0)
    return units


def sum_at(places: Ints, vectors: Floats, count: int) -> Floats:
    """Return (count, 3): the sum of the vectors (k, 3) at each of the places (k,)."""
    columns = [np.bincount(places, weights=column, minlength=count) for column in vectors.T]
    return np.stack(columns, axis=1)
