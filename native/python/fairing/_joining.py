"""``continuity="G2"``: the mean curvatures that a surface has to meet at its boundary."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from fairing import _arguments
from fairing._boundary_normals import boundary_normals
from fairing._mending import Boundary, Surroundings
from fairing._outline import surrounding_normals
from fairing._parts import where_met


def with_curvatures(boundary: Boundary, around: Surroundings, given: Any, kinds: Any = None) -> Boundary:
    """The boundary with H at ``fixed``, as given, or fitted to the triangles outside, NaN where it is not known.

    kinds: the words of the continuity at ``fixed`` (k,), where they differ.
    """
    if given is not None:
        return replace(boundary, curvatures=where_met(_arguments.curvatures(given, boundary.fixed), kinds))
    if not len(around.rim):
        raise ValueError(
            "continuity: 'G2' needs the curvature at the outline: pass fixed_curvatures, or the triangles outside as "
            "`outside` or among the triangles with all their vertices in `fixed`"
        )
    fixed = around.rim if boundary.fixed is None else boundary.fixed
    fits = boundary_normals(boundary.vertices, around.inside, fixed, outside=around.outside)
    curvatures = fits.trusted_curvatures
    if boundary.normals is not None:
        given = boundary.normals  # of any length
        beyond = surrounding_normals(boundary.vertices, around.outside, fixed)
        nearer = np.abs((beyond.normals * given).sum(axis=1)) > np.abs((fits.normals * given).sum(axis=1))
        chosen = nearer & fits.from_inside  # somebody prefers the slope outside
        curvatures = np.where(chosen, beyond.trusted_curvatures, curvatures)
        normals = np.where(chosen[:, None], beyond.normals, fits.normals)
        against = (normals * given).sum(axis=1) < 0
        curvatures = np.where(against, -curvatures, curvatures)  # H on the side of the normals
    return replace(boundary, fixed=fixed, curvatures=where_met(curvatures, kinds))
