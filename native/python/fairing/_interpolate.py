"""Values of some vertices, continued over a mesh."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._types import FloatArray


def interpolate(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, fixed: npt.ArrayLike, values: npt.ArrayLike
) -> FloatArray:
    """(n, c) values at all vertices: those given, (k, c), at the ``fixed`` ones (k,), harmonic at the others.

    That is as heat would spread: no value leaves the range of its column. Cotangent weights, none below a thousandth.
    ``fixed`` must have all border vertices that triangles use. Zero at vertices that hang together with no fixed one.
    Errors as in :func:`fairing.fair`.
    """
    points, faces, held = _arguments.held_mesh(vertices, triangles, fixed)
    given = np.ascontiguousarray(values, dtype=np.float64)
    count = 0 if held is None else len(held)
    if given.ndim != 2 or len(given) != count:
        raise ValueError(f"values: expected shape ({count}, c), got {given.shape}")
    if not np.isfinite(given).all():
        raise ValueError("values: expected finite numbers")
    border = [np.empty(0, dtype=np.int32), *_core.boundary_loops(faces)]
    missing = np.setdiff1d(np.concatenate(border), np.empty(0) if held is None else held)
    if len(missing):
        raise ValueError(f"fixed: border vertex {missing[0]} needs a value")
    if held is None or not given.shape[1]:
        return np.zeros((len(points), given.shape[1]))
    everywhere: FloatArray = _core.interpolate(points, faces, held, given).copy()
    everywhere[held] = given
    return np.clip(everywhere, given.min(axis=0), given.max(axis=0))
