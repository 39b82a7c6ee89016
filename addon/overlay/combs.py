"""Curvature combs along edges: a tooth at each vertex, as long as the line bends there. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.types import Floats, Ints

LONGEST = 0.2  # of the size of the lines, the tooth of full length


@dataclass(frozen=True)
class Comb:
    """The teeth of k vertices."""

    feet: Floats  # (k, 3)
    bends: Floats  # (k, 3) towards the centre of curvature, in 1 / length: 1 / radius on a circle
    pairs: Ints  # (m, 2) teeth beside each other
    size: float  # of the lines: the diagonal of their box

    @property
    def largest(self) -> float:
        """The curvature of the longest tooth."""
        return float(np.linalg.norm(self.bends, axis=1).max(initial=0.0))

    def tips(self, full: float) -> Floats:
        """Return where the teeth (k, 3) end, on the far side of the centre; full: the curvature of full length."""
        ends: Floats = self.feet - (LONGEST * self.size / full) * self.bends
        return ends


def comb(points: Floats, edges: Ints) -> Comb:
    """Return the comb of lines with these points (n, 3) and edges (e, 2).

    A tooth stands where two edges meet and belongs to the circle through their three ends, so that those of a circle
    are all alike, however its vertices are spaced.
    """
    ends, others = np.concatenate([edges[:, 0], edges[:, 1]]), np.concatenate([edges[:, 1], edges[:, 0]])
    order = np.argsort(ends, kind="stable")
    ends, others = ends[order], others[order]
    first = np.flatnonzero((ends[1:] == ends[:-1]) & (np.bincount(ends, minlength=len(points))[ends[1:]] == 2))
    inner = ends[first]
    u, v = points[others[first]] - points[inner], points[others[first + 1]] - points[inner]
    m = (u * u).sum(axis=1)[:, None] * v - (v * v).sum(axis=1)[:, None] * u
    square = (m * m).sum(axis=1)[:, None]  # 0 only where points fall together
    bends = 2.0 * np.cross(m, np.cross(u, v)) / np.where(square > 0.0, square, 1.0)
    number = np.full(len(points), -1, dtype=np.int64)
    number[inner] = np.arange(len(inner))
    pairs = number[edges]
    size = float(np.linalg.norm(np.ptp(points, axis=0))) if len(points) else 0.0
    return Comb(points[inner], bends, pairs[(pairs >= 0).all(axis=1)], size)
