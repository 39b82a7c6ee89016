"""Open tubes to be bridged: elbows."""

from __future__ import annotations

from typing import Any

import numpy as np

import fairing
from holes import FloatArray, IntArray

AROUND, ALONG = 32, 8
Gap = tuple[FloatArray, IntArray, list[Any]]


def tube(centre: Any, axis: Any, radius: float, length: float = 1.0) -> tuple[FloatArray, IntArray]:
    """From its inner rim at `centre` away along `axis`; outward normals; the inner rim comes first."""
    direction = np.asarray(axis, float) / np.linalg.norm(axis)
    helper = np.array([0.0, 0.0, 1.0]) if abs(direction[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    u = np.cross(helper, direction) / np.linalg.norm(np.cross(helper, direction))
    v = np.cross(direction, u)
    turn, row = 2 * np.pi * np.tile(np.arange(AROUND), ALONG + 1) / AROUND, np.repeat(np.arange(ALONG + 1), AROUND)
    ring = radius * (np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * v)
    points = np.asarray(centre, float) + ring + (length * row / ALONG)[:, None] * direction
    i, j = (index.ravel() for index in np.mgrid[:ALONG, :AROUND])
    a, b = i * AROUND + j, i * AROUND + (j + 1) % AROUND
    return points, np.concatenate([np.column_stack([a, b, b + AROUND]), np.column_stack([a, b + AROUND, a + AROUND])])


def joined(*tubes: tuple[FloatArray, IntArray]) -> Gap:
    """One mesh, and the loops of the inner rims."""
    starts = np.cumsum([0, *(len(points) for points, _ in tubes)])
    points = np.concatenate([points for points, _ in tubes])
    faces = np.concatenate([faces + start for (_, faces), start in zip(tubes, starts, strict=False)])
    inner = [start + np.arange(AROUND) for start in starts[:-1]]
    loops = [loop for loop in fairing.boundary_loops(faces) if any(np.isin(loop, rim).all() for rim in inner)]
    return points, faces, loops


def elbow(radius: float, bend: float = 90.0) -> Gap:
    """Two tubes where a part of a torus of radius 1 around the origin is missing, of so many degrees."""
    c, s = np.cos(np.radians(bend)), np.sin(np.radians(bend))
    return joined(tube([1, 0, 0], [0, -1, 0], radius), tube([c, s, 0], [-s, c, 0], radius))


def off_torus(points: FloatArray, radius: float) -> float:
    """By how much an elbow misses the torus."""
    return float(np.abs(np.hypot(np.hypot(points[:, 0], points[:, 1]) - 1, points[:, 2]) - radius).max())


def elbows() -> dict[tuple[float, float], Gap]:
    """By degrees and radius, of the tables only."""
    bends = [(90.0, 0.4), (90.0, 0.25), (90.0, 0.2), (90.0, 0.15), (120.0, 0.4), (120.0, 0.25), (150.0, 0.4)]
    return {(bend, radius): elbow(radius, bend) for bend, radius in [*bends, (180.0, 0.4), (60.0, 0.3)]}
