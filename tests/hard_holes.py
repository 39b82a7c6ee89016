"""Holes across hard edges of surfaces that are known: box edge and corner, a lid's rim, a bent sheet, profiles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

import creased
import fairing

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Hole:
    """A mesh with a hole."""

    vertices: FloatArray
    triangles: IntArray
    loop: IntArray
    sides: tuple[Callable[[FloatArray], FloatArray], ...]
    """Distances of points (k, 3) to the surfaces that meet."""

    @property
    def size(self) -> float:
        """The length of the box around the hole's outline."""
        return float(np.linalg.norm(np.ptp(self.vertices[self.loop], axis=0)))

    def error(self, points: FloatArray) -> float:
        """The largest distance to the nearest side, over the hole's size."""
        return float(np.min([side(points) for side in self.sides], axis=0).max() / self.size)

    def edge_error(self, points: FloatArray) -> float:
        """The largest distance to any two sides' common edge, over the hole's size."""
        distances = np.sort([side(points) for side in self.sides], axis=0)
        return float(distances[1].max() / self.size)


def cut_out(
    vertices: FloatArray, triangles: IntArray, inside: NDArray[np.bool_], sides: tuple[Callable[..., FloatArray], ...]
) -> Hole:
    """Without the triangles all of whose corners are in the mask, and without vertices that are left over."""
    kept = triangles[~inside[triangles].all(axis=1)]
    used, numbered = np.unique(kept, return_inverse=True)
    kept = numbered.reshape(-1, 3)
    gone = np.searchsorted(used, np.intersect1d(used, triangles[inside[triangles].all(axis=1)]))
    loops = [np.asarray(loop, np.int64) for loop in fairing.boundary_loops(kept)]
    return Hole(vertices[used], kept, next(loop for loop in loops if np.isin(loop, gone).all()), sides)


def in_box_edge(n: int, seed: int = 0, radius: float = 0.3) -> Hole:
    patch = creased.box_edge(n, seed)
    return _around(patch, np.array([0.0, 0.5, 0.0]), radius)


def in_box_corner(n: int, seed: int = 0, radius: float = 0.5) -> Hole:
    return _around(creased.box_corner(n, seed), np.zeros(3), radius)


def in_lid(rings: int, seed: int = 0, radius: float = 0.45) -> Hole:
    return _around(creased.lid(rings, seed), np.array([1.0, 0.0, 0.0]), radius)


def in_bent_sheet(n: int, seed: int = 0, radius: float = 0.3, bend: float = 0.5) -> Hole:
    """The box edge with z shifted by bend · (y − ½)²: a sheet bent to a parabola, and a flat side below it."""
    patch = creased.box_edge(n, seed)
    vertices = patch.vertices.copy()
    height = lambda points: bend * (points[:, 1] - 0.5) ** 2  # noqa: E731
    vertices[:, 2] += height(vertices)
    inside = np.linalg.norm(vertices - [0.0, 0.5, 0.0], axis=1) < radius

    def above(points: FloatArray) -> FloatArray:
        slope = 2 * bend * (points[:, 1] - 0.5)
        return np.abs(points[:, 2] - height(points)) / np.sqrt(1 + slope**2)

    return cut_out(vertices, patch.triangles, inside, (above, lambda points: np.abs(points[:, 0])))


def _around(patch: creased.Creased, centre: FloatArray, radius: float) -> Hole:
    inside = np.linalg.norm(patch.vertices - centre, axis=1) < radius
    return cut_out(patch.vertices, patch.triangles, inside, patch.distances)


