"""``continuity="G2"``: the mean curvatures that a surface has to meet at its outline."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from fairing import _arguments, _core
from fairing._mending import Boundary, Surroundings
from fairing._types import FloatArray


def with_curvatures(boundary: Boundary, around: Surroundings, given: Any) -> Boundary:
    """The boundary with H at ``fixed``, NaN where it is not known: as given, or fitted to the triangles outside."""
    if given is not None:
        return replace(boundary, curvatures=_arguments.curvatures(given, boundary.fixed))
    if not len(around.rim):
        raise ValueError(
            "continuity: 'G2' needs the curvature at the outline: pass fixed_curvatures, or the triangles outside as "
            "`outside` or among the triangles with all their vertices in `fixed`"
        )
    fixed = around.rim if boundary.fixed is None else boundary.fixed
    fits = _core.surrounding_normals(boundary.vertices, around.outside, fixed)
    return replace(boundary, fixed=fixed, curvatures=_trusted(fits, boundary.normals))


def _trusted(fits: dict[str, Any], normals: FloatArray | None) -> FloatArray:
    """H on the side of the ``normals``, if they are given; NaN where a fit is far less certain than the others."""
    curvatures: FloatArray = fits["curvatures"].copy()
    errors, fitted = fits["curvature_errors"], fits["fitted"]
    if fitted.any():
        usual = max(4.0 * float(np.median(errors[fitted])), 0.25 * float(np.abs(curvatures[fitted]).max()))
        curvatures[errors > usual] = np.nan
    if normals is not None:
        curvatures[(fits["normals"] * normals).sum(axis=1) < 0] *= -1.0
    return curvatures
