"""Meshes that can't be faired, or only with a warning: each with the code it must cause.

`CASES` are refused with MeshError, `WARNINGS` are solved. A case is a function without arguments.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import measures
import shapes
from curves import FloatArray
from meshing import IntArray


@dataclass(frozen=True)
class Case:
    """vertices (n, 3), triangles (m, 3), further arguments of `fair`, and what must come of it.

    elements: indices that the error or warning must name (None: any).
    """

    vertices: FloatArray
    triangles: IntArray
    code: str
    elements: tuple[int, ...] | None = None
    options: dict[str, Any] = field(default_factory=dict)


def _base(n_free: int = 60) -> shapes.Patch:
    return shapes.cap(n_free)


def _inner_edge(patch: shapes.Patch) -> tuple[int, int]:
    """An edge between two free vertices."""
    edges = measures.edges(patch.triangles)
    free = edges[np.isin(edges, patch.free).all(axis=1)]
    return int(free[0, 0]), int(free[0, 1])


def _spoilt(array: Any, row: int, column: int, value: float) -> Any:
    """A copy with one entry changed."""
    copy = array.copy()
    copy[row, column] = value
    return copy


def not_a_number() -> Case:
    """One free vertex is NaN."""
    patch = _base()
    at = int(patch.free[5])
    return Case(_spoilt(patch.vertices, at, 1, np.nan), patch.triangles, "NONFINITE", (at,))


def infinite() -> Case:
    """One fixed vertex is infinite."""
    patch = _base()
    at = int(patch.fixed[2])
    return Case(_spoilt(patch.vertices, at, 0, np.inf), patch.triangles, "NONFINITE", (at,))


def normal_not_a_number() -> Case:
    """One prescribed normal is NaN."""
    patch = _base()
    options = {"fixed": patch.fixed, "fixed_normals": _spoilt(patch.fixed_normals, 3, 0, np.nan)}
    return Case(patch.vertices, patch.triangles, "NONFINITE", None, options)


def index_too_large() -> Case:
    """A triangle names a vertex that does not exist."""
    patch = _base()
    return Case(patch.vertices, _spoilt(patch.triangles, 4, 1, len(patch.vertices)), "INDEX_RANGE")


def index_negative() -> Case:
    """A triangle names vertex −1."""
    patch = _base()
    return Case(patch.vertices, _spoilt(patch.triangles, 4, 1, -1), "INDEX_RANGE")


def fixed_out_of_range() -> Case:
    """`fixed` names a vertex that does not exist."""
    patch = _base()
    fixed = np.append(patch.fixed, len(patch.vertices) + 3)
    return Case(patch.vertices, patch.triangles, "INDEX_RANGE", None, {"fixed": fixed})


def edge_of_three() -> Case:
    """A bubble stands on a triangle between free vertices: three edges of three triangles."""
    patch = _base()
    inside = patch.triangles[np.isin(patch.triangles, patch.free).all(axis=1)][0]
    vertices = np.vstack([patch.vertices, 1.5 * patch.vertices[[inside[0]]]])
    top = len(patch.vertices)
    bubble = [[inside[k], inside[(k + 1) % 3], top] for k in range(3)]
    triangles = np.vstack([patch.triangles, bubble])
    return Case(vertices, triangles, "NONMANIFOLD_EDGE", tuple(int(v) for v in inside))


def fin() -> Case:
    """A single triangle stands on an edge in the middle of the patch, whose outline is given."""
    patch = _base()
    a, b = _inner_edge(patch)
    vertices = np.vstack([patch.vertices, 2 * patch.vertices[[a]]])
    triangles = np.vstack([patch.triangles, [[a, b, len(patch.vertices)]]])
    options = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals}
    return Case(vertices, triangles, "NONMANIFOLD_EDGE", (a, b), options)


def bow_tie() -> Case:
    """Two discs share one free vertex."""
    patch = _base()
    count, shared = len(patch.vertices), int(patch.free[0])
    other = patch.triangles + count
    other[other == shared + count] = shared
    vertices = np.vstack([patch.vertices, patch.vertices + np.array([0.0, 0.0, 2.0])])
    return Case(vertices, np.vstack([patch.triangles, other]), "NONMANIFOLD_VERTEX", (shared,))


def moebius_strip() -> Case:
    """A band with half a twist, five vertices across."""
    rows, columns = 30, 5
    angle = np.repeat(2 * np.pi * np.arange(rows) / rows, columns)
    across = np.tile(np.linspace(-0.4, 0.4, columns), rows)
    radius = 1 + across * np.cos(angle / 2)
    vertices = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), across * np.sin(angle / 2)])
    i, j = (k.ravel() for k in np.meshgrid(np.arange(rows), np.arange(columns - 1), indexing="ij"))
    a, d = i * columns + j, i * columns + j + 1
    last = i == rows - 1
    b = np.where(last, columns - 1 - j, (i + 1) * columns + j)
    c = np.where(last, columns - 2 - j, (i + 1) * columns + j + 1)
    triangles = np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return Case(vertices, triangles, "NOT_ORIENTABLE")


def closed_sphere() -> Case:
    """Two hemispheres joined at the equator, nothing fixed."""
    vertices, triangles, _ = closed_ball()
    return Case(vertices, triangles, "NO_BOUNDARY")


def single_triangle() -> Case:
    """Nothing to move."""
    vertices = np.eye(3)
    return Case(vertices, np.array([[0, 1, 2]]), "NO_FREE_VERTICES")


def everything_fixed() -> Case:
    """All vertices are fixed by the caller."""
    patch = _base()
    everything = np.arange(len(patch.vertices))
    options = {"fixed": everything, "fixed_normals": patch.normals}
    return Case(patch.vertices, patch.triangles, "NO_FREE_VERTICES", None, options)


def closed_ball(n_free: int = 60) -> tuple[FloatArray, IntArray, IntArray]:
    """The unit sphere from two different irregular hemispheres: vertices, triangles, equator."""
    upper = shapes.cap(n_free, shapes.Style(seed=1))
    lower = shapes.cap(n_free, shapes.Style(seed=2))
    if len(upper.fixed) != len(lower.fixed):
        raise RuntimeError("the rims of the two hemispheres differ")
    count = len(upper.vertices)
    index = np.empty(len(lower.vertices), dtype=np.int64)
    index[lower.free] = count + np.arange(len(lower.free))
    index[lower.fixed] = upper.fixed
    mirrored = lower.vertices[lower.free] * [1.0, 1.0, -1.0]
    triangles = np.vstack([upper.triangles, index[lower.triangles][:, ::-1]])
    return np.vstack([upper.vertices, mirrored]), triangles, upper.fixed


def ball_of_meridians(segments: int, rings: int) -> tuple[FloatArray, IntArray]:
    """The unit sphere as Blender makes it, quads cut in two; the first two triangles are one of them."""
    polar = np.pi * np.arange(1, rings) / rings
    around = 2 * np.pi * np.arange(segments) / segments
    inner = [(np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)) for t in polar for p in around]
    vertices = np.array([(0, 0, 1), *inner, (0, 0, -1)])
    last = len(vertices) - 1
    triangles = []
    for i in range(segments):
        j = (i + 1) % segments
        for k in range(rings - 2):
            a, b = 1 + k * segments, 1 + (k + 1) * segments
            triangles += [(a + i, b + i, b + j), (a + i, b + j, a + j)]
        end = 1 + (rings - 2) * segments
        triangles += [(0, 1 + i, 1 + j), (end + i, last, end + j)]
    return vertices, np.array(triangles)


def folded_winding() -> Case:
    """One triangle is wound the other way."""
    patch = _base()
    triangles = patch.triangles.copy()
    triangles[7] = triangles[7, ::-1]
    options = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals}
    return Case(patch.vertices, triangles, "INCONSISTENT_WINDING", (7,), options)


def zero_area() -> Case:
    """A triangle names a vertex twice."""
    patch = _base()
    a, b = _inner_edge(patch)
    triangles = np.vstack([patch.triangles, [[a, b, b]]])
    options = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals}
    return Case(patch.vertices, triangles, "DEGENERATE_FACE", (len(patch.triangles),), options)


def reversed_normals() -> Case:
    """All prescribed normals point against the winding."""
    patch = _base()
    options = {"fixed": patch.fixed, "fixed_normals": -patch.fixed_normals}
    return Case(patch.vertices, patch.triangles, "NORMALS_OPPOSE_WINDING", None, options)


def no_normals() -> Case:
    """Normals are left to the patch itself."""
    patch = _base()
    return Case(patch.vertices, patch.triangles, "NORMALS_FROM_PATCH")


def pinned_normal() -> Case:
    """One vertex in the middle is fixed alone, with a normal."""
    patch = _base(200)
    pin = int(patch.free[np.argmax(patch.vertices[patch.free, 2])])
    fixed = np.append(patch.fixed, pin)
    options = {"fixed": fixed, "fixed_normals": patch.normals[fixed]}
    return Case(patch.vertices, patch.triangles, "PIN_NORMAL_IGNORED", (pin,), options)


def island_without_border() -> Case:
    """A hemisphere, and beside it a closed sphere that has nothing to hold on to."""
    patch = _base()
    vertices, triangles, _ = closed_ball()
    count = len(patch.vertices)
    options = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals}
    everything = np.vstack([patch.vertices, vertices + np.array([3.0, 0.0, 0.0])])
    return Case(everything, np.vstack([patch.triangles, triangles + count]), "NO_BOUNDARY", None, options)


CASES: dict[str, Callable[[], Case]] = {
    case.__name__: case
    for case in (
        not_a_number, infinite, normal_not_a_number, index_too_large, index_negative,
        fixed_out_of_range, edge_of_three, fin, bow_tie, moebius_strip, closed_sphere, single_triangle,
        everything_fixed,
    )
}  # fmt: skip
WARNINGS: dict[str, Callable[[], Case]] = {
    case.__name__: case
    for case in (
        folded_winding, zero_area, reversed_normals, no_normals, pinned_normal,
        island_without_border,
    )
}  # fmt: skip
