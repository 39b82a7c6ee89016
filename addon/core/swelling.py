"""Knobs: patches that bend much like a ball and much like a saddle, too.

By Gauss and Bonnet an outline with its slopes settles the integral of the Gaussian curvature over a disc. A surface
that does no more than it must has one sign of it nearly everywhere; a knob on a neck adds as much of both.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import fairing

from .arrays import Floats, Ints
from .region import Patch, nothing

LEAST = 0.25  # of 2π: by how much a knob bends like a ball, and its neck like a saddle; an elbow of 90° has as much
CALMER = 0.8  # of what the old surface had of it: a surface with less is an improvement, whatever it is


def swellings(patch: Patch, points: Floats, before: float = 0.0) -> Ints:
    """Return the mesh vertices at the tops of knobs, for each piece of the patch that is a disc without pins.

    points: (p, 3) of the patch; before: what `waviness` was. On each knob they are the most bent ones, which make up
    half of its turn.
    """
    limit = max(LEAST, CALMER * before)
    tops = [_tops(inner, turns) for inner, turns in _pieces(patch, points) if _both_ways(turns) > limit]
    found: Ints = patch.vertices[np.concatenate([nothing(), *tops])]
    return found


def waviness(patch: Patch, points: Floats) -> float:
    """Return by how much, of 2π, the pieces that are discs bend both like a ball and like a saddle, at most."""
    return max((_both_ways(turns) for _, turns in _pieces(patch, points)), default=0.0)


def _pieces(patch: Patch, points: Floats) -> Iterator[tuple[Ints, Floats]]:
    """Yield the inner vertices of each piece that is a disc without pins, and the turns that they miss."""
    pieces = fairing.components(patch.triangles, fixed=patch.fixed)
    for piece in range(int(pieces.max(initial=-1)) + 1):
        triangles = patch.triangles[pieces == piece]
        inner = _inner(triangles)
        if _is_disc(triangles) and not np.isin(inner, patch.fixed).any():
            yield inner, _turns(points, triangles)[inner]


def _both_ways(turns: Floats) -> float:
    balls, saddles = turns.clip(min=0.0).sum(), -turns.clip(max=0.0).sum()
    return float(min(balls, saddles)) / (2.0 * np.pi)


def _tops(inner: Ints, turns: Floats) -> Ints:
    order = np.argsort(-turns, kind="stable")
    count = int(np.searchsorted(np.cumsum(turns[order]), 0.5 * turns.clip(min=0.0).sum())) + 1
    tops: Ints = inner[order[:count]]
    return tops


def _turns(points: Floats, triangles: Ints) -> Floats:
    """Return by how much the angles at each vertex fall short of a full turn, in radians."""
    turns = np.full(len(points), 2.0 * np.pi)
    for first, second, third in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        here = points[triangles[:, first]]
        one, other = points[triangles[:, second]] - here, points[triangles[:, third]] - here
        across = np.linalg.norm(np.cross(one, other), axis=1)
        angles = np.arctan2(across, (one * other).sum(axis=1))
        turns -= np.bincount(triangles[:, first], weights=angles, minlength=len(points))
    return turns


def _sides(triangles: Ints) -> tuple[Ints, Ints]:
    """Return the edges (e, 2) and how many of the triangles each has."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    count = int(triangles.max()) + 1
    numbers, uses = np.unique(sides[:, 0].astype(np.int64) * count + sides[:, 1], return_counts=True)
    return np.stack(np.divmod(numbers, count), axis=1), uses


def _inner(triangles: Ints) -> Ints:
    """Return the vertices off the border of the triangles, ascending."""
    edges, uses = _sides(triangles)
    inner: Ints = np.setdiff1d(triangles, edges[uses == 1])
    return inner


def _is_disc(triangles: Ints) -> bool:
    """Tell whether connected triangles have the Euler characteristic of a disc."""
    return len(np.unique(triangles)) - len(_sides(triangles)[0]) + len(triangles) == 1
