"""Checks of shapes, types and numbers: every message names the argument and what it should have been."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.results import Diagnostic, FloatArray, IntArray, MeshError

_INT32 = np.iinfo(np.int32)


def _array(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """What numpy makes of it, or a ValueError that names the argument; masked entries are refused."""
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise ValueError(f"{name}: has masked entries; leave them out or fill them first, e.g. with filled()")
    try:
        return np.asarray(value)
    except (ValueError, TypeError) as error:
        raise ValueError(f"{name}: an array is needed: {error}") from error


def floats(name: str, value: npt.ArrayLike, rows: int | None = None) -> FloatArray:
    """(n, 3) float64 in C order, or ValueError. ``rows``: the n that is needed."""
    array = _array(name, value)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: numbers are needed, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: shape (n, 3) is needed, not {array.shape}")
    if rows is not None and array.shape[0] != rows:
        raise ValueError(f"{name}: {rows} rows are needed, not {array.shape[0]}")
    with np.errstate(over="ignore"):  # of longer floats: infinite then
        return np.ascontiguousarray(array, dtype=np.float64)


def integers(name: str, value: npt.ArrayLike, columns: int | None) -> IntArray:
    """(n, columns), or (n,) for None, as int32 in C order, or ValueError."""
    array = _array(name, value)
    if array.size == 0 and array.ndim == 1:
        array = array.reshape((0,) if columns is None else (0, columns)).astype(np.int32)
    if array.dtype.kind == "b" and columns is None:
        raise ValueError(f"{name}: vertex indices are needed, not a boolean mask: pass np.flatnonzero(mask)")
    if array.dtype.kind == "f":
        hint = "convert with astype(int) if they are whole numbers"
        raise ValueError(f"{name}: integers are needed, not {array.dtype}; {hint}")
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name}: integers are needed, not {array.dtype}")
    wanted = "(k,)" if columns is None else f"(n, {columns})"
    if array.ndim != (1 if columns is None else 2) or (columns and array.shape[1] != columns):
        raise ValueError(f"{name}: shape {wanted} is needed, not {array.shape}")
    if not np.can_cast(array.dtype, np.int32):
        outside = (array > _INT32.max) | (array < _INT32.min)
        if outside.any():
            raise _index_range(name, array, outside, "which does not exist")
    return np.ascontiguousarray(array, dtype=np.int32)


def _index_range(
    name: str, array: npt.NDArray[Any], outside: npt.NDArray[np.bool_], why: str, **figures: float
) -> MeshError:
    """Its elements: rows of the triangles, otherwise the vertices named, in the caller's wider type."""
    place = tuple(np.argwhere(outside)[0])
    text = f"{name}: row {place[0]} names vertex {array[place]}, {why}"
    figures = {"vertex": float(array[place]), **figures}
    if name == "triangles":
        rows = np.flatnonzero(outside.any(axis=1)).astype(np.int32)
        return MeshError(Diagnostic("INDEX_RANGE", text, rows, "triangle", figures))
    return MeshError(Diagnostic("INDEX_RANGE", text, np.unique(array[outside]), "vertex", figures))


def boundary(
    fixed: npt.ArrayLike | None, fixed_normals: npt.ArrayLike | None
) -> tuple[IntArray | None, FloatArray | None]:
    """``fixed`` as (k,) and ``fixed_normals`` as (k, 3), each None where it was left out."""
    held = None if fixed is None else integers("fixed", fixed, None)
    if fixed_normals is None:
        return held, None
    if held is None:
        raise ValueError("fixed_normals: needs `fixed`, whose order it follows")
    return held, floats("fixed_normals", fixed_normals, held.shape[0])


