"""What limits the error over a torus and a catenoid: the equation, or the normals that the surroundings give."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

import fairing
import holes
from holes import FloatArray


def torus(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A part of the torus of radii 2 and .7."""
    radius, turn = 2 + 0.7 * np.cos(2 * v - 1), 0.8 * u
    return radius * np.cos(turn), radius * np.sin(turn), 0.7 * np.sin(2 * v - 1)


def catenoid(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Its waist is 1."""
    height = 2 * v - 1
    return np.cosh(height) * np.cos(2 * np.pi * u), np.cosh(height) * np.sin(2 * np.pi * u), height


def _unit(vectors: FloatArray) -> FloatArray:
    result: FloatArray = vectors / np.linalg.norm(vectors, axis=1)[:, None]
    return result


def _from_axis(p: FloatArray) -> FloatArray:
    result: FloatArray = np.hypot(p[:, 0], p[:, 1])
    return result


def torus_normals(p: FloatArray) -> FloatArray:
    """Unit, outwards."""
    share = 1 - 2 / _from_axis(p)
    return _unit(np.column_stack([share * p[:, 0], share * p[:, 1], p[:, 2]]))


def catenoid_normals(p: FloatArray) -> FloatArray:
    """Unit, away from the axis."""
    away = p[:, :2] / _from_axis(p)[:, None]
    return _unit(np.column_stack([away, -np.sinh(p[:, 2])]))


@dataclass(frozen=True)
class Known:
    """A mesh with a hole, or a gap between two outlines, in a surface that is known."""

    name: str
    vertices: FloatArray
    triangles: Any
    loops: list[Any]
    normals: Callable[[FloatArray], FloatArray]
    distance: Callable[[FloatArray], FloatArray]

    def row(self, equations: tuple[str, ...]) -> str:
        """Name, rim, how far the fitted normals are off, errors ÷ D with fitted and exact ones."""
        rim = np.concatenate(self.loops)
        fitted = fairing.surrounding_normals(self.vertices, self.triangles, rim).normals
        exact = self.normals(self.vertices[rim])
        exact = exact * np.sign((exact * fitted).sum())
        off = np.degrees(np.arccos(np.clip((exact * fitted).sum(axis=1), -1, 1))).max()
        errors = [f"{self.error(rim, given, equation):.1e}" for equation in equations for given in (fitted, exact)]
        return f"| {self.name} | {len(rim)} | {off:.4f}° | {' | '.join(errors)} |"

    def error(self, rim: Any, at_rim: FloatArray, equation: str) -> float:
        """Largest distance of a new vertex ÷ D."""
        normals = np.tile([0.0, 0.0, 1.0], (len(self.vertices), 1))
        normals[rim] = at_rim
        result = fairing.fill(
            self.vertices, self.triangles, self.loops, normals=normals, bridge=len(self.loops) > 1,
            equation=equation, threads=1,
        )  # fmt: skip
        outline = self.vertices[rim]
        diameter = 2 * np.linalg.norm(outline - outline.mean(axis=0), axis=1).max()
        return float(abs(self.distance(result.vertices)).max() / diameter)


def torus_hole(cells: int) -> Known:
    """A hole in a sheet of so many cells along each side."""
    vertices, triangles = holes.sheet(torus, (cells, cells), holes.disc)
    loop = min(fairing.boundary_loops(triangles), key=len)
    return Known(
        "torus", vertices, triangles, [loop], torus_normals, lambda p: np.hypot(_from_axis(p) - 2, p[:, 2]) - 0.7
    )


def catenoid_gap(around: int) -> Known:
    """The middle half is missing."""
    vertices, triangles = holes.sheet(catenoid, (around, around // 2), holes.band, closed=True)
    loops = sorted(fairing.boundary_loops(triangles), key=lambda loop: abs(vertices[loop, 2].mean()))[:2]
    return Known("catenoid", vertices, triangles, loops, catenoid_normals, lambda p: _from_axis(p) - np.cosh(p[:, 2]))


def table() -> Iterator[str]:
    """Finer and finer."""
    yield "| surface | rim | normals off by | fitted | exact | least variation: fitted | exact |"
    for cells in (30, 60):
        yield torus_hole(cells).row(("harmonic", "least_variation"))
    yield torus_hole(120).row(("harmonic",))
    for around in (30, 60, 120):
        yield catenoid_gap(around).row(("harmonic",))
