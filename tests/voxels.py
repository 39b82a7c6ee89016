"""Meshes as voxel remeshing makes them: surface nets, whose outlines run in steps of every length."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import fairing

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
AXES = np.eye(3, dtype=np.int64)


@dataclass(frozen=True)
class Net:
    """vertices (n, 3) and triangles (m, 3), wound so that normals point to where the field is positive."""

    vertices: FloatArray
    triangles: IntArray


@dataclass(frozen=True)
class Region:
    """A part of a net: vertices (n, 3), triangles (m, 3), fixed (k,) and normals (k, 3) there."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray


def surface_net(field: Callable[[FloatArray], FloatArray], reach: float, step: float) -> Net:
    """Where `field` (n, 3) → (n,) changes its sign within [−reach, reach]³: a vertex in each cell of width `step` that
    is cut, at the mean of the cuts of its edges, and a quad across each edge that is cut (Gibson 1998)."""
    grid = np.arange(-reach, reach + step, step)
    places = np.stack(np.meshgrid(grid, grid, grid, indexing="ij"), axis=-1)
    values = field(places.reshape(-1, 3)).reshape(places.shape[:3])
    count = len(grid) - 1
    sums, cuts = np.zeros((count, count, count, 3)), np.zeros((count, count, count))
    quads = []
    for axis in range(3):
        others = np.delete(AXES, axis, axis=0)
        first = np.take(values, range(count), axis=axis)
        second = np.take(values, range(1, count + 1), axis=axis)
        cut = (first < 0) != (second < 0)
        edges = np.argwhere(cut)
        edges = edges[(edges > 0).all(axis=1) & (edges < count).all(axis=1)]
        a, b = (level[tuple(edges.T)] for level in (first, second))
        points = grid[edges] + (a / (a - b))[:, None] * step * AXES[axis]
        around = [edges - u * others[0] - v * others[1] for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for cells in around:
            np.add.at(sums, tuple(cells.T), points)
            np.add.at(cuts, tuple(cells.T), 1.0)
        ring = np.stack([np.ravel_multi_index(tuple(cells.T), cuts.shape) for cells in around], axis=1)
        turned = (a < 0) == (axis == 1)
        quads.append(np.where(turned[:, None], ring[:, ::-1], ring))
    used = np.flatnonzero(cuts.ravel())
    number = np.full(cuts.size, -1)
    number[used] = np.arange(len(used))
    rings = number[np.concatenate(quads)]
    vertices = sums.reshape(-1, 3)[used] / cuts.ravel()[used, None]
    return Net(vertices, np.concatenate([rings[:, [0, 1, 2]], rings[:, [0, 2, 3]]]))


def selected(net: Net, chosen: NDArray[np.bool_]) -> Region:
    """The triangles `chosen` (m,), with normals fitted to the others around them."""
    inside, outside = net.triangles[chosen], net.triangles[~chosen]
    used = np.unique(inside)
    fixed = np.intersect1d(used, outside)
    number = np.full(len(net.vertices), -1)
    number[used] = np.arange(len(used))
    normals = fairing.surrounding_normals(net.vertices, outside, fixed).normals
    return Region(net.vertices[used], number[inside], number[fixed], normals)


def post(step: float, radius: float, band: float, level: float = 0.013) -> Region:
    """The seam of a round post on a plate, `band` wide to both sides: plate z = level, post around the z axis."""

    turns = 2 * np.pi * np.arange(48) / 48
    sides = np.stack([np.cos(turns), np.sin(turns)])

    def field(points: FloatArray) -> FloatArray:
        plate = np.maximum(points[:, 2] - level, level - 0.4 - points[:, 2])
        return np.minimum(plate, (points[:, :2] @ sides).max(axis=1) - radius)

    net = surface_net(field, 1.0, step)
    centre = net.vertices[net.triangles].mean(axis=1)
    wall = np.abs(np.linalg.norm(centre[:, :2], axis=1) - radius)
    return selected(net, (np.maximum(wall, np.abs(centre[:, 2] - level)) < band) & (centre[:, 2] > -0.1))