def numbers(name: str, value: npt.ArrayLike, shape: tuple[int, ...], *, may_miss: bool = False) -> FloatArray:
    """Finite float64 of that shape, −1: any, in C order, or ValueError; ``may_miss``: NaN is one that is not known."""
    array = _array(name, value)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: numbers are needed, not {array.dtype}")
    if array.ndim != len(shape) or any(size not in (-1, own) for size, own in zip(shape, array.shape, strict=True)):
        raise ValueError(f"{name}: shape {shape} is needed, not {array.shape}".replace("-1", "c"))
    if (np.isinf(array) if may_miss else ~np.isfinite(array)).any():
        raise ValueError(f"{name}: finite numbers are needed{', or NaN where one is not known' * may_miss}")
    return np.ascontiguousarray(array, dtype=np.float64)


def curvatures(value: npt.ArrayLike, held: IntArray | None) -> FloatArray:
    """``fixed_curvatures`` as (k,) float64, NaN where it is not known, or ValueError."""
    if held is None:
        raise ValueError("fixed_curvatures: needs `fixed`, whose order it follows")
    return numbers("fixed_curvatures", value, held.shape, may_miss=True)


def indices_within(name: str, array: IntArray, count: int) -> IntArray:
    """The array itself, or MeshError INDEX_RANGE where an index is outside 0 … count − 1.

    Its elements: rows of the triangles, otherwise the vertices named.
    """
    if array.size == 0 or (array.min() >= 0 and array.max() < count):
        return array
    there_are = f"outside 0 … {count - 1}" if count else "but there are no vertices"
    outside = (array < 0) | (array >= count)
    raise _index_range(name, array, outside, there_are + _reason(array, count), vertices=float(count))


def _reason(array: IntArray, count: int) -> str:
    """What such indices usually come from, to be added to the message."""
    if array.min() < 0:
        return "; negative indices do not count from the end"
    if array.min() >= 1 and array.max() == count:
        return "; indices count from 0: subtract 1 from those of an OBJ file, which count from 1"
    return "; indices count from 0 (those of an OBJ file from 1)"


def vertices_of(name: str, value: npt.ArrayLike | None, count: int, columns: int | None = None) -> IntArray:
    """(k,), or (k, columns), of ``count`` vertices, none for None; ValueError, or MeshError INDEX_RANGE."""
    return indices_within(name, integers(name, [] if value is None else value, columns), count)


def triangles_within(value: npt.ArrayLike, count: int) -> IntArray:
    """Triangles of ``count`` vertices, (m, 3); ValueError, or MeshError INDEX_RANGE."""
    return indices_within("triangles", integers("triangles", value, 3), count)


