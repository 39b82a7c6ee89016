"""UVs of new faces: those of the faces around go on, each island by itself, with seams between them. No bpy.

Numbers of vertices are those of the new surface, r of the boundary first. An edge of the boundary goes by its tail, a
corner of a triangle by 3 · the triangle + its place there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.harmonic import harmonic
from ..arrays.nearest_source import nearest_sources, owners
from ..arrays.places import sum_at
from ..arrays.types import Floats, Ints, Mask
from ..verdict.quality import texture_distortion
from .faces import inner_edges

SAME = 1e-6  # of UVs that are meant to be one
MOST_STRETCHED = 0.5  # of the texture distortion that a single island between several boundary loops may have


@dataclass(frozen=True)
class Surface:
    """New triangles and the boundary that they begin at."""

    points: Floats  # (r + k, 3)
    triangles: Ints  # (m, 3)
    loops: tuple[Ints, ...]  # each a part of 0 … r − 1, in the direction of the triangles' edges


@dataclass(frozen=True)
class RimUVs:
    """UVs of the faces around, at the r vertices of the boundary."""

    after: Floats  # (r, 2) in the face at the edge that begins there
    before: Floats  # (r, 2) in the face at the edge that ends there
    mirrored: Mask  # (r,) whether the face at the edge that begins there is turned over in the texture

    @property
    def broken(self) -> Mask:
        """Where a seam reaches the boundary."""
        found: Mask = (np.abs(self.after - self.before) > SAME).any(axis=1)
        return found


@dataclass(frozen=True)
class Unwrapped:
    """UVs of new triangles."""

    corners: Floats  # (3 m, 2)
    seams: Ints  # (s, 2) inner edges where they part
    distortion: float  # see quality.texture_distortion


@dataclass(frozen=True)
class _Parting:
    """Which new triangles go on from which part of the boundary."""

    seams: Ints  # (s, 2) inner edges
    edges: Ints  # (m,) of the boundary: the one whose island each triangle goes on with
    arcs: Ints  # (r,) numbers of the pieces of the boundary between seams that reach it
    places: Ints  # (r,) along its arc: pieces further apart than 1 don't hang together

    def joined(self, edges: Ints, others: Ints) -> Mask:
        """Return whether the islands of such edges of the boundary hang together."""
        near = np.abs(self.places[edges] - self.places[others]) <= 1
        found: Mask = near & (self.arcs[edges] == self.arcs[others])
        return found


def unwrapped(surface: Surface, rim: RimUVs) -> Unwrapped:
    """Continue the UVs of the faces around.

    One map where no seam meets the boundary; else each island goes on to where the next one is nearer.
    """
    whole = _whole(surface, rim)
    if whole is not None and (len(surface.loops) == 1 or whole.distortion <= MOST_STRETCHED):
        return whole
    parted = _mapped(surface, rim, _parted(surface, rim))
    return parted if whole is None or parted.distortion < whole.distortion else whole


def _whole(surface: Surface, rim: RimUVs) -> Unwrapped | None:
    """Return a single map between all boundary loops; None where seams part it."""
    broken = np.flatnonzero(rim.broken)
    if not len(broken):
        inside = harmonic(surface.points, surface.triangles, rim.after)
        corners = np.concatenate([rim.after, inside])[surface.triangles.ravel()]
        return Unwrapped(corners, surface.triangles[:0, :2], _distortion(surface, corners))
    if len(broken) != 2 or len(surface.loops) != 2 or len(np.intersect1d(broken, surface.loops[0])) != 1:
        return None
    nowhere, alike = np.zeros(len(surface.triangles), np.int64), np.zeros(len(rim.after), np.int64)
    return _mapped(surface, rim, _Parting(_way(surface, *broken.tolist()), nowhere, alike, alike))


def _way(surface: Surface, start: int, end: int) -> Ints:
    """Return the (s, 2) inner edges of the shortest path between two vertices."""
    edges, _ = inner_edges(surface.triangles)
    lengths = np.linalg.norm(surface.points[edges[:, 0]] - surface.points[edges[:, 1]], axis=1)
    before = nearest_sources(len(surface.points), edges, lengths, np.array([start]))
    path = [end]
    while path[-1] != start:
        path.append(int(before[path[-1]]))
    return np.sort(np.stack([path[:-1], path[1:]], axis=1), axis=1)


def _parted(surface: Surface, rim: RimUVs) -> _Parting:
    """Let each triangle go on with the part of the boundary that it is nearest to."""
    arcs, places = _arcs(surface, rim)
    edges, sides = inner_edges(surface.triangles)
    of = _nearest_edges(surface, sides)
    parting = _Parting(edges, of, arcs, places)
    return replace(parting, seams=edges[~parting.joined(of[sides[:, 0]], of[sides[:, 1]])])


def _arcs(surface: Surface, rim: RimUVs) -> tuple[Ints, Ints]:
    """Return (r,) and (r,): the arc of each edge of the boundary, and its place there.

    A loop with one seam is an arc that ends where it begins. It has three places, of which the first and the last are
    parted.
    """
    arcs, places = np.zeros((2, len(rim.after)), dtype=np.int64)
    count = 0
    for loop in surface.loops:
        starts = np.flatnonzero(rim.broken[loop])
        turned = np.roll(loop, -starts[0]) if len(starts) else loop
        arcs[turned] = count + np.maximum(np.cumsum(rim.broken[turned]) - 1, 0)
        if len(starts) == 1:
            places[turned] = 3 * np.arange(len(turned)) // len(turned)
        count = int(arcs.max(initial=0)) + 1
    return arcs, places


def _nearest_edges(surface: Surface, sides: Ints) -> Ints:
    """Return (m,): the edge of the boundary that each triangle is nearest to, over the triangles between."""
    middles = surface.points[surface.triangles].mean(axis=1)
    lengths = np.linalg.norm(middles[sides[:, 0]] - middles[sides[:, 1]], axis=1)
    corners, tails = _at_boundary(surface)
    tail_of = np.zeros(len(surface.triangles), dtype=np.int64)
    tail_of[corners // 3] = tails
    return tail_of[owners(nearest_sources(len(middles), sides, lengths, np.unique(corners // 3)))]


def _at_boundary(surface: Surface) -> tuple[Ints, Ints]:
    """Return the corners of triangles where edges of the boundary begin, and these edges."""
    following = np.full(len(surface.points), -1, dtype=np.int64)
    for loop in surface.loops:
        following[loop] = np.roll(loop, -1)
    heads = np.roll(surface.triangles, -1, axis=1).ravel()
    corners = np.flatnonzero(following[surface.triangles.ravel()] == heads)
    return corners, surface.triangles.ravel()[corners]


def _mapped(surface: Surface, rim: RimUVs, parting: _Parting) -> Unwrapped:
    """Return the least distorted map of the triangles that has the boundary's UVs and is cut at the seams."""
    wedges, count = _wedges(surface.triangles, parting.seams)
    corners, tails = _at_boundary(surface)
    own = parting.joined(parting.edges[corners // 3], tails)
    corners, tails = corners[own], tails[own]
    ends = 3 * (corners // 3) + (corners + 1) % 3
    held = np.concatenate([wedges[corners], wedges[ends]])
    given = np.concatenate([rim.after[tails], rim.before[surface.triangles.ravel()[ends]]])
    fixed, place = np.unique(held, return_inverse=True)
    values = sum_at(place, given, len(fixed)) / np.bincount(place)[:, None]
    turn = np.ones((count, 2))
    turn[wedges, 0] = np.repeat(_turns(rim, parting), 3)
    points = np.empty((count, 3))
    points[wedges] = surface.points[surface.triangles.ravel()]
    flat = turn * fairing.maps.conformal_map(points, wedges.reshape(-1, 3), fixed, turn[fixed] * values)
    return Unwrapped(flat[wedges], parting.seams, _distortion(surface, flat[wedges]))


def _turns(rim: RimUVs, parting: _Parting) -> Floats:
    """Return (m,): −1 for triangles whose island is turned over in the texture, else 1."""
    turned = np.bincount(parting.arcs, weights=np.where(rim.mirrored, 1.0, -1.0)) > 0.0
    return np.where(turned[parting.arcs[parting.edges]], -1.0, 1.0)


def _wedges(triangles: Ints, seams: Ints) -> tuple[Ints, int]:
    """Return (3 m,): equal numbers for corners at one vertex that no seam parts; and how many there are."""
    edges, sides = inner_edges(triangles)
    count = int(triangles.max(initial=0)) + 1
    open_edges = ~np.isin(edges @ [count, 1], seams @ [count, 1])
    edges, sides = edges[open_edges], sides[open_edges]
    first, second = (
        np.concatenate([3 * side + (triangles[side] == end[:, None]).argmax(axis=1) for end in edges.T])
        for side in sides.T
    )
    number = np.arange(triangles.size)
    while True:
        least = number.copy()
        np.minimum.at(least, first, number[second])
        np.minimum.at(least, second, number[first])
        if (least == number).all():
            break
        number = least[least]
    _, wedges = np.unique(number, return_inverse=True)
    return wedges.ravel().astype(np.int64), int(wedges.max(initial=-1)) + 1


def _distortion(surface: Surface, corners: Floats) -> float:
    flat = np.column_stack([corners, np.zeros(len(corners))])
    apart = np.arange(len(corners)).reshape(-1, 3)
    return texture_distortion(surface.points[surface.triangles.ravel()], flat, apart)
