"""Half a sphere whose outline is much finer than its middle: rings of half as many vertices each towards the pole."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from curves import FloatArray
from meshing import IntArray

LONGEST = 0.25  # edge, in radii
LEAST_AROUND = 12  # vertices of a ring that is halved no more
SPACING = 1.2  # of the rings, in edges


@dataclass(frozen=True)
class FineRim:
    """Vertices (n, 3), the outline's first; triangles (m, 3); the outline's unit normals (k, 3)."""

    vertices: FloatArray
    triangles: IntArray
    normals: FloatArray

    @property
    def fixed(self) -> IntArray:
        """The outline."""
        return np.arange(len(self.normals))


def fine_rim(count: int, edges: float, radians: float, seed: int = 0) -> FineRim:
    """count: vertices of the outline, moved by so many of its edges at random, and normals turned by so much."""
    rings = _rings(count)
    starts = np.concatenate([[0], np.cumsum([around for _, around in rings])])
    points = np.concatenate([*(_ring(*ring) for ring in rings), [[0.0, 0.0, 1.0]]])
    triangles = [t for k, ((_, n), (_, m)) in enumerate(pairwise(rings)) for t in _between(starts[k], n, m)]
    last, around = starts[-2], rings[-1][1]
    triangles += [(last + k, last + (k + 1) % around, starts[-1]) for k in range(around)]
    rng = np.random.default_rng(seed)
    normals = points[:count] + radians * rng.normal(size=(count, 3)) / np.sqrt(3)
    points[:count] += edges * 2 * np.pi / count * rng.normal(size=(count, 3)) / np.sqrt(3)
    return FineRim(points, np.array(triangles), normals / np.linalg.norm(normals, axis=1)[:, None])


def _rings(count: int) -> list[tuple[float, int]]:
    """Angle from the pole and number of vertices of each."""
    angle, rings = np.pi / 2, []
    while angle > LONGEST:
        rings.append((angle, count))
        angle -= SPACING * 2 * np.pi * np.sin(angle) / count
        halved = count % 2 == 0 and count > LEAST_AROUND and 4 * np.pi * np.sin(angle) / count < LONGEST
        count = count // 2 if halved else count
    return rings


def _ring(angle: float, count: int) -> FloatArray:
    turn = 2 * np.pi * np.arange(count) / count
    return np.column_stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.full(count, np.cos(angle))])


def _between(start: int, count: int, inner_count: int) -> list[tuple[int, int, int]]:
    """Triangles of a ring of `count` vertices and the next one, of as many or half."""
    inner, step = start + count, count // inner_count
    found = []
    for k in range(inner_count):
        p, q = inner + k, inner + (k + 1) % inner_count
        outer = [start + (step * k + j) % count for j in range(step + 1)]
        found += [(outer[0], outer[1], p), (outer[1], q, p)]
        if step == 2:
            found.append((outer[1], outer[2], q))
    return found
