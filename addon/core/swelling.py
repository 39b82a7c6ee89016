"""Knobs: patches that bend much like a ball and much like a saddle, too.

By Gauss and Bonnet a boundary with its slopes settles the integral of the Gaussian curvature over a disc. A surface
that does no more than it must has one sign of it nearly everywhere; a knob on a neck adds as much of both.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints
from .region import Patch, nothing

LEAST = 0.25  # of 2π: by how much a knob bends like a ball, and its neck like a saddle; an elbow of 90° has as much
CALMER = 0.8  # of what the old surface had of it: a surface with less is an improvement, whatever it is


@dataclass(frozen=True)
class Disc:
    """A piece of a patch with one boundary and without pins."""

    triangles: Ints  # (m, 3) patch indices
    inner: Ints  # patch indices of the vertices off its border, ascending
    border: Ints  # (k, 2) its edges with a single triangle, the smaller index of each first


def discs(patch: Patch) -> tuple[Disc, ...]:
    """Return the pieces of the patch that knobs are looked for in."""
    pieces = fairing.components(patch.triangles, fixed=patch.fixed)
    found = (_disc(patch.triangles[pieces == piece]) for piece in range(int(pieces.max(initial=-1)) + 1))
    return tuple(disc for disc in found if disc is not None and not np.isin(disc.inner, patch.fixed).any())


def _disc(triangles: Ints) -> Disc | None:
    """Return connected triangles that have the Euler characteristic of a disc."""
    edges, uses = fairing.edges_with_uses(triangles)
    vertices = np.unique(triangles)
    if len(vertices) - len(edges) + len(triangles) != 1:
        return None
    border = edges[uses == 1]
    return Disc(triangles, np.setdiff1d(vertices, border), border)


def swellings(pieces: tuple[Disc, ...], points: Floats, before: float = 0.0) -> Ints:
    """Return the vertices at the tops of knobs, as patch indices.

    points: (p, 3) of the patch; before: what `waviness` was. On each knob they are the most bent ones, which make up
    half of its turn.
    """
    limit = max(LEAST, CALMER * before)
    turns = [(disc.inner, _turns(points, disc.triangles)[disc.inner]) for disc in pieces]
    return np.concatenate([nothing(), *(_tops(inner, bends) for inner, bends in turns if _both_ways(bends) > limit)])


def waviness(pieces: tuple[Disc, ...], points: Floats) -> float:
    """Return by how much, of 2π, the pieces bend both like a ball and like a saddle, at most."""
    return max((_both_ways(_turns(points, disc.triangles)[disc.inner]) for disc in pieces), default=0.0)


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
    corners = triangles.T
    sides = [points[corners[(k + 1) % 3]] - points[corners[k]] for k in range(3)]
    doubled = np.linalg.norm(np.cross(sides[0], sides[1]), axis=1)  # area: the same from each corner
    for k in range(3):
        angles = np.arctan2(doubled, -np.einsum("ij,ij->i", sides[k], sides[k - 1]))
        turns -= np.bincount(corners[k], weights=angles, minlength=len(points))
    return turns
