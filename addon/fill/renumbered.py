"""The surface over one of many holes, in the numbers of what is around it. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from ..arrays.types import Ints


def renumbered(result: fairing.FillResult, old: Ints, new: Ints) -> fairing.FillResult:
    """Return a result with other numbers; old, new: the mesh vertices that numbers stand for, both ascending."""
    number = np.concatenate([np.searchsorted(new, old), len(new) + np.arange(len(result.vertices))]).astype(np.int32)
    quads = result.quads
    if quads is not None:
        quads = replace(quads, quads=number[quads.quads], triangles=number[quads.triangles])
    return replace(
        result,
        triangles=number[result.triangles],
        fixed=number[result.fixed],
        loops=tuple(number[loop] for loop in result.loops),
        curves=tuple(number[curve] for curve in result.curves),
        bands=tuple(tuple(number[row] for row in band) for band in result.bands),
        warnings=tuple(_warning(each, number) for each in result.warnings),
        quads=quads,
    )


def _warning(warning: fairing.Diagnostic, number: Ints) -> fairing.Diagnostic:
    if warning.kind != "vertex":
        return warning
    return replace(warning, elements=number[warning.elements].astype(np.int32))
