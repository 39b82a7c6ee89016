"""A closed curve drawn on a picture of a mesh, cut into the mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

import measures
from polygon_mesh import FloatArray, IntArray, Mask


@dataclass(frozen=True)
class Drawn:
    """A closed spline through picture points (k, 2); a picture shows two coordinates of space."""

    points: FloatArray
    shown: tuple[int, int]
    seed: tuple[float, float, float]  # a place on the surface inside

    def signed_distance(self, vertices: FloatArray) -> FloatArray:
        """In the picture, (n,), negative inside."""
        knots = np.vstack([self.points, self.points[:1]])
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])
        curve = CubicSpline(along, knots, bc_type="periodic")(np.linspace(0, along[-1], 4001)[:-1])
        flat = vertices[:, self.shown]
        away = np.asarray(cKDTree(curve).query(flat)[0])
        return np.where(_inside(curve, flat), -away, away)


def _inside(curve: FloatArray, points: FloatArray) -> Mask:
    """Even-odd test of points (k, 2) near or in a polygon."""
    near = ((points > curve.min(axis=0)) & (points < curve.max(axis=0))).all(axis=1)
    inside = np.zeros(len(points), dtype=bool)
    x, y = points[near].T
    crossings = np.zeros(len(x), dtype=np.int64)
    for (ax, ay), (bx, by) in zip(curve, np.roll(curve, -1, axis=0), strict=True):
        if ay != by:
            crossings += ((ay > y) != (by > y)) & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
    inside[near] = crossings % 2 == 1
    return inside


@dataclass(frozen=True)
class Cut:
    """A mesh with a closed curve among its edges.

    vertices (n, 3); triangles (m, 3); inside (m,) bool; curve (k,) its vertices, in order.
    """

    vertices: FloatArray
    triangles: IntArray
    inside: Mask
    curve: IntArray


def cut_along(vertices: FloatArray, triangles: IntArray, drawn: Drawn) -> Cut:
    """Inserts a vertex wherever an edge crosses the curve; one piece, that of the seed, is inside."""
    level = drawn.signed_distance(vertices)
    within = np.zeros(len(vertices), dtype=bool)
    within[_piece(vertices, triangles, level < 0, drawn)] = True
    ends = measures.edges(triangles)
    crossing = ends[within[ends[:, 0]] != within[ends[:, 1]]]
    share = level[crossing[:, 0]] / (level[crossing[:, 0]] - level[crossing[:, 1]])
    share = np.clip(share, 1e-3, 1 - 1e-3)[:, None]
    added = vertices[crossing[:, 0]] + share * (vertices[crossing[:, 1]] - vertices[crossing[:, 0]])
    faces, inside = _split(triangles, within, crossing, len(vertices))
    curve = ordered_loop(measures.border_edges(faces[inside]))
    return Cut(np.vstack([vertices, added]), faces, inside, curve)


def _piece(vertices: FloatArray, triangles: IntArray, within: Mask, drawn: Drawn) -> IntArray:
    """Vertices connected to the seed by edges within."""
    ends = measures.edges(triangles)
    ends = ends[within[ends].all(axis=1)]
    count = len(vertices)
    part = connected_components(coo_array((np.ones(len(ends)), tuple(ends.T)), shape=(count, count)), directed=False)[1]
    candidates = np.flatnonzero(within)
    nearest = candidates[np.linalg.norm(vertices[candidates] - drawn.seed, axis=1).argmin()]
    return np.flatnonzero(part == part[nearest])


def _split(triangles: IntArray, within: Mask, crossing: IntArray, count: int) -> tuple[IntArray, Mask]:
    """Triangles cut in three where they cross, and which lie inside."""
    mixed = within[triangles].any(axis=1) & ~within[triangles].all(axis=1)
    corner = triangles[mixed]
    # The corner alone on its side comes first.
    few = within[corner].sum(axis=1) == 1
    alone = np.argmax(within[corner] == few[:, None], axis=1)
    a, b, c = (corner[np.arange(len(corner)), (alone + k) % 3] for k in range(3))
    key = crossing[:, 0] * count + crossing[:, 1]

    def on(p: IntArray, q: IntArray) -> IntArray:
        return count + np.searchsorted(key, np.minimum(p, q) * count + np.maximum(p, q))

    ab, ac = on(a, b), on(a, c)
    pieces = [np.column_stack(t) for t in ((a, ab, ac), (ab, b, c), (ab, c, ac))]
    whole = triangles[~mixed]
    sides = [within[whole].all(axis=1), within[a], ~within[a], ~within[a]]
    return np.vstack([whole, *pieces]), np.concatenate(sides)


def ordered_loop(border: IntArray) -> IntArray:
    """The vertices of one closed loop of directed edges (k, 2), in order."""
    following = dict(border.tolist())
    loop = [int(border[0, 0])]
    while (after := following.pop(loop[-1])) != loop[0]:
        loop.append(after)
    if following:
        raise ValueError(f"the boundary falls in pieces: {len(following)} edges are left over")
    return np.array(loop)
