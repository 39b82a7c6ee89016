"""Boundaries with edges far shorter than those around: what the first, coarse surface does without.

Fitted normals are some hundredths of a radian off. Over a fiftieth of an edge that asks for a radius of curvature of an
edge: the search for a surface that turns so sharply took up to 20 s, on a mesh as fine as the shortest edge.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from fairing._loops import Outline
from fairing._types import FloatArray, IntArray

_SHORT = 0.02  # of the edges around
_AROUND = 3  # edges on either side; their median is an ordinary one even where a few short ones are in a row


@dataclass(frozen=True)
class Thinned:
    """A boundary without the vertices at the heads of short edges."""

    outline: Outline
    normals: FloatArray
    """(Σ k', 3) of the vertices that stay."""
    left_out: tuple[tuple[int, int, int], ...]
    """Each vertex left out, between those before and after it; in the order in which they come back."""

    def with_all(self, triangles: IntArray) -> IntArray:
        """The triangles over all of the outline: those at its long edges are cut where vertices were left out."""
        for before, between, after in self.left_out:
            tails, heads = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
            row, corner = divmod(int(np.flatnonzero((tails == before) & (heads == after))[0]), 3)
            cut = np.array([[between, after, triangles[row, (corner + 2) % 3]]], triangles.dtype)
            triangles = np.concatenate([triangles, cut])
            triangles[row, (corner + 1) % 3] = between
        return triangles


def with_shared_normals(outline: Outline, vertices: FloatArray, normals: FloatArray) -> FloatArray:
    """Normals (Σ k, 3), the mean for vertices that short edges join."""
    parts = []
    for loop, part in zip(outline.loops, outline.split(normals), strict=True):
        stays = _staying(vertices[loop])
        first = int(np.argmax(stays))
        group = np.roll(np.cumsum(np.roll(stays, -first)) - 1, first)
        sums = np.zeros((len(loop), 3))
        np.add.at(sums, group, part)
        sums /= np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None]
        parts.append(part if stays.all() else sums[group])
    return np.concatenate(parts)


def thinned(outline: Outline, vertices: FloatArray, normals: FloatArray) -> Thinned:
    """The boundary without the heads of edges shorter than a fiftieth of those around; three vertices stay at least."""
    stay = [_staying(vertices[loop]) for loop in outline.loops]
    loops = tuple(loop[stays] for loop, stays in zip(outline.loops, stay, strict=True))
    left_out = [row for loop, stays in zip(outline.loops, stay, strict=True) for row in _between(loop, stays)]
    return Thinned(replace(outline, loops=loops), normals[np.concatenate(stay)], tuple(left_out))


def _staying(points: FloatArray) -> npt.NDArray[np.bool_]:
    """Which vertices of a loop (k, 3) are no heads of short edges."""
    lengths = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    around = np.median([np.roll(lengths, k) for k in range(-_AROUND, _AROUND + 1)], axis=0)
    stays = ~np.roll(lengths < _SHORT * around, 1)
    return stays if stays.sum() >= 3 else np.ones(len(points), dtype=bool)


def _between(loop: IntArray, stays: npt.NDArray[np.bool_]) -> list[tuple[int, int, int]]:
    first = int(np.argmax(stays))
    around, kept = np.roll(loop, -first).tolist(), np.roll(stays, -first)
    ends = [*np.flatnonzero(kept).tolist(), len(around)]
    rows = []
    for begin, end in pairwise(ends):
        after = around[end % len(around)]
        rows += [(around[k - 1], around[k], after) for k in range(begin + 1, end)]
    return rows
