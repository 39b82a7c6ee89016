"""Wings with a sharp trailing edge, cut in the middle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing
from tubes import FloatArray, IntArray


@dataclass(frozen=True)
class Wing:
    """vertices (n, 3) in chords; triangles inside and outside the part that is taken out; its outlines."""

    vertices: FloatArray
    inside: IntArray
    outside: IntArray
    fixed: IntArray

    def faired(self, **options: str) -> fairing.FairResult:
        """With a random interior, the normals of the surroundings, and no old shape."""
        start = self.vertices.copy()
        free = np.setdiff1d(self.inside, self.fixed)
        start[free] += 0.3 * np.random.default_rng(1).normal(size=(len(free), 3))
        normals = fairing.surrounding_normals(self.vertices, self.outside, self.fixed).normals
        return fairing.fair(start, self.inside, fixed=self.fixed, fixed_normals=normals, threads=1, **options)  # type: ignore[arg-type]


def _section(around: int, thickness: float, camber: float) -> FloatArray:
    """A NACA section from the trailing edge over the upper side and back, closed at the trailing edge."""
    x = 0.5 * (1 + np.cos(np.linspace(0, np.pi, around // 2 + 1)))
    half = 5 * thickness * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
    middle = 4 * camber * x * (1 - x)
    upper = np.column_stack([x, middle + half])
    return np.concatenate([upper, np.column_stack([x, middle - half])[-2:0:-1]])


def wing(
    *, span: float = 2.0, taper: float = 1.0, sweep: float = 0.0, thickness: float = 0.12, camber: float = 0.0,
    around: int = 32, seed: int = 0,
) -> Wing:  # fmt: skip
    """`span` chords are taken out between two rims of a third of that; diagonals run at random."""
    rows, rim = max(6, round(6 * span)), max(2, round(2 * span))
    t = np.linspace(0, 1, rows + 2 * rim + 1)
    z = t * span * (rows + 2 * rim) / rows
    chord = 1 + (taper - 1) * t
    section = _section(around, thickness, camber)
    x = section[:, 0] * chord[:, None] + sweep * z[:, None]
    y = section[:, 1] * chord[:, None]
    vertices = np.stack([x, y, np.broadcast_to(z[:, None], x.shape)], axis=2).reshape(-1, 3)
    number = np.arange(len(vertices)).reshape(-1, around)
    a, b = number[:-1], np.roll(number, -1, axis=1)[:-1]
    c, d = np.roll(number, -1, axis=1)[1:], number[1:]
    one = np.random.default_rng(seed).random(a.shape) < 0.5
    first = np.stack([a, b, np.where(one, c, d)], axis=2)
    second = np.stack([np.where(one, a, b), c, d], axis=2)
    taken = np.arange(rows + 2 * rim)
    middle = (taken >= rim) & (taken < rim + rows)
    inside = np.concatenate([first[middle], second[middle]]).reshape(-1, 3)
    outside = np.concatenate([first[~middle], second[~middle]]).reshape(-1, 3)
    return Wing(vertices, inside, outside, np.concatenate([number[rim], number[rim + rows]]))
