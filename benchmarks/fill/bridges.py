"""Open tubes to be bridged: an S-bend, a taper, an elbow, three and four arms."""

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


def arms(count: int, distance: float = 1.0, radius: float = 0.45) -> Gap:
    """Tubes in a plane, evenly around."""
    turns = 2 * np.pi * np.arange(count) / count
    axes = [np.array([np.cos(turn), np.sin(turn), 0.0]) for turn in turns]
    return joined(*(tube(distance * axis, axis, radius) for axis in axes))


def elbow(radius: float) -> Gap:
    """Two tubes at a right angle; the bend's radius is 1."""
    return joined(tube([1, 0, 0], [1, 0, 0], radius), tube([0, 1, 0], [0, 1, 0], radius))


def thin_ones() -> dict[str, Gap]:
    """Of the tables only."""
    return {f"elbow of 90°, tubes of {share:g} of the bend": elbow(share) for share in (0.25, 0.2, 0.15)}


def all_of_them() -> dict[str, Gap]:
    """By name."""
    return {
        "S-bend, radii .5 and .3, offset .9, gap 1": joined(
            tube([0, 0, 0], [0, 0, -1], 0.5), tube([0.9, 0, 1.0], [0, 0, 1], 0.3)
        ),
        "straight, gap of 3 radii": joined(tube([0, 0, 0], [0, 0, -1], 0.5), tube([0, 0, 1.5], [0, 0, 1], 0.5)),
        "elbow of 90°": elbow(0.4),
        "three tubes": arms(3),
        "four tubes": arms(4),
    }
