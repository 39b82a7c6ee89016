"""Selections that end on the flank of a bump or a dent: the surface continues that slope, so that the feature stays.

All around such a boundary the patch bends over to one side, and its surroundings bend back to the other. Around whole
features they run on, or bend to both sides. docs/blender.md has how often that is right.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .around import wide_outside, wound_alike
from .arrays import Floats, Ints
from .bends import bends
from .engine import Problem
from .region import MeshArrays, Patch
from .vectors import area_vectors, unit

INSIDE = (0.3, 0.7)  # distances from the boundary, in radii of the patch, where it is looked at
OUTSIDE = ((0.5, 1.1), (0.8, 1.8))  # and its surroundings: a feature ends within one of them
BENDS_OVER = 4.0  # degrees by which the patch bends over on average, at least
BENDS_BACK = 6.0  # and its surroundings bend back
SEEN = 3.0  # degrees from which a place on the boundary counts
MOST_OVER, MOST_BACK = 0.7, 0.75  # of these places, that bend so
ENDS = 0.9  # of the largest lean: there the flank ends
STEP = 0.2  # radii: how finely its end is looked for
SAMPLES, FRAMES = 3000, 300  # triangles on either side, edges of the boundary that are enough


@dataclass(frozen=True)
class Flank:
    """Where a patch ends on a slope."""

    outline: Ints  # its vertices, as patch indices
    is_bump: bool  # or a dent
    rings: int  # of faces to its end


@dataclass(frozen=True)
class _Frames:
    """k edges of a boundary."""

    middles: Floats  # (k, 3)
    normals: Floats  # (k, 3) unit, of the surroundings
    outward: Floats  # (k, 3) unit

    def leans(self, points: Floats, triangles: Ints, side: float) -> tuple[Floats, Floats, Ints]:
        """Return of some triangles (m, 3) the distance, by how many degrees they lean away, and the nearest edge.

        side: 1 for triangles outside, −1 inside. Leaning away is what a dome does on both sides.
        """
        chosen = triangles[:: len(triangles) // SAMPLES + 1]
        away = np.linalg.norm(points[chosen].mean(axis=1)[:, None] - self.middles, axis=2)
        nearest = away.argmin(axis=1)
        normals = area_vectors(points, chosen)
        ahead = side * np.einsum("ij,ij->i", normals, self.outward[nearest])
        degrees = np.degrees(np.arctan2(ahead, np.einsum("ij,ij->i", normals, self.normals[nearest])))
        return away.min(axis=1), degrees, nearest


def flank(mesh: MeshArrays, problem: Problem, after: Floats) -> Flank | None:
    """Return where one of the patch's discs ends on the flank of a bump or a dent; None where none does.

    mesh: in the space of the problem; after: (q, 3) positions of problem.vertices.
    """
    pieces = [disc for disc in _discs(problem.patch) if np.isin(disc.border, problem.outside).all()]
    if not pieces or not len(problem.outside):
        return None
    around = wound_alike(mesh, wide_outside(mesh, problem.patch))
    points = mesh.positions.copy()
    points[problem.vertices] = after
    edge = _mean_edge(after, problem.outside)
    found = (_flank(problem, disc, (points, around), edge) for disc in pieces)
    return next((each for each in found if each is not None), None)


@dataclass(frozen=True)
class _Disc:
    """A piece of a patch with one outline and without pins."""

    triangles: Ints  # (m, 3) patch indices
    border: Ints  # (k, 2) its edges with a single triangle, the smaller index of each first


def _discs(patch: Patch) -> list[_Disc]:
    pieces = fairing.components(patch.triangles, fixed=patch.fixed)
    found = (_disc(patch, patch.triangles[pieces == piece]) for piece in range(int(pieces.max(initial=-1)) + 1))
    return [disc for disc in found if disc is not None]


def _disc(patch: Patch, triangles: Ints) -> _Disc | None:
    """Return connected triangles that have the Euler characteristic of a disc and no pins."""
    edges, uses = fairing.edges_with_uses(triangles)
    vertices, border = np.unique(triangles), edges[uses == 1]
    has_pins = np.isin(np.setdiff1d(vertices, border), patch.fixed).any()
    if has_pins or len(vertices) - len(edges) + len(triangles) != 1:
        return None
    return _Disc(triangles, border)


def _flank(problem: Problem, disc: _Disc, surroundings: tuple[Floats, Ints], edge: float) -> Flank | None:
    patch = problem.patch
    own = surroundings[0][patch.vertices]
    radius = float(np.sqrt(0.5 * np.linalg.norm(area_vectors(own, disc.triangles), axis=1).sum() / np.pi))
    if radius <= 0.0:
        return None
    edges, opposite = _border(disc)
    frames = _frames(own, _normals(problem), edges, opposite)
    inside = _places(frames.leans(own, disc.triangles, -1.0), INSIDE, radius)
    if not len(inside):
        return None
    sign = float(np.sign(inside.mean()))
    if sign * inside.sum() < BENDS_OVER * len(inside) or np.mean(sign * inside > SEEN) < MOST_OVER or not sign:
        return None
    outside = frames.leans(*surroundings, 1.0)
    for band in OUTSIDE:
        back = -sign * _places(outside, band, radius)
        if len(back) and back.mean() >= BENDS_BACK and np.mean(back > SEEN) >= MOST_BACK:
            width = _end(outside[0] / radius, -sign * outside[1]) * radius
            return Flank(np.unique(edges), sign > 0.0, int(np.ceil(width / edge)))
    return None


def _border(disc: _Disc) -> tuple[Ints, Ints]:
    """Return a disc's border edges (k, 2) and the vertex opposite to each in its triangle (k,)."""
    count = int(disc.triangles.max()) + 1
    outer = np.zeros(count, dtype=bool)
    outer[disc.border] = True
    beside = disc.triangles[outer[disc.triangles].sum(axis=1) > 1]
    sides = np.concatenate([beside[:, [k, (k + 1) % 3]] for k in range(3)])
    opposite = np.concatenate([beside[:, (k + 2) % 3] for k in range(3)])
    at_border = np.isin(np.sort(sides, axis=1) @ [count, 1], disc.border @ [count, 1])
    return sides[at_border], opposite[at_border]


