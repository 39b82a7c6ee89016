"""Values of an outline carried over a new surface: as smoothly as heat would spread. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import fairing

from .arrays import Floats, Ints

LEAST_WEIGHT = 1e-3  # of an edge: where angles are too wide for a positive one
ACCURACY = 1e-8  # of the residual at the start; values are stored in 24 bits
MOST_STEPS = 5000


def harmonic(points: Floats, triangles: Ints, values: Floats) -> Floats:
    """Return (q − r, c): the harmonic function with the given values (r, c) at the first r of the points (q, 3).

    Cotangent weights, none below LEAST_WEIGHT: no value leaves the range of its column. A linear function stays linear
    on a flat mesh without wide angles; a constant one keeps its bits. What is not finite counts as 0.
    """
    values = np.where(np.isfinite(values), values, 0.0)
    # The first row is taken off and put back, so that nothing is left to solve for a constant.
    given = values - values[0]
    varied = np.flatnonzero(given.any(axis=0))
    inside = np.zeros((len(points) - len(values), values.shape[1]))
    if len(inside) and len(varied):
        inside[:, varied] = _solved(points, triangles, given[:, varied])
    carried: Floats = np.clip(inside + values[0], values.min(axis=0), values.max(axis=0))
    return carried


def _solved(points: Floats, triangles: Ints, given: Floats) -> Floats:
    rows, columns, weights = _weights(points, triangles, len(given))
    starts = np.flatnonzero(np.diff(rows, prepend=-1))
    diagonal = np.add.reduceat(weights, starts)[:, None]

    def neighbours(everywhere: Floats) -> Floats:
        sums: Floats = np.add.reduceat(weights[:, None] * everywhere[columns], starts)
        return sums

    def operator(inside: Floats) -> Floats:
        return diagonal * inside - neighbours(np.concatenate([np.zeros_like(given), inside]))

    right = neighbours(np.concatenate([given, np.zeros((len(points) - len(given), given.shape[1]))]))
    return _conjugate_gradients(operator, diagonal, right)


def _weights(points: Floats, triangles: Ints, known: int) -> tuple[Ints, Ints, Floats]:
    """Return rows (ascending, those of the unknowns only), columns and positive weights of the edges."""
    rows, columns, values = fairing.cotan_laplacian(points, triangles)
    used = (rows != columns) & (rows >= known)
    order = np.argsort(rows[used], kind="stable")
    weights = np.maximum(-values[used][order], LEAST_WEIGHT)
    return rows[used][order].astype(np.int64), columns[used][order].astype(np.int64), weights


def _conjugate_gradients(operator: Callable[[Floats], Floats], diagonal: Floats, right: Floats) -> Floats:
    """Solve for all columns at once, each with steps of its own; scaled by the diagonal."""
    found = np.zeros_like(right)
    residual = right.copy()
    direction = residual / diagonal
    size = (residual * direction).sum(axis=0)
    enough = ACCURACY**2 * size
    for _ in range(MOST_STEPS):
        if (size <= enough).all():
            break
        image = operator(direction)
        energy = (direction * image).sum(axis=0)
        step = np.where(size > enough, size / np.where(energy > 0.0, energy, 1.0), 0.0)
        found += step * direction
        residual -= step * image
        scaled = residual / diagonal
        before, size = size, (residual * scaled).sum(axis=0)
        direction = scaled + direction * (size / np.where(before > 0.0, before, 1.0))
    return found


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
