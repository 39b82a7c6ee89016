"""Means of attributes whose numbers are turns: a mean direction keeps its length. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from .types import Floats

# Columns that are directions, by the type of the attribute: a matrix is kept axis after axis, its place last.
_DIRECTIONS = {"QUATERNION": (slice(0, 4),), "FLOAT4X4": (slice(0, 3), slice(4, 7), slice(8, 11))}


def columns(kind: str, values: Floats) -> Floats:
    """Return what a mean is taken of: the values (n, w), then the length of each direction in them."""
    if kind == "QUATERNION" and len(values):
        values = np.where(values @ values[:1].T < 0.0, -values, values)  # both signs are the same turn
    lengths = [np.linalg.norm(values[:, part], axis=1, keepdims=True) for part in _DIRECTIONS.get(kind, ())]
    return np.concatenate([values, *lengths], axis=1)


def blended(kind: str, means: Floats) -> Floats:
    """Return the values (n, w) for means of `columns`: directions that differ are shorter in the mean."""
    parts = _DIRECTIONS.get(kind, ())
    width = means.shape[1] - len(parts)
    values: Floats = means[:, :width].copy()
    for part, wanted in zip(parts, means[:, width:].T, strict=True):
        found = np.linalg.norm(values[:, part], axis=1)
        values[:, part] *= np.divide(wanted, found, out=np.zeros_like(wanted), where=found > 0.0)[:, None]
    return values
