"""What new vertices and faces get of the data of those around them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing._interpolate import interpolate
from fairing._measure import vertex_normals
from fairing._types import FloatArray, IntArray
from fairing.objects.parts import Data, Parts

Array = npt.NDArray[Any]
_NORMALS = {"normals", "normal", "vertex_normals"}


def spread(data: Data, points: FloatArray, triangles: IntArray, count: int) -> Data:
    """Data of ``count`` vertices and, behind them, of the new ones that the triangles over them use.

    Real numbers and colours spread as heat would, from the boundary inwards; what can't be mixed comes from the nearest
    vertex of the boundary.
    """
    held = np.unique(triangles[triangles < count])
    new = np.arange(count, len(points))
    near = held[nearest(points[new], points[held])] if len(new) else new

    def new_rows(values: Array) -> Array:
        if not _mixes(values[held]):
            found: Array = values[near]
            return found
        flat = values[held].reshape(len(held), -1).astype(np.float64)
        return _like(interpolate(points, triangles, held, flat)[new], values)

    return {name: np.concatenate([values, new_rows(values)]) if len(new) else values for name, values in data.items()}


def mixed(data: Data, corners: IntArray, weights: FloatArray) -> Data:
    """Data of old vertices and, behind them, of new ones that lie at these corners (k, 3) with these weights (k, 3)."""

    def new_rows(values: Array) -> Array:
        if not _mixes(values):
            found: Array = values[corners[np.arange(len(corners)), weights.argmax(axis=1)]]
            return found
        flat = values.reshape(len(values), -1).astype(np.float64)
        return _like(np.einsum("kc,kcd->kd", weights, flat[corners]), values)

    return {name: np.concatenate([values, new_rows(values)]) for name, values in data.items()}


def with_normals(made: Parts, moved: IntArray) -> Parts:
    """The same with normals that are stored at vertices renewed where these vertices and their neighbours moved."""
    stored = [name for name, values in made.vertex_data.items() if _is_normal(name, values)]
    if not stored or not len(moved):
        return made
    near = np.unique(made.triangles[np.isin(made.triangles, made.same[moved]).any(axis=1)])
    touched = np.flatnonzero(np.isin(made.same, near))
    normals = vertex_normals(made.points, made.triangles)[made.same[touched]]
    data = dict(made.vertex_data)
    for name in stored:
        data[name] = data[name].copy()
        data[name][touched] = normals
    return Parts(made.points, made.faces, data, made.face_data)


def nearest(places: FloatArray, ends: FloatArray) -> IntArray:
    """(k,) which of the ends (s, 3) is nearest to each place, in blocks of places."""
    block = max(1, 2_000_000 // max(1, len(ends)))
    found = [
        ((part[:, None] - ends[None]) ** 2).sum(axis=2).argmin(axis=1)
        for part in np.array_split(places, range(block, len(places), block))
    ]
    result: IntArray = np.concatenate(found)
    return result


def _is_normal(name: str, values: Array) -> bool:
    return name.lower() in _NORMALS and values.dtype.kind == "f" and values.shape[1:] == (3,)


def _mixes(values: Array) -> bool:
    """Whether a mean of two has a meaning: real numbers, and bytes, which are colours."""
    return values.dtype == np.uint8 or (values.dtype.kind == "f" and bool(np.isfinite(values).all()))


def _like(rows: FloatArray, values: Array) -> Array:
    """(k, c) numbers in the type and with the columns of the values."""
    shaped = rows.reshape(-1, *values.shape[1:])
    return (np.rint(shaped) if values.dtype == np.uint8 else shaped).astype(values.dtype)
