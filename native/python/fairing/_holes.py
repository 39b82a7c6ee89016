"""Which border loops are holes, and how much surface a loop asks for: by its turning along the surface.

The turning τ of a loop is its geodesic curvature added up, over 2π, the new surface on the left: 1 around a hole in a
plane, 0 at the end of a tube, −1 around the outside of a sheet, however the sheet is bent along one direction. By
Gauss-Bonnet a disc over the loop has to bend by 2π (1 − τ) in all. The cap of a ball that does so is 2 / (1 + τ) times
as large as the flat disc.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairing._types import FloatArray

PROPORTION = 20.0
"""A surface so many times as large as a flat one is out of proportion: more of a ball than a 25° cap leaves open."""
_PER_SQUARE = 2.0 / np.sqrt(3.0)  # vertices of a mesh of equilateral triangles, per square of their edge
_TINY = 1e-300
_WHOLE = 1e-3  # 1 + τ of what is a whole ball in all but name, and how unlike the normals of a flat sheet may be


def is_outer(points: FloatArray, normals: FloatArray) -> bool:
    """Whether a loop (k, 3) with the new surface on its left goes around the outside of a sheet."""
    return times_flat(points, normals) > PROPORTION


def is_endless(points: FloatArray, normals: FloatArray) -> bool:
    """Whether a loop with the new surface on its left goes around the outside of a flat sheet, which nothing closes."""
    is_flat = float(np.linalg.norm(normals.mean(axis=0))) >= 1.0 - _WHOLE
    return is_flat and 1.0 + turning(points, normals) <= _WHOLE


def times_flat(points: FloatArray, normals: FloatArray) -> float:
    """How many times as large as a flat disc the ball's cap over a loop is: 1 over a plane, 2 over a tube's end."""
    return 2.0 / max(1.0 + turning(points, normals), _WHOLE)


def least_count(loops: Sequence[FloatArray], normals: Sequence[FloatArray], spacing: float) -> float:
    """About how many new vertices surfaces over the loops have at least, one over each: as ``flat_count``, but for the
    outside of a sheet, around which goes a ball that bends as its normals do, in the direction in which they do most.
    """
    times = (
        4.0 * np.pi / max(_disc(loop) * most_bent(loop, part) ** 2, _TINY) if is_outer(loop, part) else 1.0
        for loop, part in zip(loops, normals, strict=True)
    )
    return sum(each * flat_count([loop], spacing, False) for each, loop in zip(times, loops, strict=True))


def most_bent(points: FloatArray, normals: FloatArray) -> float:
    """The larger principal curvature of a surface with these normals around a loop (k, 3), in least squares."""
    away, tilt = points - points.mean(axis=0), normals - normals.mean(axis=0)
    plane = np.linalg.svd(away, full_matrices=False)[2][:2].T
    shape = np.linalg.lstsq(away @ plane, tilt @ plane, rcond=None)[0]
    return float(np.abs(np.linalg.eigvalsh(0.5 * (shape + shape.T))).max())


def turning(points: FloatArray, normals: FloatArray) -> float:
    """τ of a loop (k, 3) with unit normals: angles between its edges as they lie in the tangent planes."""
    after = np.roll(points, -1, axis=0) - points
    before = np.roll(after, 1, axis=0)
    sine = (normals * np.cross(before, after)).sum(axis=1)
    cosine = (before * after).sum(axis=1) - (before * normals).sum(axis=1) * (after * normals).sum(axis=1)
    return float(np.arctan2(sine, cosine).sum() / (2.0 * np.pi))


def flat_count(loops: Sequence[FloatArray], spacing: float, joined: bool) -> float:
    """About how many new vertices flat surfaces over the loops have; joined: bands between them.

    ``spacing``: of the edges, 0: as the loops' own in the mean.
    """
    count = 0.0
    for k, loop in enumerate(loops):
        others = [other for j, other in enumerate(loops) if j != k]
        area = _band(loop, np.concatenate(others)) if joined and others else _disc(loop)
        edge = spacing or _perimeter(loop) / len(loop)
        count += _PER_SQUARE * area / max(edge * edge, _TINY)
    return count


def _perimeter(loop: FloatArray) -> float:
    return float(np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1).sum())


def _disc(loop: FloatArray) -> float:
    """Area of the fan from the loop's middle; no surface of least area has more than a circle as long as the loop."""
    out = loop - loop.mean(axis=0)
    fan = 0.5 * float(np.linalg.norm(np.cross(out, np.roll(out, -1, axis=0)), axis=1).sum())
    return min(fan, _perimeter(loop) ** 2 / (4.0 * np.pi))


def _band(loop: FloatArray, others: FloatArray) -> float:
    """Half of the band to the other loops, as wide as these are away."""
    some = others[np.linspace(0, len(others) - 1, min(len(others), 400)).astype(int)]
    few = loop[np.linspace(0, len(loop) - 1, min(len(loop), 400)).astype(int)]
    away = np.sqrt(((few[:, None] - some[None]) ** 2).sum(axis=2).min(axis=1)).mean()
    return 0.5 * _perimeter(loop) * float(away)
