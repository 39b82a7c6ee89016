"""Surfaces with creases: exact positions, outline normals, and the curves on which two sides meet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

import measures
from curves import FloatArray
from meshing import IntArray

Distance = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Creased:
    """A patch (n, 3), (m, 3) that is held along its outline and along a curve inside.

    Exact surfaces: side k has `distances[k]`, and `side` (n,) tells which of them each vertex lies on.
    """

    vertices: FloatArray
    triangles: IntArray
    outline: IntArray
    curve: IntArray  # inside, and its ends on the outline
    normals: FloatArray  # (n, 3) of the exact sides; unimportant on the curve
    side: IntArray
    distances: tuple[Distance, ...] = field(default=())

    @property
    def fixed(self) -> IntArray:
        return np.union1d(self.outline, self.curve)

    @property
    def free(self) -> IntArray:
        return np.setdiff1d(np.arange(len(self.vertices)), self.fixed)

    @property
    def size(self) -> float:
        """D."""
        held = self.vertices[self.fixed]
        return 2.0 * float(np.linalg.norm(held - held.mean(axis=0), axis=1).max())

    def noisy(self, amount: float, seed: int = 0) -> FloatArray:
        """Free vertices thrown by a share of the mean edge, in all directions."""
        ends = self.vertices[measures.edges(self.triangles)]
        edge = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()
        result = self.vertices.copy()
        result[self.free] += amount * edge * np.random.default_rng(seed).normal(size=(len(self.free), 3))
        return result

    def error(self, vertices: FloatArray) -> float:
        """Largest distance of a free vertex to its own side, over D."""
        worst = 0.0
        for k, distance in enumerate(self.distances):
            own = self.free[self.side[self.free] == k]
            worst = max(worst, float(distance(vertices[own]).max(initial=0.0)))
        return worst / self.size


def _grid(st: FloatArray, shape: tuple[int, int], held: FloatArray, seed: int) -> tuple[FloatArray, IntArray]:
    """Parameters (n, 2) shaken where they aren't held, and triangles with random diagonals."""
    rng = np.random.default_rng([seed, 5])
    rows, columns = shape
    number = np.arange(rows * columns).reshape(shape)
    a, b, c, d = (x.ravel() for x in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    one = rng.random(len(a)) < 0.5
    triangles = np.concatenate([
        np.column_stack([a, b, np.where(one, c, d)]), np.column_stack([np.where(one, a, b), c, d]),
    ])  # fmt: skip
    step = np.abs(st[1] - st[0]).max()
    shaken = st + 0.25 * step * rng.uniform(-1, 1, st.shape) * ~held[:, None]
    return shaken, triangles


def _plane(axis: int) -> Distance:
    return lambda points: np.abs(points[:, axis])


def box_edge(n: int, seed: int = 0, *, cut: float = 1.0) -> Creased:
    """Two squares of n × n cells at a right angle; the curve is their common edge, or the share `cut` of it."""
    s, t = (x.ravel() for x in np.meshgrid(np.linspace(-1, 1, 2 * n + 1), np.linspace(0, 1, n + 1), indexing="ij"))
    outline = (np.abs(s) > 1 - 1e-9) | (t < 1e-9) | (t > 1 - 1e-9)
    st, triangles = _grid(np.column_stack([s, t]), (2 * n + 1, n + 1), outline | (np.abs(s) < 1e-9), seed)
    s, t = st.T
    zero = np.zeros_like(s)
    vertices = np.column_stack([np.minimum(s, 0.0), t, -np.maximum(s, 0.0)])
    normals = np.where((s < 0)[:, None], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    curve = np.flatnonzero((np.abs(s) < 1e-9) & (t <= cut + 1e-9))
    side = np.where(s < 0, 0, 1)
    del zero
    return Creased(vertices, triangles, np.flatnonzero(outline), curve, normals, side, (_plane(2), _plane(0)))


def box_corner(n: int, seed: int = 0) -> Creased:
    """Three squares of n × n cells that meet in a corner of a box; the curve are its three edges."""
    parts, faces, count = [], [], 0
    for axis in range(3):
        u, v = (x.ravel() for x in np.meshgrid(np.linspace(-1, 0, n + 1), np.linspace(-1, 0, n + 1), indexing="ij"))
        held = (u < -1 + 1e-9) | (v < -1 + 1e-9) | (u > -1e-9) | (v > -1e-9)
        st, triangles = _grid(np.column_stack([u, v]), (n + 1, n + 1), held, seed + axis)
        points = np.zeros((len(u), 3))
        points[:, (axis + 1) % 3], points[:, (axis + 2) % 3] = st.T
        parts.append(points)
        faces.append(triangles + count)
        count += len(u)
    points = np.concatenate(parts)
    _, first, number = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    points, triangles = points[first], number.ravel()[np.concatenate(faces)]
    zero = np.abs(points) < 1e-9
    side = np.argmax(zero, axis=1)
    outline = (points < -1 + 1e-9).any(axis=1)
    curve = zero.sum(axis=1) >= 2
    return Creased(
        points, triangles, np.flatnonzero(outline), np.flatnonzero(curve), np.eye(3)[side], side,
        tuple(_plane(axis) for axis in range(3)),
    )  # fmt: skip


def lid(rings: int, seed: int = 0, *, depth: float = 0.8) -> Creased:
    """A disc of radius 1 on a cylinder; the curve is the rim, the outline the circle at −depth."""
    rng = np.random.default_rng([seed, 6])
    places = [np.zeros((1, 2))]
    for k in range(1, rings + 1):
        angle = 2 * np.pi * np.arange(6 * k) / (6 * k)
        ring = k / rings * np.column_stack([np.cos(angle), np.sin(angle)])
        places.append(ring + (k < rings) * 0.2 / rings * rng.uniform(-1, 1, ring.shape))
    disc = np.concatenate(places)
    around = 6 * rings
    triangles = _delaunay(disc)
    rows = max(2, round(depth * around / (2 * np.pi)))
    angle = np.tile(2 * np.pi * np.arange(around) / around, rows)
    row = np.repeat(np.arange(1, rows + 1), around)
    inside = row < rows
    angle = angle + inside * 0.25 * 2 * np.pi / around * rng.uniform(-1, 1, len(angle))
    z = -depth * (row + inside * 0.25 * rng.uniform(-1, 1, len(row))) / rows
    side_points = np.column_stack([np.cos(angle), np.sin(angle), z])
    rim = np.arange(len(disc) - around, len(disc))
    number = np.vstack([rim, len(disc) + np.arange(rows * around).reshape(rows, around)])
    a, b = number[:-1].ravel(), np.roll(number[:-1], -1, axis=1).ravel()
    c, d = number[1:].ravel(), np.roll(number[1:], -1, axis=1).ravel()
    one = rng.random(len(a)) < 0.5
    walls = np.concatenate([
        np.column_stack([a, c, np.where(one, d, b)]), np.column_stack([np.where(one, a, c), d, b]),
    ])  # fmt: skip
    vertices = np.vstack([np.column_stack([disc, np.zeros(len(disc))]), side_points])
    normals = np.vstack([np.tile([0.0, 0.0, 1.0], (len(disc), 1)), side_points * [1.0, 1.0, 0.0]])
    side = np.concatenate([np.zeros(len(disc), int), np.ones(len(side_points), int)])
    return Creased(
        vertices, np.vstack([triangles, walls]), np.arange(len(vertices) - around, len(vertices)), rim, normals, side,
        (_plane(2), lambda points: np.abs(np.linalg.norm(points[:, :2], axis=1) - 1.0)),
    )  # fmt: skip


def _delaunay(points: FloatArray) -> IntArray:
    from scipy.spatial import Delaunay

    triangles = Delaunay(points).simplices.astype(np.int64)
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    return triangles[np.abs(area) > 1e-12]


def fading_fold(n: int, seed: int = 0, *, steep: float = 0.6) -> Creased:
    """z = −steep |s| (1 − 2 t)² up to t = ½, flat beyond: the curve is the fold, which ends in the middle."""
    s, t = (x.ravel() for x in np.meshgrid(np.linspace(-1, 1, 2 * n + 1), np.linspace(0, 1, n + 1), indexing="ij"))
    outline = (np.abs(s) > 1 - 1e-9) | (t < 1e-9) | (t > 1 - 1e-9)
    curve = (np.abs(s) < 1e-9) & (t <= 0.5 + 1e-9)
    st, triangles = _grid(np.column_stack([s, t]), (2 * n + 1, n + 1), outline | curve, seed)
    s, t = st.T
    fold = np.maximum(1 - 2 * t, 0.0)
    vertices = np.column_stack([s, t, -steep * np.abs(s) * fold**2])
    slope = np.column_stack([steep * np.sign(s) * fold**2, -4 * steep * np.abs(s) * fold, np.ones_like(s)])
    normals = slope / np.linalg.norm(slope, axis=1)[:, None]
    return Creased(vertices, triangles, np.flatnonzero(outline), np.flatnonzero(curve), normals, (s > 0).astype(int))
