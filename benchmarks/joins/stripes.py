"""Reflection stripes of a triangle mesh, by numpy alone."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int32]

SHARPNESS = 3.0
BACKGROUND = 0.93


@dataclass(frozen=True)
class View:
    """Orthographic: what is looked at, where from, and the width that is seen. `tilt`: direction across the stripes."""

    target: tuple[float, float, float]
    direction: tuple[float, float, float]
    width: float
    tilt: tuple[float, float, float] = (0.3, 1.0, 0.2)
    stripes: float = 15.0  # radians per unit of the mirrored direction
    pixels: int = 360


def vertex_normals(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Means of the triangles' normals by their angles, (n, 3)."""
    corners = vertices[triangles]
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = crosses / np.maximum(np.linalg.norm(crosses, axis=1), 1e-300)[:, None]
    sums = np.zeros_like(vertices)
    for k in range(3):
        one = corners[:, (k + 1) % 3] - corners[:, k]
        other = corners[:, (k + 2) % 3] - corners[:, k]
        cosine = (one * other).sum(axis=1) / (np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1))
        np.add.at(sums, triangles[:, k], np.arccos(np.clip(cosine, -1, 1))[:, None] * unit)
    lengths = np.linalg.norm(sums, axis=1)
    return np.asarray(sums / np.maximum(lengths, 1e-300)[:, None])


def _camera(view: View) -> FloatArray:
    """Rows: right, up, towards the eye."""
    back = np.array(view.direction) / np.linalg.norm(view.direction)
    up = np.array([0.0, 0.0, 1.0]) if abs(back[2]) < 0.95 else np.array([0.0, 1.0, 0.0])
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(back, right), back])


def _fill(triangle: FloatArray, normals: FloatArray, depth: FloatArray, field: FloatArray) -> None:
    """One triangle, (3, 3) in pixels, into the depth buffer and the field of normals."""
    low = np.maximum(np.floor(triangle[:, :2].min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(triangle[:, :2].max(axis=0)).astype(int), len(depth) - 1)
    if (high < low).any():
        return
    x, y = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
    (ax, ay), (bx, by), (cx, cy) = triangle[:, :2]
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if abs(area) < 1e-12:
        return
    second = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    third = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    first = 1.0 - second - third
    inside = (first >= -1e-9) & (second >= -1e-9) & (third >= -1e-9)
    height = first * triangle[0, 2] + second * triangle[1, 2] + third * triangle[2, 2]
    inside &= height > depth[y, x]
    weights = np.stack([first, second, third], axis=-1)[inside]
    depth[y[inside], x[inside]] = height[inside]
    field[y[inside], x[inside]] = weights @ normals


def draw(vertices: FloatArray, triangles: IntArray, view: View) -> FloatArray:
    """Tones in [0, 1], (pixels, pixels)."""
    camera, size = _camera(view), 2 * view.pixels  # twice as fine, for smooth edges
    seen = (vertices - view.target) @ camera.T * (size / view.width)
    seen[:, 0] += 0.5 * size
    seen[:, 1] = 0.5 * size - seen[:, 1]
    normals = vertex_normals(vertices, triangles) @ camera.T
    depth = np.full((size, size), -np.inf)
    field = np.zeros((size, size, 3))
    for corners in triangles:
        _fill(seen[corners], normals[corners], depth, field)
    field /= np.maximum(np.linalg.norm(field, axis=2), 1e-300)[..., None]
    mirrored = 2.0 * field[..., 2:] * field - [0.0, 0.0, 1.0]
    across = np.array(view.tilt) / np.linalg.norm(view.tilt)
    wave = 0.5 + 0.5 * np.tanh(SHARPNESS * np.sin(view.stripes * (mirrored @ across)))
    tones = np.where(np.isfinite(depth), (0.12 + 0.8 * wave) * (0.55 + 0.45 * np.abs(field[..., 2])), BACKGROUND)
    return np.asarray(tones.reshape(view.pixels, 2, view.pixels, 2).mean(axis=(1, 3)))


def write(path: Path, pictures: list[FloatArray], gap: int = 8) -> None:
    """Side by side, as an 8-bit grey PNG of 64 tones."""
    space = np.full((len(pictures[0]), gap), 1.0)
    row = np.hstack([part for picture in pictures for part in (picture, space)][:-1])
    grey = (np.round(row * 63) * (255 / 63)).clip(0, 255).astype(np.uint8)
    lines = b"".join(b"\x00" + line.tobytes() for line in grey)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    parts = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + parts)
