"""Small vector arithmetic on arrays."""

from __future__ import annotations

import numpy as np

from .types import Floats, Ints


def area_vectors(positions: Floats, triangles: Ints) -> Floats:
    """Return (m, 3): twice the area times the normal of each triangle."""
    a, b, c = (positions[column] for column in triangles.T)
    vectors: Floats = np.cross(b - a, c - a)
    return vectors


def unit(vectors: Floats) -> Floats:
    """Return the (k, 3) vectors with length 1; zero vectors stay zero."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    units: Floats = vectors / np.where(lengths > 0.0, lengths, 1.0)
    return units


def sum_at(places: Ints, vectors: Floats, count: int) -> Floats:
    """Return (count, 3): the sum of the vectors (k, 3) at each of the places (k,)."""
    columns = [np.bincount(places, weights=column, minlength=count) for column in vectors.T]
    return np.stack(columns, axis=1)
