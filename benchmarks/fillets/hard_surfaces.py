"""Random meshes of polygons with hard edges, as modellers make them: extruded, turned, of blocks, a boss on a plate."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Polygons = list[list[int]]
Solid = tuple[FloatArray, Polygons]


@dataclass(frozen=True)
class Problem:
    """Some hard edges of a mesh, to be rounded over a width."""

    name: str
    kind: str
    points: FloatArray
    polygons: Polygons
    seam: set[tuple[int, int]]
    width: float


def boundary(rng: Any) -> FloatArray:
    """(n, 2) corners of a polygon around the origin, sharp or rounded, with points along its sides or none."""
    count = int(rng.integers(3, 8))
    turns = np.zeros(count)
    while np.diff(np.append(turns, turns[0] + 2 * np.pi)).min() < 0.35 or (
        np.diff(np.append(turns, turns[0] + 2 * np.pi)).max() > 2.9
    ):
        turns = np.sort(rng.uniform(0, 2 * np.pi, count))
    points = rng.uniform(0.5, 1.2, count)[:, None] * np.column_stack([np.cos(turns), np.sin(turns)])
    if rng.random() < 0.5:
        points = _rounded(points, rng)
    parts = int(rng.integers(1, 4)) if rng.random() < 0.5 else 1
    after = np.roll(points, -1, axis=0)
    found = []
    for a, b in zip(points, after, strict=True):
        count = parts if np.linalg.norm(b - a) > 0.3 else 1
        found.append(a + (b - a) * np.arange(count)[:, None] / count)
    return np.concatenate(found)


def _rounded(points: FloatArray, rng: Any) -> FloatArray:
    found = []
    for before, at, after in zip(np.roll(points, 1, axis=0), points, np.roll(points, -1, axis=0), strict=True):
        first, last = at + 0.3 * (before - at), at + 0.3 * (after - at)
        for t in np.linspace(0, 1, int(rng.integers(1, 7)) + 1):
            found.append((1 - t) ** 2 * first + 2 * t * (1 - t) * at + t * t * last)
    return np.array(found)


def _lofted(rings: list[FloatArray]) -> Solid:
    """Quads between rings of one size, a polygon at each end."""
    count, last = len(rings[0]), (len(rings) - 1) * len(rings[0])
    quads = [
        [row + k, row + (k + 1) % count, row + count + (k + 1) % count, row + count + k]
        for row in range(0, last, count)
        for k in range(count)
    ]
    return np.concatenate(rings), [list(range(count))[::-1], [last + k for k in range(count)], *quads]


def extruded(rng: Any) -> Solid:
    profile, height, levels = boundary(rng), rng.uniform(0.5, 1.5), int(rng.integers(1, 4))
    return _lofted([np.column_stack([profile, np.full(len(profile), height * k / levels)]) for k in range(levels + 1)])


def turned(rng: Any) -> Solid:
    steps, count = int(rng.integers(2, 6)), int(rng.integers(10, 49))
    profile = [(rng.uniform(0.6, 1.2), 0.0)]
    for k in range(steps):
        radius, z = profile[-1]
        if k % 2 == 0:
            profile.append((radius * rng.uniform(0.85, 1.15), z + rng.uniform(0.4, 0.9)))
        else:
            profile.append((max(0.35, radius * rng.choice([0.6, 0.65, 1.5])), z + rng.uniform(-0.05, 0.1)))
    parts, turn = int(rng.integers(1, 4)), 2 * np.pi * np.arange(count) / count
    stations = np.concatenate([[0.0], np.arange(1, parts * steps + 1) / parts])
    radii, heights = (np.interp(stations, np.arange(steps + 1), column) for column in zip(*profile, strict=True))
    around = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(count)])
    return _lofted([r * around + [0, 0, z] for r, z in zip(radii, heights, strict=True)])


def blocks(rng: Any) -> Solid:
    """Up to four blocks of a cube that are joined by faces, sheared."""
    filled = {(0, 0, 0)}
    for _ in range(int(rng.integers(0, 4))):
        beside = [cell for cell in product(range(2), repeat=3) if cell not in filled and _near(cell, filled)]
        filled.add(beside[int(rng.integers(len(beside)))])
    parts, corners = int(rng.integers(1, 5)), []
    for cell, axis, sign in product(sorted(filled), range(3), (0, 1)):
        other = tuple(cell[k] + (2 * sign - 1) * (k == axis) for k in range(3))
        for i, j in product(range(parts), repeat=2) if other not in filled else ():
            quad = np.tile(np.array(cell, dtype=float), (4, 1))
            quad[:, axis] += sign
            quad[:, (axis + 1) % 3] += (i + np.array([0, 1, 1, 0])) / parts
            quad[:, (axis + 2) % 3] += (j + np.array([0, 0, 1, 1])) / parts
            corners.append(quad if sign else quad[::-1])
    places, index = np.unique(np.round(np.concatenate(corners), 7), axis=0, return_inverse=True)
    return places @ (np.eye(3) + rng.uniform(-0.25, 0.25, (3, 3))), index.reshape(-1, 4).tolist()


def _near(cell: tuple[int, ...], filled: set[tuple[int, int, int]]) -> bool:
    return min(sum(abs(a - b) for a, b in zip(cell, other, strict=True)) for other in filled) == 1


def boss(rng: Any) -> Solid:
    """A grid, flat or bent, with a square or stepped boss or pocket."""
    n = int(rng.integers(10, 18))
    grid = np.linspace(-1, 1, n + 1)
    bend = rng.uniform(-0.2, 0.2, 2) * (rng.random() < 0.5)
    places = [np.array([x, y, bend[0] * x * x + bend[1] * y * y]) for x in grid for y in grid]
    reach, is_round = int(rng.integers(2, n // 3 + 1)), rng.random() < 0.5
    away = {(i, j): np.abs(np.array([i, j]) + 0.5 - n // 2) for i, j in product(range(n), repeat=2)}
    raised = sorted(at for at, d in away.items() if (np.hypot(*d) if is_round else d.max()) < reach)
    height, rows = rng.uniform(0.2, 0.6) * rng.choice([-1, 1]), int(rng.integers(1, 4))
    lean = 1 - rng.uniform(0, 0.25)
    first = {(i, j): i * (n + 1) + j for i, j in away}
    cells = {at: [v, v + n + 1, v + n + 2, v + 1] for at, v in first.items()}
    polygons = [cells[at] for at in away if at not in raised]
    sides = {(a, b) for at in raised for a, b in zip(cells[at], [*cells[at][1:], cells[at][0]], strict=True)}
    rim = sorted(pair for pair in sides if pair[::-1] not in sides)
    ring = sorted({v for pair in rim for v in pair})
    middle = np.mean([places[v] for v in ring], axis=0)

    def lifted(v: int, share: float) -> int:
        place = middle + (places[v] - middle) * (1 - (1 - lean) * share)
        places.append(np.array([place[0], place[1], places[v][2] + height * share]))
        return len(places) - 1

    below = {v: v for v in ring}
    for row in range(1, rows + 1):
        above = {v: lifted(v, row / rows) for v in ring}
        polygons += [[below[a], below[b], above[b], above[a]] for a, b in rim]
        below = above
    top = {v: below[v] if v in below else lifted(v, 1.0) for v in sorted({v for at in raised for v in cells[at]})}
    polygons += [[top[v] for v in cells[at]] for at in raised]
    used = {v: k for k, v in enumerate(sorted({v for polygon in polygons for v in polygon}))}
    return np.array(places)[list(used)], [[used[v] for v in polygon] for polygon in polygons]


MAKERS: tuple[Callable[[Any], Solid], ...] = (extruded, turned, blocks, boss)