def in_profile(profile: list[tuple[float, float]], n: int, seed: int = 0, radius: float = 0.42) -> Hole:
    """A polyline of (x, z) extruded along y, jittered, with random diagonals; the hole lies over its inner corners."""
    corners = np.array(profile)
    lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    along = [k + np.arange(m) / m for k, m in enumerate(np.maximum(2, np.round(lengths * n)).astype(int))]
    u = np.append(np.concatenate(along), len(lengths))
    rng = np.random.default_rng([seed, 9])
    at, y = (a.ravel() for a in np.meshgrid(u, np.arange(n + 1) / n, indexing="ij"))
    inner = (at > 0) & (at < len(lengths)) & (y > 0) & (y < 1)
    y = y + 0.25 / n * rng.uniform(-1, 1, len(y)) * inner
    free = inner & (at != np.round(at))
    side = np.minimum(at.astype(int), len(lengths) - 1)
    at = at + 0.25 / (n * lengths[side]) * rng.uniform(-1, 1, len(at)) * free
    xz = corners[side] + (at - side)[:, None] * (corners[side + 1] - corners[side])
    vertices = np.column_stack([xz[:, 0], y, xz[:, 1]])
    number = np.arange(len(vertices)).reshape(len(u), n + 1)
    a, b, c, d = (x.ravel() for x in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    one = rng.random(len(a)) < 0.5
    triangles = np.concatenate([
        np.column_stack([a, b, np.where(one, c, d)]), np.column_stack([np.where(one, a, b), c, d]),
    ])  # fmt: skip
    middle = corners[1:-1].mean(axis=0)
    inside = np.linalg.norm(vertices - [middle[0], 0.5, middle[1]], axis=1) < radius
    return cut_out(vertices, triangles, inside, tuple(_plane(p, q) for p, q in pairwise(corners)))


def _plane(p: FloatArray, q: FloatArray) -> Callable[[FloatArray], FloatArray]:
    across = np.array([p[1] - q[1], q[0] - p[0]]) / np.linalg.norm(q - p)
    return lambda points: np.abs((points[:, [0, 2]] - p) @ across)


def in_bevel(
    n: int, seed: int = 0, *, radius: float = 0.12, rows: int = 0, taper: float = 0.0, bend: float = 0.0
) -> Hole:
    """A plane and a wall that meet in a quarter circle of the radius, with a hole over it; jittered, n edges a unit.

    rows: across it; 0: as long as the other edges. taper: the radius grows by as much to one end and shrinks to the
    other. bend: curvature of the wall, which is a cylinder then, and the edge rolled around it.
    """
    rng = np.random.default_rng([seed, 3])
    rows = rows or max(2, round(radius * np.pi / 2 * n))
    at = np.concatenate([np.arange(-n, 0) / n, np.arange(rows) / rows, 1 + np.arange(n + 1) / n])
    u, y = (a.ravel() for a in np.meshgrid(at, np.arange(n + 1) / n, indexing="ij"))
    inner = (u > -1) & (u < 2) & (y > 0) & (y < 1)
    step = np.where((u > 0) & (u < 1), 1 / rows, 1 / n) * (np.abs(u * (u - 1)) > 1e-9)
    u = u + 0.25 * step * rng.uniform(-1, 1, len(u)) * inner
    y = y + 0.25 / n * rng.uniform(-1, 1, len(y)) * inner

    def radius_at(y: FloatArray) -> FloatArray:
        return radius * (1 + taper * (2 * y - 1))

    r, angle = radius_at(y), np.clip(u, 0, 1) * np.pi / 2
    x = r * (np.sin(angle) - 1) + np.minimum(u, 0)
    z = r * (np.cos(angle) - 1) - np.maximum(u - 1, 0)
    number = np.arange(len(u)).reshape(len(at), n + 1)
    a, b, c, d = (v.ravel() for v in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    one = rng.random(len(a)) < 0.5
    triangles = np.concatenate([
        np.column_stack([a, b, np.where(one, c, d)]), np.column_stack([np.where(one, a, b), c, d]),
    ])  # fmt: skip
    flat = np.column_stack([x, y - 0.5, z])
    vertices = _bent(flat, bend) if bend else flat

    def distance(points: FloatArray) -> FloatArray:
        out, along, high = (_unbent(points, bend) if bend else points).T
        r = radius_at(along + 0.5)
        rolled = np.abs(np.hypot(out + r, high + r) - r)
        return np.where((out > -r) & (high > -r), rolled, np.minimum(np.abs(out), np.abs(high)))

    inside = np.linalg.norm(vertices - [-0.3 * radius, 0.0, -0.3 * radius], axis=1) < 0.4
    return cut_out(vertices, triangles, inside, (distance,))


def _bent(points: FloatArray, bend: float) -> FloatArray:
    """The plane x = 0 becomes a cylinder around the z axis through (−1 / bend, 0), y the length along it."""
    out, along, high = points.T
    reach, turn = 1 / bend + out, along * bend
    return np.column_stack([reach * np.cos(turn) - 1 / bend, reach * np.sin(turn), high])


def _unbent(points: FloatArray, bend: float) -> FloatArray:
    x, y, high = points.T
    sign = np.sign(bend)
    out = sign * np.hypot(x + 1 / bend, y) - 1 / bend
    return np.column_stack([out, np.arctan2(sign * y, sign * (x + 1 / bend)) / bend, high])
