"""Values of new elements: carried over from a boundary as heat would spread, means of turns, few groups. No bpy."""

from __future__ import annotations

import numpy as np

import fairing

from .types import Floats, Ints, Mask


def harmonic(points: Floats, triangles: Ints, values: Floats) -> Floats:
    """Return (q − r, c): the harmonic function with the given values (r, c) at the first r of the points (q, 3).

    No value leaves the range of its column; a constant one keeps its bits. What is not finite counts as 0.
    """
    finite = np.where(np.isfinite(values), values, 0.0)
    return fairing.maps.interpolate(points, triangles, np.arange(len(values)), finite)[len(values) :]


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


def limited(weights: Floats, most: int) -> Floats:
    """Return weights (k, g) of which no row has more than `most` above zero: the largest stay, and the row's sum."""
    if most >= weights.shape[1]:
        return weights
    order = np.argsort(-weights, axis=1, kind="stable")
    kept = weights.copy()
    np.put_along_axis(kept, order[:, most:], 0.0, axis=1)
    before, after = weights.sum(axis=1), kept.sum(axis=1)
    scale = np.divide(before, after, out=np.ones_like(before), where=after > 0.0)
    result: Floats = np.minimum(kept * scale[:, None], 1.0)
    return result


def limited_like(weights: Floats, sources: Floats, counted: Mask) -> Floats:
    """Return weights (k, g) in no more of the groups that count, a (g,) mask, than one of the sources (n, g) is."""
    found = np.count_nonzero(sources[:, counted] > 0.0, axis=1)
    result = weights.copy()
    result[:, counted] = limited(weights[:, counted], int(found.max(initial=0)))
    return result
