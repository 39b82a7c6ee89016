"""Values of a boundary carried over a new surface: as smoothly as heat would spread. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from .types import Floats, Ints


def harmonic(points: Floats, triangles: Ints, values: Floats) -> Floats:
    """Return (q − r, c): the harmonic function with the given values (r, c) at the first r of the points (q, 3).

    No value leaves the range of its column; a constant one keeps its bits. What is not finite counts as 0.
    """
    values = np.where(np.isfinite(values), values, 0.0)
    # The first row is taken off and put back, so that nothing is left to solve for a constant.
    given = values - values[0]
    varied = np.flatnonzero(given.any(axis=0))
    inside = np.zeros((len(points) - len(values), values.shape[1]))
    if len(inside) and len(varied):
        rim = np.arange(len(values))
        inside[:, varied] = fairing.interpolate(points, triangles, rim, given[:, varied])[len(values) :]
    carried: Floats = np.clip(inside + values[0], values.min(axis=0), values.max(axis=0))
    return carried


def nearest(triangles: Ints, count: int, known: int) -> Ints:
    """Return (count,): which of the first `known` vertices each vertex is next to, counted in edges."""
    tails = triangles.ravel()
    heads = np.roll(triangles, -1, axis=1).ravel()
    tails, heads = np.concatenate([tails, heads]), np.concatenate([heads, tails])
    label = np.full(count, -1, dtype=np.int64)
    label[:known] = np.arange(known)
    while True:
        reached = (label[tails] >= 0) & (label[heads] < 0)
        if not reached.any():
            return label
        label[heads[reached]] = label[tails[reached]]
