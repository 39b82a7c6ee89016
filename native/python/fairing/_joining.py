"""``continuity="G2"``: the mean curvatures that a surface has to meet at its boundary."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from fairing import _arguments
from fairing._mending import Boundary, Surroundings
from fairing._outline import surrounding_normals


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
    fits = surrounding_normals(boundary.vertices, around.outside, fixed)
    curvatures = fits.trusted_curvatures
    if boundary.normals is not None:  # H on the side of the normals
        curvatures = np.where((fits.normals * boundary.normals).sum(axis=1) < 0, -curvatures, curvatures)
    return replace(boundary, fixed=fixed, curvatures=curvatures)
