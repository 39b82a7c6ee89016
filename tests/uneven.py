"""Blends on uneven meshes: other densities on each bridge, graded towards one seam, stretched, edges flipped at random.

A bridge is what joins two neighbouring rims: a strip from half of one to half of the next. Three of them, glued along
seams that run from each rim to a pole above and one below, are the three-cylinder blend (`blend`), or a corner of the
tetrathing. Of the six arms (`six_arms`) each octant has a density of its own; their rims and sides stay even.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import Delaunay, cKDTree

import blend
import six_arms
from blend import Blend, IntArray
from connectivity import shuffled
from curves import FloatArray
from domains import thinned
from shapes import membrane

DENSITIES = (0.6, 1.0, 1.7)  # columns of neighbouring bridges
STRETCH = 2.5  # rows' distance over the columns'
GRADING = 3.0  # of the columns' distances from one seam to the other
JITTER = 0.6
LENGTH = 1.5  # of a bridge, over half a rim
FLIPS = 0.25  # share of the edges that are tried for a flip, and mostly flipped


@dataclass(frozen=True)
class Rim:
    """A circle seen from the blend: its centre, the directions to the upper pole and to the bridge after it."""

    centre: FloatArray
    up: FloatArray
    side: FloatArray
    radius: float

    def normals(self, angle: FloatArray) -> FloatArray:
        """(k, 3) at angles from `up` towards `side`."""
        return np.asarray(np.cos(angle)[:, None] * self.up + np.sin(angle)[:, None] * self.side)


def cylinder_rims(reach: float = 2.0) -> list[Rim]:
    """Those of `blend.cylinder_blend`."""
    up = np.array([0.0, 0.0, 1.0])
    axes = [np.array([np.cos(angle), np.sin(angle), 0.0]) for angle in blend.DIRECTIONS]
    return [Rim(reach * axis, up, np.cross(up, axis), 1.0) for axis in axes]


def tetrathing_rims(radius: float = 0.35) -> list[Rim]:
    """Those of the corner of the tetrathing at (1, 1, 1)."""
    corner = np.ones(3)
    rims = []
    for node in (np.array([1.0, -1, -1]), np.array([-1.0, 1, -1]), np.array([-1.0, -1, 1])):
        middle, axis = 0.5 * (corner + node), (node - corner) / np.linalg.norm(node - corner)
        up = middle / np.linalg.norm(middle)
        rims.append(Rim(middle, up, np.cross(up, axis), radius))
    return rims


def graded(count: int, grading: float) -> FloatArray:
    """count + 1 shares from 0 to 1 whose distances grow geometrically by `grading` in all."""
    widths = grading ** (np.arange(count) / max(count - 1, 1))
    return np.concatenate([[0.0], np.cumsum(widths)]) / widths.sum()


class _Strips:
    """Numbers of the vertices: the poles, the seams, the rims' other vertices, the insides of the bridges."""

    def __init__(self, columns: list[int], rows: int) -> None:
        self.rows, self.half = rows, rows // 2
        self.count = 2 + 6 * self.half
        self.first_on_rim: list[list[int]] = []
        for columns_of_bridge in columns:
            self.first_on_rim.append([self.count, self.count + columns_of_bridge - 1])
            self.count += 2 * (columns_of_bridge - 1)

    def seam(self, bridge: int, below: int, row: int) -> int:
        """On the upper or lower seam of a bridge: from its own rim (row 0) by the pole to the next rim."""
        rim, away = (bridge, row) if row <= self.half else ((bridge + 1) % 3, self.rows - row)
        return below if away == self.half else 2 + (2 * rim + below) * self.half + away

    def border(self, bridge: int, columns: int) -> tuple[IntArray, IntArray]:
        """Numbers, and their (column, row), round a bridge."""
        numbers, places = [], []
        for row in range(self.rows + 1):
            for below, column in ((0, 0), (1, columns)):
                numbers.append(self.seam(bridge, below, row))
                places.append((column, row))
        for end, row in ((0, 0), (1, self.rows)):
            for column in range(1, columns):
                numbers.append(self.first_on_rim[bridge][end] + column - 1)
                places.append((column, row))
        return np.array(numbers), np.array(places)


def bridged(n_free: int, rims: list[Rim], seed: int = 0, *, evenly: bool = False) -> Blend:
    """Three bridges between three rims, in the order of the rims, with about n_free free vertices."""
    rng = np.random.default_rng([seed, 17])
    densities = [1.0, 1.0, 1.0] if evenly else [DENSITIES[k] for k in rng.permutation(3)]
    mean = np.sqrt(n_free * (1.0 if evenly else STRETCH) / LENGTH / 3)
    columns = [max(4, round(mean * density / np.mean(densities))) for density in densities]
    rows = max(4, 2 * round(n_free / sum(columns) / 2))
    strips = _Strips(columns, rows)
    count, triangles = strips.count, []
    for k in range(3):
        numbers, places = strips.border(k, columns[k])
        inner = _shaken(columns[k], rows, 0.1 * JITTER if evenly else JITTER, rng)
        triangles.append(_strip(np.concatenate([numbers, count + np.arange(len(inner))]), np.vstack([places, inner])))
        count += len(inner)
    fixed, normals, centres = _on_rims(strips, columns, rims, 1.0 if evenly else GRADING)
    vertices = np.zeros((count, 3))
    vertices[fixed] = centres + rims[0].radius * normals
    faces = shuffled(np.vstack(triangles), fixed, 0.0 if evenly else FLIPS, seed)
    return Blend(membrane(vertices, faces, fixed), faces, fixed, normals)


