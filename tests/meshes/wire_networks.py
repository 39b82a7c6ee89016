"""Networks of wires: ellipsoids, bottles, hulls and saddles of given or random sizes."""

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Wires = tuple[Floats, NDArray[np.int32]]
Profile = Callable[[float], Sequence[float]]  # radius and height at 0 … 1


class Drawing:
    """Collects polylines; points in one place are one vertex."""

    def __init__(self) -> None:
        self._numbers: dict[tuple[float, ...], int] = {}
        self._points: list[Floats] = []
        self._edges: set[tuple[int, int]] = set()

    def line(self, points: Sequence[Sequence[float]] | Floats) -> None:
        """Draw from point to point."""
        numbers = []
        for point in np.asarray(points, dtype=float):
            name = tuple(np.round(point, 9) + 0.0)
            if name not in self._numbers:
                self._numbers[name] = len(self._points)
                self._points.append(point)
            numbers.append(self._numbers[name])
        self._edges |= {(min(a, b), max(a, b)) for a, b in pairwise(numbers) if a != b}

    @property
    def wires(self) -> Wires:
        """Vertices (n, 3) and edges (e, 2)."""
        return np.array(self._points), np.array(sorted(self._edges), dtype=np.int32)


def circles(axes: Sequence[float], count: int = 32) -> Wires:
    """Three ellipses at right angles."""
    drawing = Drawing()
    angles = 2.0 * np.pi * np.arange(count + 1) / count
    a, b, nought = np.cos(angles), np.sin(angles), 0.0 * angles
    for ring in ((a, b, nought), (nought, a, b), (b, nought, a)):
        drawing.line(np.round(np.stack(ring, axis=1), 14) * axes)
    return drawing.wires


def revolved(profile: Profile, rings: Sequence[float], meridians: int, count: int = 32, steps: int = 40) -> Wires:
    """Rings around the z axis and the meridians across them."""
    drawing = Drawing()
    angles = 2.0 * np.pi * np.arange(count + 1) / count
    grid = [s for s in np.linspace(0.0, 1.0, steps + 1) if all(abs(s - ring) > 0.4 / steps for ring in rings)]
    along = sorted({*grid, *rings})

    def at(s: float, angle: float) -> list[float]:
        radius, height = profile(s)
        return [radius * np.cos(angle), radius * np.sin(angle), height]

    for ring in rings:
        drawing.line([at(ring, angle) for angle in angles])
    for k in range(meridians):
        drawing.line([at(s, angles[k * (count // meridians)]) for s in along])
    return drawing.wires


def bottle(radius: float, neck: float, height: float, meridians: int = 4) -> Wires:
    """From the middle of the bottom to the mouth, five rings."""
    knots = np.array(
        [
            [0.0, 0.0], [0.6 * radius, 0.0], [0.97 * radius, 0.072 * height], [radius, 0.3 * height],
            [0.95 * radius, 0.55 * height], [1.3 * neck, 0.75 * height], [neck, 0.85 * height], [neck, height],
        ]
    )  # fmt: skip
    shares = np.concatenate([[0.0], np.linalg.norm(np.diff(knots, axis=0), axis=1).cumsum()])
    shares /= shares[-1]
    slopes = np.empty_like(knots)
    slopes[1:-1] = (knots[2:] - knots[:-2]) / (shares[2:] - shares[:-2])[:, None]
    slopes[0], slopes[-1] = [knots[1, 0] / shares[1], 0.0], (knots[-1] - knots[-2]) / (shares[-1] - shares[-2])

    def profile(s: float) -> Floats:
        k = min(int(np.searchsorted(shares, s, side="right")) - 1, len(knots) - 2)
        h = shares[k + 1] - shares[k]
        u = (s - shares[k]) / h
        ends = (1 + 2 * u) * (1 - u) ** 2 * knots[k] + u * u * (3 - 2 * u) * knots[k + 1]
        found: Floats = ends + h * (u * (1 - u) ** 2 * slopes[k] - u * u * (1 - u) * slopes[k + 1])
        return found

    return revolved(profile, (0.27, 0.45, 0.66, 0.86, 1.0), meridians)


def net(surface: Callable[[float, float], Sequence[float]], across: int, along: int, steps: int = 8) -> Wires:
    """Lines of a surface over 0 … 1, 0 … 1."""
    drawing = Drawing()
    for i in range(across + 1):
        drawing.line([surface(i / across, t) for t in np.linspace(0.0, 1.0, along * steps + 1)])
    for j in range(along + 1):
        drawing.line([surface(t, j / along) for t in np.linspace(0.0, 1.0, across * steps + 1)])
    return drawing.wires


def saddle(width: float, height: float, twist: float, across: int, along: int) -> Wires:
    """A net on a saddle."""

    def at(u: float, v: float) -> list[float]:
        x, y = 2.0 * u - 1.0, 2.0 * v - 1.0
        return [width * x, y, height * (x * x - y * y) + twist * x * y + 0.2 * height * np.sin(2.0 * x + y)]

    return net(at, across, along)
