"""Meshes that can't be faired, or only with a warning, by name; closed balls.

`CASES` are refused with MeshError, `WARNINGS` are solved.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

import measures
import shapes
from curves import FloatArray
from meshing import IntArray


@dataclass(frozen=True)
class Case:
    """vertices (n, 3), triangles (m, 3), the code that must come of it, the elements that must be named, options."""

    vertices: FloatArray
    triangles: IntArray
    code: str
    elements: tuple[int, ...] = ()
    options: dict[str, Any] = field(default_factory=dict)


def with_entry(array: Any, row: int, column: int, value: float) -> Any:
    """A copy with one entry changed."""
    copy = array.copy()
    copy[row, column] = value
    return copy


def moebius_strip() -> tuple[FloatArray, IntArray]:
    """A band with half a twist, five vertices across."""
    rows, columns = 30, 5
    angle = np.repeat(2 * np.pi * np.arange(rows) / rows, columns)
    across = np.tile(np.linspace(-0.4, 0.4, columns), rows)
    radius = 1 + across * np.cos(angle / 2)
    vertices = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), across * np.sin(angle / 2)])
    i, j = (k.ravel() for k in np.meshgrid(np.arange(rows), np.arange(columns - 1), indexing="ij"))
    a, d = i * columns + j, i * columns + j + 1
    b = np.where(i == rows - 1, columns - 1 - j, (i + 1) * columns + j)
    c = np.where(i == rows - 1, columns - 2 - j, (i + 1) * columns + j + 1)
    return vertices, np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def closed_ball(n_free: int = 60) -> tuple[FloatArray, IntArray, IntArray]:
    """The unit sphere from two different irregular hemispheres: vertices, triangles, equator."""
    upper, lower = (shapes.cap(n_free, shapes.Style(seed=seed)) for seed in (1, 2))
    if len(upper.fixed) != len(lower.fixed):
        raise RuntimeError("the rims of the two hemispheres differ")
    index = np.empty(len(lower.vertices), dtype=np.int64)
    index[lower.free] = len(upper.vertices) + np.arange(len(lower.free))
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
    last, end, triangles = len(vertices) - 1, 1 + (rings - 2) * segments, []
    for i in range(segments):
        j = (i + 1) % segments
        for k in range(rings - 2):
            a, b = 1 + k * segments, 1 + (k + 1) * segments
            triangles += [(a + i, b + i, b + j), (a + i, b + j, a + j)]
        triangles += [(0, 1 + i, 1 + j), (end + i, last, end + j)]
    return vertices, np.array(triangles)


_CAP = shapes.cap(60)
_V, _T, _COUNT = _CAP.vertices, _CAP.triangles, len(_CAP.vertices)
_HELD = {"fixed": _CAP.fixed, "fixed_normals": _CAP.fixed_normals}
_AT, _RIM = int(_CAP.free[5]), int(_CAP.fixed[2])
_EDGES = measures.edges(_T)
_A, _B = (int(v) for v in _EDGES[np.isin(_EDGES, _CAP.free).all(axis=1)][0])
_WITHIN = _T[np.isin(_T, _CAP.free).all(axis=1)][0]


def _bubble() -> Case:
    """It stands on a triangle between free vertices: three edges of three triangles."""
    sides = [[_WITHIN[k], _WITHIN[(k + 1) % 3], _COUNT] for k in range(3)]
    vertices = np.vstack([_V, 1.5 * _V[[_WITHIN[0]]]])
    return Case(vertices, np.vstack([_T, sides]), "NONMANIFOLD_EDGE", tuple(int(v) for v in _WITHIN))


def _bow_tie() -> Case:
    """Two discs share one free vertex."""
    shared = int(_CAP.free[0])
    other = np.where(shared == _T, shared, _T + _COUNT)
    return Case(
        np.vstack([_V, _V + np.array([0.0, 0.0, 2.0])]), np.vstack([_T, other]), "NONMANIFOLD_VERTEX", (shared,)
    )


CASES: dict[str, Case] = {
    "not a number": Case(with_entry(_V, _AT, 1, np.nan), _T, "NONFINITE", (_AT,)),
    "infinite": Case(with_entry(_V, _RIM, 0, np.inf), _T, "NONFINITE", (_RIM,)),
    "normal not a number": Case(
        _V, _T, "NONFINITE", (), {**_HELD, "fixed_normals": with_entry(_CAP.fixed_normals, 3, 0, np.nan)}
    ),
    "normal of length zero": Case(
        _V, _T, "ZERO_NORMAL", (int(_CAP.fixed[3]),), {**_HELD, "fixed_normals": _CAP.fixed_normals * (np.arange(
            len(_CAP.fixed)) != 3)[:, None]}
    ),
    "index too large": Case(_V, with_entry(_T, 4, 1, _COUNT), "INDEX_RANGE", (4,)),
    "index negative": Case(_V, with_entry(_T, 4, 1, -1), "INDEX_RANGE", (4,)),
    "fixed out of range": Case(_V, _T, "INDEX_RANGE", (_COUNT + 3,), {"fixed": np.append(_CAP.fixed, _COUNT + 3)}),
    "edge of three": _bubble(),
    "fin": Case(
        np.vstack([_V, 2 * _V[[_A]]]), np.vstack([_T, [[_A, _B, _COUNT]]]), "NONMANIFOLD_EDGE", (_A, _B), _HELD
    ),
    "bow tie": _bow_tie(),
    "moebius strip": Case(*moebius_strip(), "NOT_ORIENTABLE"),
    "closed sphere": Case(*closed_ball()[:2], "NO_BOUNDARY"),
    "single triangle": Case(np.eye(3), np.array([[0, 1, 2]]), "NO_FREE_VERTICES"),
    "everything fixed": Case(
        _V, _T, "NO_FREE_VERTICES", (), {"fixed": np.arange(_COUNT), "fixed_normals": _CAP.normals}
    ),
}  # fmt: skip
_PINNED = np.append(_CAP.fixed, _AT)
_TURNED = _T.copy()
_TURNED[7] = _T[7, ::-1]
WARNINGS: dict[str, Case] = {
    "one triangle turned": Case(_V, _TURNED, "INCONSISTENT_WINDING", (7,), _HELD),
    "no area": Case(_V, np.vstack([_T, [[_A, _B, _B]]]), "DEGENERATE_FACE", (len(_T),), _HELD),
    "normals reversed": Case(
        _V, _T, "NORMALS_OPPOSE_WINDING", (), {**_HELD, "fixed_normals": -_CAP.fixed_normals}
    ),
    "no normals": Case(_V, _T, "NORMALS_FROM_PATCH"),
    "a pin's normal": Case(
        _V, _T, "PIN_NORMAL_IGNORED", (_AT,), {"fixed": _PINNED, "fixed_normals": _CAP.normals[_PINNED]}
    ),
    "an island without a border": Case(
        np.vstack([_V, closed_ball()[0] + [3.0, 0.0, 0.0]]), np.vstack([_T, closed_ball()[1] + _COUNT]),
        "NO_BOUNDARY", (), _HELD,
    ),
}  # fmt: skip
