"""Vertices carried along by the motion of others. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from ..arrays.types import Floats

MOST = 4_000_000  # weights that are kept


class Carrier:
    """Where the free vertices go when the fixed ones move: each by a mean of their shifts, the near ones first."""

    def __init__(self, fixed: Floats, free: Floats) -> None:
        """Begin with the fixed vertices (k, 3) and the free ones (n, 3); k is not zero."""
        # Of very many fixed vertices some are enough: shifts along a boundary are smooth.
        step = max(1, int(np.ceil(len(fixed) * len(free) / MOST)))
        self._fixed, self._free, self._step = fixed, free, step
        self._weights: Floats | None = None  # (n, k / step), made when they are needed

    def carried(self, fixed: Floats) -> Floats:
        """Return the free vertices (n, 3) for other places (k, 3) of the fixed ones.

        A common shift is followed exactly; where nothing moves, nothing does. Nothing that is not finite comes in.
        """
        shift = (fixed - self._fixed)[:: self._step]
        shift = np.where(np.isfinite(shift), shift, 0.0)
        if self._weights is None:
            self._weights = _weights(self._fixed[:: self._step], self._free)
        moved: Floats = self._free + self._weights @ shift
        return moved


def _weights(fixed: Floats, free: Floats) -> Floats:
    """Return (n, k): inverse squares of the distances, with a sum of 1 in each row."""
    squares = (free**2).sum(axis=1)[:, None] + (fixed**2).sum(axis=1) - 2.0 * free @ fixed.T
    smallest = np.finfo(np.float64).eps * max(float(squares.max(initial=0.0)), 1e-300)
    weights: Floats = 1.0 / np.maximum(squares, smallest)
    weights /= weights.sum(axis=1, keepdims=True)
    return weights