def mesh(vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> tuple[FloatArray, IntArray]:
    """(n, 3) and (m, 3); ValueError, or MeshError INDEX_RANGE."""
    points = floats("vertices", vertices)
    return points, triangles_within(triangles, len(points))


def finite_mesh(vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> tuple[FloatArray, IntArray]:
    """The same, and MeshError NONFINITE where a triangle names a vertex that is NaN or infinite."""
    points, faces = mesh(vertices, triangles)
    refuse_not_finite(points, np.unique(faces))
    return points, faces


def refuse_not_finite(points: FloatArray, used: IntArray) -> None:
    """MeshError NONFINITE where one of the vertices used is NaN or infinite."""
    bad = used[~np.isfinite(points[used]).all(axis=1)].astype(np.int32)
    if len(bad):
        text = f"vertices: {len(bad)} of them are NaN or infinite, first {bad[0]}"
        raise MeshError(Diagnostic("NONFINITE", text, bad, "vertex", {"vertices": float(len(bad))}))


def held_mesh(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, fixed: npt.ArrayLike | None
) -> tuple[FloatArray, IntArray, IntArray | None]:
    """The same with the vertices ``fixed`` (k,), whose range the engine checks; None: not given."""
    return *mesh(vertices, triangles), boundary(fixed, None)[0]


def finite_triangles(points: FloatArray, triangles: IntArray) -> IntArray:
    """Those without a corner that is NaN or infinite."""
    return triangles[np.isfinite(points[triangles]).all(axis=(1, 2))]


def rows_within(name: str, value: npt.ArrayLike, count: int, what: str) -> IntArray:
    """(k,) numbers of ``count`` faces or triangles, or ValueError."""
    numbers = integers(name, value, None)
    outside = numbers[(numbers < 0) | (numbers >= count)]
    if len(outside):
        raise ValueError(f"{name}: there is no {what} {outside[0]}; there are {count}, counted from 0")
    return numbers


NO_EDGES: IntArray = np.empty((0, 2), dtype=np.int32)


def edges_of(name: str, value: npt.ArrayLike | None, triangles: IntArray) -> IntArray:
    """(e, 2) as given, none for None; ValueError where one is no edge of the triangles."""
    if value is None or np.size(value) == 0:
        return NO_EDGES
    pairs = integers(name, value, 2)
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    unknown = pairs[places_of(pairs, sides) < 0]
    if len(unknown):
        a, b = sorted(unknown[0].tolist())
        raise ValueError(f"{name}: {a} and {b} are not joined by an edge of the triangles")
    return pairs


def places_of(pairs: IntArray, others: IntArray) -> npt.NDArray[np.intp]:
    """(k,) where each pair of vertices (k, 2) stands among others, whichever way around; −1 where it doesn't."""
    keys, known = (np.sort(each, axis=1).astype(np.int64) @ [1 << 32, 1] for each in (pairs, others))
    if not len(known):
        return np.full(len(keys), -1)
    order = np.argsort(known, kind="stable")
    place = order[np.searchsorted(known[order], keys).clip(max=len(known) - 1)]
    return np.where(known[place] == keys, place, -1)


def choice(name: str, value: Any, accepted: Sequence[str]) -> str:
    """One of the accepted words, or a ValueError that lists them."""
    if not isinstance(value, str) or value not in accepted:
        listed = ", ".join(repr(word) for word in accepted)
        raise ValueError(f"{name}: {value!r} is not accepted; accepted are {listed}")
    return value


def finite(name: str, value: Any) -> float:
    """A finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.floating, np.integer)):
        raise ValueError(f"{name}: a finite number is needed, not {value!r}")
    if not math.isfinite(value):
        raise ValueError(f"{name}: a finite number is needed, not {value!r}")
    return float(value)


def positive(name: str, value: Any) -> float:
    """A finite number above zero."""
    if finite(name, value) <= 0:
        raise ValueError(f"{name}: a positive number is needed, not {value!r}")
    return float(value)


def length(name: str, value: Any, otherwise: str) -> float:
    """A finite number, 0 or more; ``otherwise``: what 0 stands for."""
    if finite(name, value) < 0:
        raise ValueError(f"{name}: a length, or 0 for {otherwise}, is needed, not {value!r}")
    return float(value)


def share(name: str, value: Any) -> float:
    """A number from 0 to 1."""
    if not 0.0 <= finite(name, value) <= 1.0:
        raise ValueError(f"{name}: a number from 0 to 1 is needed, not {value!r}")
    return float(value)


def whole(name: str, value: Any, smallest: int, largest: int | None = None) -> int:
    """An integer within the given bounds, and those of the engine's own integers."""
    bounds = f"{smallest} or more" if largest is None else f"{smallest} … {largest}"
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise ValueError(f"{name}: an integer, {bounds}, is needed, not {value!r}")
    if value > _INT32.max:
        bounds = f"{smallest} … {_INT32.max}"
    if not smallest <= value <= (_INT32.max if largest is None else largest):
        raise ValueError(f"{name}: {value} is not accepted; accepted is {bounds}")
    return int(value)


def listed(indices: IntArray) -> str:
    """A few vertices in words."""
    shown = ", ".join(str(index) for index in indices[:5])
    more = f" and {len(indices) - 5} more" if len(indices) > 5 else ""
    return f"vertex {shown}" if len(indices) == 1 else f"vertices {shown}{more}"
