"""What new vertices and faces get of the data of those around them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.maps import interpolate
from fairing.objects.parts import Data, Parts
from fairing.results import FloatArray, IntArray

Array = npt.NDArray[Any]
_NORMALS = {"normals", "normal", "vertex_normals"}


def spread(
    surface: tuple[FloatArray, IntArray], pins: tuple[IntArray, Array], held: IntArray,
    trend: tuple[FloatArray, Array] | None,
) -> Array:  # fmt: skip
    """Values at all vertices of a surface, spread from its boundary ``held`` inwards as heat would.

    ``pins``: the vertices of ``held`` with a value, and their values. ``trend``: places and values around; a linear
    function fitted to them goes on where ``held`` has no value, and the rest spreads.
    """
    points, triangles = surface
    flat = pins[1].reshape(len(pins[0]), -1).astype(np.float64)
    base, rest = np.zeros((len(points), flat.shape[1])), np.zeros((len(held), flat.shape[1]))
    if trend is not None:
        middle = trend[0].mean(axis=0)
        rows = trend[1].reshape(len(trend[0]), -1).astype(np.float64)
        slope, *_ = np.linalg.lstsq(np.insert(trend[0] - middle, 3, 1.0, axis=1), rows, rcond=1e-6)
        base = np.insert(points - middle, 3, 1.0, axis=1) @ slope
    rest[np.searchsorted(held, pins[0])] = flat - base[pins[0]]
    return _like(interpolate(points, triangles, held, rest) + base, pins[1])


def mixed(data: Data, corners: IntArray, weights: FloatArray) -> Data:
    """Data of vertices that lie at these corners (k, 3) with these weights (k, 3)."""
    nearest_corner = corners[np.arange(len(corners)), weights.argmax(axis=1)]
    rows: Data = {}
    for name, values in data.items():
        flat = values.reshape(len(values), -1)
        rows[name] = values[nearest_corner]
        if mixes(values):
            rows[name] = _like(np.einsum("kc,kcd->kd", weights, flat[corners].astype(np.float64)), values)
    return rows


def with_normals(made: Parts, moved: IntArray) -> Parts:
    """The same with normals that are stored at vertices renewed where these vertices and their neighbours moved.

    Where one place has several, as along hard edges, each is that of its own faces.
    """
    stored = [name for name, values in made.vertex_data.items() if is_normal(name, values)]
    if not stored or not len(moved):
        return made
    near = np.unique(made.triangles[np.isin(made.triangles, made.same[moved]).any(axis=1)])
    touched = np.flatnonzero(np.isin(made.same, near))
    smooth = _normals(made.points, made.triangles)[made.same[touched]]
    own = _normals(made.points, made.own)[touched]
    data = dict(made.vertex_data)
    for name in stored:
        data[name] = values = data[name].copy()
        hard = np.zeros(len(values), dtype=bool)
        hard[made.same[(values != values[made.same]).any(axis=1)]] = True
        values[touched] = np.where(hard[made.same[touched], None], own, smooth)
    return Parts(made.points, made.faces, data, made.face_data)


def _normals(points: FloatArray, triangles: IntArray) -> FloatArray:
    """(n, 3) of any triangles, by their areas: files have some that join in no manifold."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    sums = np.zeros_like(points)
    np.add.at(sums, triangles, np.cross(b - a, c - a)[:, None])
    unit: FloatArray = sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), np.finfo(float).tiny)
    return unit


def is_normal(name: str, values: Array) -> bool:
    return name.lower() in _NORMALS and values.dtype.kind == "f" and values.shape[1:] == (3,)


def mixes(values: Array) -> bool:
    """Whether a mean of two has a meaning: real numbers, and bytes, which are colours."""
    return values.dtype == np.uint8 or (values.dtype.kind == "f" and bool(np.isfinite(values).all()))


def _like(rows: FloatArray, values: Array) -> Array:
    """(k, c) numbers in the type and with the columns of the values."""
    shaped = rows.reshape(-1, *values.shape[1:])
    return (np.clip(np.rint(shaped), 0, 255) if values.dtype == np.uint8 else shaped).astype(values.dtype)
