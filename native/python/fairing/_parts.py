"""Continuity that differs along the boundary, as the engine has it: free slopes, and curvatures not asked for."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing._groups import Boundary, Options
from fairing._types import FloatArray

KINDS = ("G0", "G1", "G2")


def by_parts(boundary: Boundary, options: Options) -> tuple[Boundary, Options]:
    """The boundary and the options of a call; ``continuity`` stays in the boundary where some of it is "G2".

    Raises ValueError for other words or another shape, for what contradicts ``options``, and for "G0" beside "G2".
    """
    if boundary.continuity is None:
        return boundary, options
    kinds = checked(boundary.continuity, boundary.vertices)
    fixed = _arguments.integers("fixed", boundary.vertices, None)  # type: ignore[arg-type]
    loose, curved = kinds == "G0", kinds == "G2"
    if loose.any() and (curved.any() or options.surface.continuity == "G2"):
        raise ValueError(
            "continuity: 'G0' and 'G2' are not accepted in one boundary: a surface with free slopes is one of least "
            "variation, and curvatures are met by the harmonic equation"
        )
    if loose.any():
        given = _arguments.integers("creases", _or_none(options.curves.creases), None)
        options = options.changed(creases=np.union1d(given, fixed[loose]).astype(np.int32))
    if not curved.any():
        if options.surface.continuity == "G2":  # the words along the boundary say more
            boundary, options = replace(boundary, curvatures=None), options.changed(continuity="G1")
        return replace(boundary, continuity=None), options
    return replace(boundary, continuity=kinds), options.changed(continuity="G2")


def where_met(curvatures: FloatArray, kinds: Any) -> FloatArray:
    """(k,) curvatures of the vertices that are to continue them, infinite at the others; ``kinds`` None: all are."""
    return curvatures if kinds is None else np.where(kinds == "G2", curvatures, np.inf)


def _or_none(value: npt.ArrayLike | None) -> npt.ArrayLike:
    return np.empty(0, dtype=np.int32) if value is None else value


def checked(value: Any, vertices: Any) -> npt.NDArray[np.str_]:
    """The (k,) words of ``continuity``; raises ValueError for others, or another shape than that of ``vertices``."""
    if vertices is None:
        raise ValueError("continuity: needs `vertices`, whose order it follows")
    kinds = np.asarray(value)
    count = len(np.asarray(vertices))
    if kinds.shape != (count,):
        raise ValueError(f"continuity: shape ({count},) is needed, one word for each vertex, not {kinds.shape}")
    unknown = kinds[~np.isin(kinds, KINDS)]
    if len(unknown):
        listed = ", ".join(repr(kind) for kind in KINDS)
        raise ValueError(f"continuity: {unknown[0]!r} is not accepted; accepted are {listed}")
    return kinds
