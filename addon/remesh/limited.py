"""How many vertex groups a new vertex is in. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from ..arrays.types import Floats, Mask


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
