"""Points where the line of a fillet crosses diagonals of quads and polygons: these faces need none there."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from fairing._found_line import NoRowsError
from fairing._types import FloatArray, IntArray

_FLAT = 1e-6  # of its longest side: a triangle that low is none

Corners = list[int]


def without_points(
    triangles: IntArray, parent: IntArray, points: FloatArray, dropped: Iterable[Corners]
) -> tuple[IntArray, IntArray]:
    """Triangles (m, 3) outside a fillet and their parents, meshed anew around points of their border that go.

    dropped: those that follow each other on the border. Raises NoRowsError where what is left there is no polygon.
    """
    rows = dict(enumerate(zip(triangles.tolist(), parent.tolist(), strict=True)))
    at: dict[int, set[int]] = {}
    for name, (corners, _) in rows.items():
        for v in corners:
            at.setdefault(v, set()).add(name)
    for group in dropped:
        star = sorted(set().union(*(at[v] for v in group)))
        found = [rows.pop(name) for name in star]
        for name, (corners, _) in zip(star, found, strict=True):
            for v in corners:
                at[v].discard(name)
        for corners in _meshed(_around(set(group), [corners for corners, _ in found]), points):
            name = max(rows, default=0) + len(triangles)
            rows[name] = corners, found[0][1]
            for v in corners:
                at[v].add(name)
    made = [rows[name] for name in sorted(rows)]
    return (
        np.array([corners for corners, _ in made], dtype=np.int32).reshape(-1, 3),
        np.array([under for _, under in made], dtype=np.int32),
    )


def _around(group: set[int], star: list[Corners]) -> Corners:
    """The border of the triangles at some points that follow each other on it, without these."""
    sides = {(a, b) for x, y, z in star for a, b in ((x, y), (y, z), (z, x))}
    border = [(a, b) for a, b in sides if (b, a) not in sides]
    after = dict(border)
    starts = [b for a, b in border if a in group and b not in group]
    if len(after) != len(border) or len(starts) != 1:
        raise NoRowsError
    chain = starts
    while after[chain[-1]] not in group:
        chain.append(after[chain[-1]])
    if len(chain) + len(group) != len(after):
        raise NoRowsError
    return chain


def _meshed(polygon: Corners, points: FloatArray) -> list[Corners]:
    """Triangles of a polygon that is about plane: of all ways to cut it that whose flattest triangle is roundest."""
    count = len(polygon)
    if count == 2:  # a triangle without area, over the side that now is the border
        return []
    flat = _flattened(points[polygon])
    best: dict[tuple[int, int], tuple[float, int]] = {(k, k + 1): (np.inf, -1) for k in range(count - 1)}
    for width in range(2, count):
        for i in range(count - width):
            j = i + width
            best[i, j] = max(
                (min(best[i, k][0], best[k, j][0], _roundness(flat[i], flat[k], flat[j])), k) for k in range(i + 1, j)
            )
    if best[0, count - 1][0] < _FLAT:
        raise NoRowsError
    found, waiting = [], [(0, count - 1)]
    while waiting:
        i, j = waiting.pop()
        k = best[i, j][1]
        if k >= 0:
            found.append([polygon[i], polygon[k], polygon[j]])
            waiting += [(i, k), (k, j)]
    return found


def _flattened(places: FloatArray) -> list[tuple[float, float]]:
    """In the plane of the mean normal, counter-clockwise."""
    places = places - places.mean(axis=0)
    normal = np.cross(places, np.roll(places, -1, axis=0)).sum(axis=0)
    along = np.eye(3)[np.abs(normal).argmin()]
    x = np.cross(along, normal)
    flat = places @ np.column_stack([x, np.cross(normal, x) / max(float(np.linalg.norm(normal)), 1e-300)])
    return [(float(a), float(b)) for a, b in flat]


def _roundness(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    """Twice a triangle's area over the square of its longest side."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    longest = max((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 for p, q in ((a, b), (b, c), (c, a)))
    return area / longest if longest > 0 else 0.0
