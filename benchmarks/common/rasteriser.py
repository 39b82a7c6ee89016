"""A z-buffer in numpy: which triangle a pixel shows, and where in it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]
CHUNK = 3_000_000  # candidate pixels at a time: some 400 MB


@dataclass(frozen=True)
class View:
    """An orthographic camera: looks at `target` from `direction`, `width` units across."""

    target: tuple[float, float, float]
    direction: tuple[float, float, float]
    width: float
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    aspect: float = 1.0  # height over width

    @property
    def axes(self) -> FloatArray:
        """Rows: right, up and towards the viewer, orthonormal."""
        back = np.asarray(self.direction) / np.linalg.norm(self.direction)
        right = np.cross(self.up, back)
        right /= np.linalg.norm(right)
        return np.array([right, np.cross(back, right), back])

    def project(self, points: FloatArray, pixels: int) -> FloatArray:
        """Column, row (from the top) and depth (towards the viewer) of points (n, 3), in pixels."""
        scale = pixels / self.width
        local = (points - np.asarray(self.target)) @ self.axes.T * scale
        centre = np.array([0.5 * pixels, 0.5 * round(pixels * self.aspect)])
        return np.column_stack([local[:, 0] + centre[0], centre[1] - local[:, 1], local[:, 2]])


@dataclass(frozen=True)
class Fragments:
    """Per pixel of a picture (h, w): triangle (−1: none) and barycentric coordinates (h, w, 3)."""

    triangle: IntArray
    weights: FloatArray

    @property
    def covered(self) -> Mask:
        """Pixels that show a triangle, (h, w)."""
        return np.asarray(self.triangle >= 0)


def rasterise(projected: FloatArray, triangles: IntArray, shape: tuple[int, int]) -> Fragments:
    """Nearest triangles at the pixel centres of a picture of (height, width) pixels."""
    height, width = shape
    depth = np.full(height * width, -np.inf)
    owner = np.full(height * width, -1, dtype=np.int64)
    weights = np.zeros((height * width, 3))
    corners = projected[triangles]
    for rows in _chunks(corners, shape):
        which, pixel, inside = _candidates(corners, rows, shape)
        near = (inside * corners[which, :, 2]).sum(axis=1)
        order = np.argsort(near, kind="stable")
        order = order[near[order] > depth[pixel[order]]]
        # The nearest is assigned last and stays.
        depth[pixel[order]] = near[order]
        owner[pixel[order]] = which[order]
        weights[pixel[order]] = inside[order]
    return Fragments(owner.reshape(shape), weights.reshape(height, width, 3))


def averaged(picture: FloatArray, times: int) -> FloatArray:
    """Means of times² pixels."""
    height, width = picture.shape[0] // times, picture.shape[1] // times
    kept = picture[: height * times, : width * times].reshape(height, times, width, times, 3)
    return np.asarray(kept.mean(axis=(1, 3)))


def edge_distances(projected: FloatArray, triangles: IntArray, fragments: Fragments) -> FloatArray:
    """Pixels (k, 3) from the covered pixels to the edge opposite each corner of their triangles."""
    a, b, c = (projected[triangles[:, k], :2] for k in range(3))
    doubled = np.abs(_cross(b - a, c - a))
    lengths = np.stack([np.linalg.norm(p - q, axis=1) for p, q in ((b, c), (c, a), (a, b))], axis=1)
    heights = doubled[:, None] / np.maximum(lengths, 1e-9)
    return np.asarray(fragments.weights[fragments.covered] * heights[fragments.triangle[fragments.covered]])


def _boxes(corners: FloatArray, shape: tuple[int, int]) -> tuple[IntArray, IntArray]:
    """First pixel (m, 2) and number of pixels (m, 2) of each triangle's box, clipped to the picture."""
    limit = np.array([shape[1], shape[0]])
    low = np.clip(np.ceil(corners[:, :, :2].min(axis=1) - 0.5), 0, limit)
    high = np.clip(np.floor(corners[:, :, :2].max(axis=1) - 0.5) + 1, 0, limit)
    return low.astype(np.int64), np.maximum(high - low, 0).astype(np.int64)


def _chunks(corners: FloatArray, shape: tuple[int, int]) -> Iterator[IntArray]:
    """Triangle indices in portions of about CHUNK pixels."""
    _, size = _boxes(corners, shape)
    pixels = np.cumsum(size.prod(axis=1))
    portion = pixels // CHUNK
    for value in np.unique(portion):
        yield np.flatnonzero(portion == value)


def _candidates(corners: FloatArray, rows: IntArray, shape: tuple[int, int]) -> tuple[IntArray, IntArray, FloatArray]:
    """Triangle, flat pixel index and barycentric coordinates of all pixels inside the triangles."""
    low, size = _boxes(corners[rows], shape)
    count = size.prod(axis=1)
    owner = np.repeat(np.arange(len(rows)), count)
    step = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    across = np.maximum(size[owner, 0], 1)
    x, y = low[owner, 0] + step % across, low[owner, 1] + step // across
    weights = _barycentric(corners[rows], owner, np.column_stack([x, y]) + 0.5)
    keep = (weights >= 0).all(axis=1)
    return rows[owner[keep]], (y * shape[1] + x)[keep], weights[keep]


def _barycentric(corners: FloatArray, owner: IntArray, points: FloatArray) -> FloatArray:
    """Of points (k, 2) in their triangles; −1 where the triangle is seen edge-on."""
    a, b, c = (corners[:, k, :2] for k in range(3))
    doubled = _cross(b - a, c - a)
    scale = np.where(np.abs(doubled) > 1e-9, 1.0 / np.where(doubled == 0, 1.0, doubled), 0.0)[owner]
    beta = _cross(points - a[owner], (c - a)[owner]) * scale
    gamma = _cross((b - a)[owner], points - a[owner]) * scale
    flat = np.where(scale == 0, -1.0, 0.0)
    return np.column_stack([1 - beta - gamma, beta, gamma]) + flat[:, None]


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
