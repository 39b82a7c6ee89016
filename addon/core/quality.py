"""What can be told about triangles before and after: turned over, flat, running into each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .vectors import area_vectors, sum_at, unit

Count = Callable[[Floats, Ints], int]  # pairs of triangles (m, 3) that run into each other at positions (n, 3)

LARGE = 50_000  # triangles
FLATTEST = 1e-3  # height over longest side, below which a triangle counts as degenerate


@dataclass(frozen=True)
class Quality:
    """Counts of bad triangles."""

    flipped: int
    degenerate: int
    intersections: int | None  # pairs; None: not looked for


def compare(
    positions: tuple[Floats, Floats], triangles: Ints, clear: bool, crossings: Count
) -> tuple[Quality, Quality]:
    """Measure the triangles (m, 3) at the positions (n, 3) before and after, all finite.

    clear: known not to run into itself afterwards. In a large patch that doesn't, whether it did before stays open: to
    look takes as long as a tenth of the solve.
    """
    before, after = positions
    result = _measured(after, triangles, 0 if clear else crossings(after, triangles))
    look = len(triangles) <= LARGE or result.intersections != 0
    return _measured(before, triangles, crossings(before, triangles) if look else None), result


def _measured(positions: Floats, triangles: Ints, crossings: int | None) -> Quality:
    return Quality(
        flipped=int(np.count_nonzero(flipped(positions, triangles))),
        degenerate=int(np.count_nonzero(degenerate(positions, triangles))),
        intersections=crossings,
    )


def flipped(positions: Floats, triangles: Ints) -> Mask:
    """Return the (m,) mask of triangles that face away from the mean normal of their corners.

    The normals are the area-weighted averages of §6, from these triangles alone.
    """
    vectors = area_vectors(positions, triangles)
    normals = unit(sum_at(triangles.ravel(), np.repeat(vectors, 3, axis=0), len(positions)))
    around = normals[triangles].sum(axis=1)
    turned: Mask = np.einsum("ij,ij->i", around, vectors) < 0.0
    return turned


def degenerate(positions: Floats, triangles: Ints) -> Mask:
    """Return the (m,) mask of triangles whose height is below FLATTEST times their longest side."""
    a, b, c = (positions[column] for column in triangles.T)
    longest_squared = np.max([((end - start) ** 2).sum(axis=1) for start, end in ((a, b), (b, c), (c, a))], axis=0)
    doubled = np.linalg.norm(area_vectors(positions, triangles), axis=1)
    flat: Mask = ~(doubled > FLATTEST * longest_squared)
    return flat


def texture_distortion(before: Floats, after: Floats, triangles: Ints) -> float:
    """Return the area-weighted mean of conformal distortion − 1; 0 where all angles are kept.

    Weighted by the areas before; triangles without area on either side are left out.
    """
    distortion = fairing.conformal_distortion(before, after, triangles)
    areas = np.linalg.norm(area_vectors(before, triangles), axis=1)
    usable = np.isfinite(distortion) & (areas > 0.0)
    if not usable.any():
        return 0.0
    return float(np.average(distortion[usable] - 1.0, weights=areas[usable]))
