"""What one call has made of many loops, loop by loop. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from .arrays import Ints

Stars = dict[int, list[int]]  # the triangles at each vertex


def parted(
    result: fairing.FillResult, stars: Stars, loop: Ints, spaces: tuple[Ints, Ints]
) -> fairing.FillResult | None:
    """Return what a result over many loops is over one of them, in the numbers of other surroundings.

    stars: of the result. loop: (k,) in the numbers of the result's old vertices. spaces: the mesh vertices that old
    vertices were, and those that they are to be, both ascending. None where that loop was left open, or curves
    run through it.
    """
    old, new = spaces
    count = len(old)
    rows = _triangles_over(result, stars, loop, count)
    if not len(rows) or any(np.isin(curve, loop).any() for curve in result.curves):
        return None
    triangles = result.triangles[rows].astype(np.int64)
    added = np.unique(triangles[triangles >= count])
    number = np.zeros(count + len(result.vertices), dtype=np.int64)
    number[:count] = np.searchsorted(new, old)
    number[added] = len(new) + np.arange(len(added))
    at = np.flatnonzero(np.isin(result.fixed, loop))
    return replace(
        result,
        vertices=result.vertices[added - count],
        triangles=number[triangles].astype(np.int32),
        mean_curvature=result.mean_curvature[added - count],
        fixed=number[result.fixed[at]].astype(np.int32),
        boundary_angle=result.boundary_angle[at],
        join=result.join[at],
        warnings=tuple(_numbered(each, number) for each in result.warnings if _is_about(each, loop, added)),
        loops=(number[loop].astype(np.int32),),
        left_open=(),
        left_because=(),
        curves=(),
        marked=(),
    )


def _triangles_over(result: fairing.FillResult, stars: Stars, loop: Ints, count: int) -> Ints:
    """Return the numbers of the triangles over a loop: from its edges on to all that new vertices join with them."""
    edges = set(zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))
    ahead = [row for vertex in loop.tolist() for row in stars.get(vertex, ()) if _has_side(result, row, edges)]
    found: set[int] = set()
    while ahead:
        row = ahead.pop()
        if row not in found:
            found.add(row)
            for vertex in result.triangles[row].tolist():
                if vertex >= count:
                    ahead += stars[vertex]
    return np.array(sorted(found), dtype=np.int64)


def stars_of(result: fairing.FillResult) -> Stars:
    """Return the numbers of the triangles at each vertex that has any."""
    rows: Stars = {}
    for row, corners in enumerate(result.triangles.tolist()):
        for vertex in corners:
            rows.setdefault(vertex, []).append(row)
    return rows


def _has_side(result: fairing.FillResult, row: int, edges: set[tuple[int, int]]) -> bool:
    a, b, c = result.triangles[row].tolist()
    return (a, b) in edges or (b, c) in edges or (c, a) in edges


def _is_about(warning: fairing.Diagnostic, loop: Ints, added: Ints) -> bool:
    """Return whether a warning names one of these vertices, or says nothing about where."""
    if warning.kind != "vertex":
        return True
    known = np.concatenate([loop, added])
    return not len(warning.elements) or bool(np.isin(warning.elements, known).any())


def _numbered(warning: fairing.Diagnostic, number: Ints) -> fairing.Diagnostic:
    return replace(warning, elements=number[warning.elements].astype(np.int32)) if warning.kind == "vertex" else warning
