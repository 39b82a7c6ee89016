"""``feather`` and ``weights``: a band around the patch takes part, and its vertices go part of the way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _mending
from fairing._mending import Answer, Boundary, Surroundings
from fairing._types import Diagnostic, FloatArray, IntArray

Marks = npt.NDArray[np.bool_]
Call = Callable[[Boundary, Surroundings, FloatArray], Answer]


@dataclass(frozen=True)
class Band:
    """The patch with the band around it, as one wider patch."""

    boundary: Boundary
    around: Surroundings
    """``inside``: the triangles of both; ``outside``: those beyond the band."""
    freed: IntArray
    """Vertices that only move with the band, ascending."""


def vertex_weights(value: npt.ArrayLike | None, count: int) -> FloatArray | None:
    """(n,) from 0 to 1, or None."""
    if value is None:
        return None
    weights = np.array(value, dtype=np.float64)
    if weights.shape != (count,) or not ((weights >= 0) & (weights <= 1)).all():
        raise ValueError(f"weights: {count} numbers from 0 to 1 are needed, one for each vertex")
    return weights


def width(value: Any, weights: FloatArray | None, refused: dict[str, bool]) -> float:
    """The feather; ``refused``: arguments beside which it or ``weights`` is, with whether they are there."""
    share = _arguments.finite("feather", value)
    if share < 0.0:
        raise ValueError(f"feather: 0 or a positive number is needed, not {value!r}")
    if share > 0.0 and weights is not None:
        raise ValueError("feather: is not accepted beside `weights`, which take its place")
    for name, given in refused.items():
        if given and (share > 0.0 or weights is not None):
            raise ValueError(f"{name}: this value is not accepted with `feather` or `weights`; leave it out")
    return share


def solve_feathered(
    call: Call, given: Boundary, triangles: IntArray, around: Surroundings, how: float | FloatArray
) -> Answer:
    """Solve the patch with its band, whose vertices go their part of the way.

    how: the width of the band as a share of D, or the weights (n,) themselves.
    """
    if isinstance(how, float) and not len(around.rim):
        raise ValueError(
            "feather: a band needs the triangles outside: pass them as `outside`, or among the triangles with all "
            "their vertices in `fixed`"
        )
    weights = _faded(given, around, how) if isinstance(how, float) else how
    band = _widened(given, around, weights)
    answer = _mending.with_join(call(band.boundary, band.around, weights), band.around)
    for name in ("vertices", "base"):
        answer[name] = np.where((weights > 0.0)[:, None], answer[name], given.vertices)
        answer[name].flags.writeable = False
    answer["moved"] = band.freed
    rows = _rows(band.around.inside, triangles)
    answer["warnings"] = tuple(_renumbered(told, rows) for told in answer["warnings"])
    return answer


def feather_weights(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    outside: npt.ArrayLike,
    feather: float,
    *,
    fixed: npt.ArrayLike | None = None,
) -> FloatArray:
    """Return the ``weights`` (n,) that ``feather`` stands for in :func:`fairing.fair`, to be changed by hand.

    1 inside, 1 − s² (3 − 2 s) in the band, s the distance from the outline over the width, 0 beyond. The arguments
    are those of :func:`fairing.fair`; ``feather`` is above 0.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    held, _ = _arguments.boundary(fixed, None)
    share = width(feather, None, {})
    if share == 0.0:
        raise ValueError("feather: a number above 0 is needed: 0 is no band")
    around = Surroundings.of(points, faces, held, outside)
    return _faded(Boundary(points, held, None), around, share)


def _faded(given: Boundary, around: Surroundings, share: float) -> FloatArray:
    """Weights of bands, each as wide as its component asks for."""
    points = given.vertices
    component = _core.components(around.inside, given.fixed, len(points))
    weights = _marked(around.inside, len(points)).astype(np.float64)
    for number in range(component.max(initial=-1) + 1):
        inside = around.inside[component == number]
        rim = points[np.intersect1d(inside, around.rim)]
        if len(rim):
            diameter = 2.0 * float(np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())
            faded = _core.feather_weights(points, inside, around.outside, share * diameter)
            np.maximum(weights, faded, out=weights)
    return weights


def _marked(vertices: npt.NDArray[Any], count: int) -> Marks:
    mask = np.zeros(count, dtype=bool)
    mask[vertices[(vertices >= 0) & (vertices < count)]] = True
    return mask


def _widened(given: Boundary, around: Surroundings, weights: FloatArray) -> Band:
    """Free the vertices of the triangles outside that have a weight.

    Those on the mesh border or at edges with more than two triangles stay, as do pins and curves inside the patch.
    """
    count = len(given.vertices)
    both = np.concatenate([around.inside, around.outside])
    held = _at_odd_edges(both, count)
    freed = _marked(around.outside, count) & (weights > 0.0) & ~held
    fixed = _marked(around.rim if given.fixed is None else given.fixed, count)
    free = (_marked(around.inside, count) & ~fixed & ~held) | freed
    taken = np.concatenate([np.ones(len(around.inside), dtype=bool), free[around.outside].any(axis=1)])
    wider = Surroundings.between(given.vertices, both[taken], both[~taken])
    ends = np.flatnonzero(_marked(wider.inside, count) & ~free).astype(np.int32)
    own = np.intersect1d(ends, around.inside)
    boundary = Boundary(given.vertices, ends, _normals(given, own, wider, ends))
    return Band(boundary, wider, np.flatnonzero(freed).astype(np.int32))


def _at_odd_edges(triangles: IntArray, count: int) -> Marks:
    """Marks (n,) of the ends of edges that don't have two triangles."""
    sides = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    edges, uses = np.unique(sides, axis=0, return_counts=True)
    return _marked(edges[uses != 2], count)


def _normals(given: Boundary, own: IntArray, wider: Surroundings, ends: IntArray) -> FloatArray:
    """As given at the patch's ``own``, else fitted where triangles lie beyond, else averaged."""
    normals = _core.vertex_normals(given.vertices, wider.inside, "averaged")[ends]
    nowhere = np.empty((0, 2), dtype=np.int32)
    fitted = _core.surrounding_normals(given.vertices, wider.outside, wider.rim, nowhere)["normals"]
    _, here, there = np.intersect1d(ends, wider.rim, return_indices=True)
    normals[here] = fitted[there]
    if given.normals is not None and given.fixed is not None:
        kept, _, there = np.intersect1d(own, given.fixed, return_indices=True)
        normals[np.searchsorted(ends, kept)] = given.normals[there]
    return normals


def _rows(triangles: IntArray, among: IntArray) -> IntArray:
    """Which row of ``among`` each triangle is; −1: none."""
    _, first, inverse = np.unique(np.concatenate([among, triangles]), axis=0, return_index=True, return_inverse=True)
    rows = first[inverse.reshape(-1)[len(among) :]]
    return np.where(rows < len(among), rows, -1).astype(np.int32)


def _renumbered(told: Diagnostic, rows: IntArray) -> Diagnostic:
    """By the caller's triangles; those of the band alone have no number."""
    if told.kind != "triangle":
        return told
    elements = rows[told.elements]
    return replace(told, elements=elements[elements >= 0])
