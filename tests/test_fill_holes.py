"""Which border loops fairing.fill takes for holes, and what is out of proportion."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing
import holes
from holes import FloatArray, Mesh

Place = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]


def bent(degrees: float) -> Place:
    """A square bent along one direction."""
    whole = np.radians(degrees)

    def place(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        turn = (u - 0.5) * whole
        return np.sin(turn) / whole, v, np.cos(turn) / whole

    return place


def saddle(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return u, v, 0.5 * (u - 0.5) * (v - 0.5)


def dish(half_angle: float) -> Mesh:
    """The cap of a ball."""
    return holes.bowl(48, 180.0 - half_angle)


def tube(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 3 * v


def spool(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A tube whose ends flare out into flat rings."""
    radius = 1.0 + np.interp(v, [0.0, 0.25, 0.75, 1.0], [1.0, 0.0, 0.0, 1.0])
    height = np.interp(v, [0.0, 0.25, 0.75, 1.0], [0.0, 0.0, 2.0, 2.0])
    return radius * np.cos(2 * np.pi * u), radius * np.sin(2 * np.pi * u), height


def whole(u: FloatArray, v: FloatArray) -> Any:
    return np.zeros(u.shape, dtype=bool)


def torn(u: FloatArray, v: FloatArray) -> Any:
    """A ragged end, a slit and a hole."""
    ragged = v > 0.85 + 0.08 * np.sin(23.0 * u) + 0.05 * np.cos(41.0 * u)
    return ragged | ((abs(u - 0.5) < 0.02) & (v > 0.5)) | ((u - 0.2) ** 2 + (v - 0.4) ** 2 < 0.01)


def twelve(u: FloatArray, v: FloatArray) -> Any:
    """Twelve holes in a sheet."""
    return ((u * 4) % 1 - 0.5) ** 2 + ((v * 3) % 1 - 0.5) ** 2 < 0.05


def mask() -> Mesh:
    """A ball with an open neck, a tube that leads away from it, and twelve holes."""

    def place(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        polar = np.pi * (0.02 + 0.83 * np.minimum(v, 0.8) / 0.8)
        down = np.maximum(v - 0.8, 0.0) * 4.0
        radius = np.sin(polar)
        return radius * np.cos(2 * np.pi * u), radius * np.sin(2 * np.pi * u), np.cos(polar) - down

    def open_there(u: FloatArray, v: FloatArray) -> Any:
        return (((u * 6) % 1 - 0.5) ** 2 + ((v * 2.5) % 1 - 0.5) ** 2 < 0.05) & (v < 0.8)

    vertices, triangles = holes.sheet(place, (90, 60), open_there, closed=True)
    return vertices, triangles


def sorted_out(mesh: Mesh) -> tuple[int, int]:
    """How many holes and how many outer borders."""
    outer = fairing.outer_borders(*mesh)
    return int((~outer).sum()), int(outer.sum())


SHAPES: dict[str, tuple[Mesh, int, int]] = {
    "flat sheet": (holes.sheet(lambda u, v: (u, v, 0 * u), (12, 12), whole), 0, 1),
    "flat sheet with twelve holes": (holes.sheet(lambda u, v: (u, v, 0 * u), (60, 60), twelve), 12, 1),
    "saddle": (holes.sheet(saddle, (16, 16), whole), 0, 1),
    "tube": (holes.sheet(tube, (24, 12), whole, closed=True), 2, 0),
    "torn tube": (holes.sheet(tube, (48, 36), torn, closed=True), 3, 0),
    "spool": (holes.sheet(spool, (36, 24), whole, closed=True), 0, 2),
    "dish of 20°": (dish(20.0), 0, 1),
    "dish of 30°": (dish(30.0), 1, 0),
    "half a ball": (dish(90.0), 1, 0),
    "ball with a hole": (dish(160.0), 1, 0),
    "mask": (mask(), 14, 0),
    **{
        f"sheet bent by {degrees}°": (holes.sheet(bent(degrees), (16, 16), whole), 0, 1)
        for degrees in (10, 30, 90, 180, 270)
    },
    **{
        f"sheet bent by {degrees}°, with a hole": (holes.sheet(bent(degrees), (24, 24), holes.disc), 1, 1)
        for degrees in (10, 180)
    },
}


@pytest.mark.parametrize("name", SHAPES)
def test_holes_and_outer_borders(name: str) -> None:
    mesh, inner, outer = SHAPES[name]
    assert sorted_out(mesh) == (inner, outer)
