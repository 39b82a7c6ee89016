"""Holes in surfaces that are known: their errors."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import fairing
import holes
from holes import FloatArray


def _from_axis(p: FloatArray) -> FloatArray:
    result: FloatArray = np.hypot(p[:, 0], p[:, 1])
    return result


_HOLES: dict[str, tuple[Any, Callable[[FloatArray], FloatArray]]] = {
    "side of a cylinder": (holes.cylinder_side, lambda p: _from_axis(p) - 1),
    "saddle (catenoid)": (holes.saddle, lambda p: _from_axis(p) - np.cosh(p[:, 2])),
    "torus": (holes.torus, lambda p: np.hypot(_from_axis(p) - 2, p[:, 2]) - 0.7),
}
_GAPS: dict[str, tuple[Any, Callable[[FloatArray], FloatArray]]] = {
    "tube, two rims bridged": (holes.tube, lambda p: _from_axis(p) - 1),
    "catenoid, two rims bridged": (holes.catenoid, lambda p: _from_axis(p) - np.cosh(p[:, 2])),
}


def shapes() -> Iterator[str]:
    """Holes and gaps, coarse and fine: errors ÷ D."""
    yield "| surface | rim | error ÷ D | s |"
    for name, (place, off) in _HOLES.items():
        for cells in (30, 60):
            vertices, triangles = holes.sheet(place, (cells, cells), holes.disc)
            yield _shape(name, vertices, triangles, [min(fairing.boundary_loops(triangles), key=len)], off)
    for name, (place, off) in _GAPS.items():
        for around in (30, 60):
            vertices, triangles = holes.sheet(place, (around, around // 2), holes.band, closed=True)
            middle = [abs(vertices[loop, 2].mean()) for loop in fairing.boundary_loops(triangles)]
            loops = [fairing.boundary_loops(triangles)[k] for k in np.argsort(middle)[:2]]
            yield _shape(name, vertices, triangles, loops, off)


def _shape(name: str, vertices: FloatArray, triangles: Any, loops: list[Any], off: Any) -> str:
    start = time.process_time()
    result = fairing.fill(vertices, triangles, loops, bridge=len(loops) > 1, threads=1)
    seconds = time.process_time() - start
    boundary = vertices[np.concatenate(loops)]
    diameter = 2 * np.linalg.norm(boundary - boundary.mean(axis=0), axis=1).max()
    error = abs(off(result.vertices)).max() / diameter
    return f"| {name} | {len(boundary) // len(loops)} | {error:.1e} | {seconds:.2f} |"