def _shaken(columns: int, rows: int, jitter: float, rng: np.random.Generator) -> FloatArray:
    i, j = np.meshgrid(np.arange(1, columns), np.arange(1, rows))
    lattice = np.column_stack([i.ravel(), j.ravel()]).astype(float)
    return np.asarray(lattice + jitter * (rng.random(lattice.shape) - 0.5))


def _strip(numbers: IntArray, places: FloatArray) -> IntArray:
    """Delaunay triangles in units of columns and rows, counter-clockwise from outside."""
    triangles = Delaunay(places).simplices.astype(np.int64)
    a, b, c = (places[triangles[:, k]] for k in range(3))
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    triangles = np.where((doubled > 0)[:, None], triangles, triangles[:, ::-1])
    return np.asarray(numbers[triangles[np.abs(doubled) > 1e-9]])


def _on_rims(
    strips: _Strips, columns: list[int], rims: list[Rim], grading: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Fixed vertices, normals and centres: each rim's two seams and its half of the bridges after and before it."""
    fixed, normals, centres = [], [], []
    for k, rim in enumerate(rims):
        after, before = k, (k + 2) % 3
        angles = [0.0, np.pi]
        numbers = [strips.seam(k, 0, 0), strips.seam(k, 1, 0)]
        for bridge, end, way in ((after, 0, 1.0), (before, 1, -1.0)):
            angles += list(way * np.pi * graded(columns[bridge], grading)[1:-1])
            numbers += range(strips.first_on_rim[bridge][end], strips.first_on_rim[bridge][end] + columns[bridge] - 1)
        fixed.append(np.array(numbers))
        normals.append(rim.normals(np.array(angles)))
        centres.append(np.broadcast_to(rim.centre, normals[-1].shape))
    return np.concatenate(fixed), np.vstack(normals), np.vstack(centres)


def cylinder_blend(n_free: int, *, seed: int = 0) -> Blend:
    """The three-cylinder blend."""
    return bridged(n_free, cylinder_rims(), seed)


def tetrathing_corner(n_free: int, *, seed: int = 0) -> Blend:
    """One corner of the tetrathing; the other three are the same, and each is a solve of its own."""
    return bridged(n_free, tetrathing_rims(), seed)


def arms(n_free: int, *, seed: int = 0, reach: float = 2.5) -> Blend:
    """The six arms, each octant with a density of its own."""
    h = float(np.sqrt(8 * six_arms.area(reach) / (0.5 * np.sqrt(3) * n_free)))
    for _ in range(10):
        rng = np.random.default_rng([seed, 19])
        made = six_arms.of_octants(h, reach, _octants(h, rng))
        made = replace(made, triangles=shuffled(made.triangles, made.fixed, FLIPS, seed))
        count = len(made.vertices) - len(made.fixed)
        if abs(count - n_free) < 0.02 * n_free:
            break
        h *= float(np.sqrt(count / n_free))
    return made


def _octants(h: float, rng: np.random.Generator) -> Callable[[FloatArray], FloatArray]:
    turn = iter(range(8))

    def points(outline: FloatArray) -> FloatArray:
        k = next(turn)
        angle = 2 * np.pi / 3 * k
        along = np.array([np.cos(angle), np.sin(angle)])
        return _octant(outline, along, h / DENSITIES[k % len(DENSITIES)], rng)

    return points


def _octant(outline: FloatArray, along: FloatArray, width: float, rng: np.random.Generator) -> FloatArray:
    """Points (k, 2) in the polygon: columns of that mean width, graded in the direction `along`, rows stretched."""
    axes = np.array([along, [-along[1], along[0]]])
    low, high = (outline @ axes.T).min(axis=0), (outline @ axes.T).max(axis=0)
    shares = graded(max(2, round((high[0] - low[0]) / width)), GRADING)
    rows = max(2, round((high[1] - low[1]) / (STRETCH * width)))
    lattice = _shaken(len(shares) - 1, rows, JITTER, rng)
    q = np.interp(lattice[:, 0], np.arange(len(shares)), shares)
    points = (low + np.column_stack([q, lattice[:, 1] / rows]) * (high - low)) @ axes
    edges = np.vstack([outline + s * (np.roll(outline, -1, 0) - outline) for s in (0, 0.33, 0.67)])
    points = points[cKDTree(edges).query(points)[0] > 0.6 * width]
    points = points[blend.inside(outline, points)]
    return np.asarray(points[thinned(points, np.full(len(points), 0.3 * width))])