def _normals(problem: Problem) -> Floats:
    """Return the normals of the surroundings (p, 3), zero off the fixed vertices."""
    normals = np.zeros((len(problem.patch.vertices), 3))
    normals[problem.patch.fixed] = problem.normals
    return normals


def _frames(points: Floats, normals: Floats, edges: Ints, opposite: Ints) -> _Frames:
    some = slice(None, None, len(edges) // FRAMES + 1)
    edges, opposite = edges[some], opposite[some]
    middles = points[edges].mean(axis=1)
    mean = unit(normals[edges].sum(axis=1))
    across = np.cross(points[edges[:, 1]] - points[edges[:, 0]], mean)
    inward = np.einsum("ij,ij->i", across, points[opposite] - middles) > 0.0
    return _Frames(middles, mean, unit(np.where(inward[:, None], -across, across)))


def _places(leans: tuple[Floats, Floats, Ints], band: tuple[float, float], radius: float) -> Floats:
    """Return the mean degrees at each place of the boundary that has triangles in a band of distances."""
    away, degrees, nearest = leans
    there = (away > band[0] * radius) & (away < band[1] * radius) & np.isfinite(degrees)
    counts = np.bincount(nearest[there])
    means: Floats = np.bincount(nearest[there], weights=degrees[there])[counts > 0] / counts[counts > 0]
    return means


def _end(away: Floats, back: Floats) -> float:
    """Return how far out, in radii, the surroundings bend back by nearly as much as they do at most."""
    steps = (away[away < OUTSIDE[-1][1]] / STEP).astype(int)
    counts = np.bincount(steps)
    means = np.bincount(steps, weights=back[away < OUTSIDE[-1][1]]) / counts.clip(min=1)
    return (int(np.argmax(means >= ENDS * means.max())) + 1) * STEP


def _mean_edge(points: Floats, triangles: Ints) -> float:
    ends = points[bends(points, triangles).edges]
    return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())
