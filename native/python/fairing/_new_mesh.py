"""What `fill` and `remesh` give back."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, Literal

import numpy as np

from fairing._types import Diagnostic, FairResult, FloatArray, IntArray

Origin = tuple[IntArray, FloatArray]


@dataclass(frozen=True, eq=False)
class PairedQuads:
    """The faces that :func:`fairing.maps.paired_quads` makes of m triangles: q quads and t triangles."""

    quads: IntArray
    """(q, 4) vertices, wound like the triangles. Corners 1 and 3 are the ends of the edge that went."""
    triangles: IntArray
    """(t, 3) vertices of the triangles without a partner, as given."""
    pairs: IntArray
    """(q, 2) the two triangles of each quad: corner 0 is of the first alone, corner 2 of the second."""
    rest: IntArray
    """(t,) the triangles without a partner, ascending."""


@dataclass(frozen=True, eq=False)
class NewMeshResult:
    """What a fairing on a new mesh gives back. All arrays are read-only; see :class:`fairing.FairResult`."""

    vertices: FloatArray
    """(k, 3) the new vertices."""
    triangles: IntArray
    """(m, 3) the new triangles: indices below n are the caller's vertices, n … n + k − 1 the new ones, as in
    ``np.concatenate([vertices, result.vertices])``. They are wound as the triangles around."""
    mean_curvature: FloatArray
    """(k,) H at the new vertices."""
    fixed: IntArray
    """(k',) the boundary's vertices."""
    boundary_angle: FloatArray
    """(k',) degrees between prescribed and obtained normals, in the order of ``fixed``."""
    join: FloatArray
    """(k',) degrees, in the order of ``fixed``: how visible the join is."""
    continuity: Literal["G1", "G2"]
    converged: bool
    polished: bool
    """Whether the discrete equation holds on the new mesh. False, with ``converged``: the surface was solved on another
    mesh, and the new vertices lie on that surface."""
    cut: bool
    """Whether nothing was solved for this mesh: it was cut from the surface of another one, a finer new one
    (:func:`fairing.fill`) or the old one (:func:`fairing.remesh`)."""
    termination: Literal["converged", "iteration_limit", "stalled", "folded"]
    equation: str
    """The equation that holds (see ``otherwise`` of :func:`fairing.fair`)."""
    provenance: str
    girth: tuple[float, float] | None
    iterations: int
    residual: float
    initial_residual: float
    levels: tuple[int, ...]
    seconds: dict[str, float]
    way: tuple[tuple[str, float], ...]
    warnings: tuple[Diagnostic, ...]
    """Triangles and vertices that they name are those of the mesh that was solved: this one unless it was ``cut``."""
    quads: PairedQuads | None = field(default=None, kw_only=True)
    """Of ``faces="quads"``: which of ``triangles`` are halves of a quad, and which are left."""


@dataclass(frozen=True, eq=False)
class Hole:
    """A hole, or several loops that are joined."""

    loops: tuple[IntArray, ...]
    """In the direction that has the new surface on their left."""
    surface: FillResult | None
    """As if it had been filled alone: its own new vertices come behind the caller's. None: it stays open."""
    left_because: Diagnostic | None
    """Why."""


@dataclass(frozen=True, eq=False)
class FillResult(NewMeshResult):
    """What :func:`fairing.fill` gives back: the new part of the mesh and what :func:`fairing.fair` reports."""

    loops: tuple[IntArray, ...]
    """The loops that were filled, each in the direction that has the new surface on its left."""
    left_open: tuple[IntArray, ...]
    """Loops that stay open: without named ``loops`` those around the outside of a sheet (NOT_A_HOLE), and always those
    that can't be filled while others can."""
    left_because: tuple[Diagnostic, ...] = ()
    """Why, one for each of ``left_open``; ``elements`` are vertices."""
    curves: tuple[IntArray, ...] = ()
    """Hard edges that run on through the holes, and wires: the vertices of each from end to end. New ones among them
    come first in ``vertices`` and are ``fixed``."""
    marked: tuple[bool, ...] = ()
    """Of each curve: whether the hard edges that it continues were ``marked``."""
    bands: tuple[tuple[IntArray, ...], ...] = ()
    """Bevels and rolled edges that run on through the holes: the vertices along the rows of each, from side to side."""
    holes: tuple[Hole, ...] = ()
    """Each hole by itself: its surface and report, or why it stays open."""


@dataclass(frozen=True, eq=False)
class RemeshResult(NewMeshResult):
    """What :func:`fairing.remesh` gives back: a new mesh of a patch and what :func:`fairing.fair` reports."""

    origin: Origin
    """Where each new vertex lies on the old patch: (k,) triangles and (k, 3) barycentric weights at their corners."""
    old: IntArray
    """(k,) the old vertex whose place on the surface a new one has, at an edge that was ``kept``; −1 for the others."""


@dataclass(frozen=True, eq=False)
class FilletResult(NewMeshResult):
    """What :func:`fairing.fillet` gives back: what takes the place of the triangles ``gone``, and what
    :func:`fairing.fair` reports. First of ``triangles`` come the pieces of cut ones, then those of the fillet."""

    gone: IntArray
    """(g,) old triangles that are cut or within the fillet, ascending."""
    outside: int
    """How many of ``triangles`` are pieces outside the fillet, each in the plane of its ``parent``."""
    parent: IntArray
    """(m,) the old triangle that each of ``triangles`` is a piece of, or takes its material from."""
    origin: Origin
    """Where each new vertex lies, or the one it was made from: (k,) old triangles and (k, 3) barycentric weights."""
    seam: IntArray
    """(e, 2) the edges that were rounded."""
    walls: IntArray
    """(w, 2) those that it does not reach over."""
    line: IntArray
    """(l, 2) edges of the line where the fillet ends, the fillet on their left."""


@dataclass(frozen=True, eq=False)
class FromCurvesResult(NewMeshResult):
    """What :func:`fairing.surface_from_curves` gives back: the new mesh and what :func:`fairing.fair` reports."""

    cells: tuple[IntArray, ...]
    """The loops of wires that were filled, each with its surface on the left."""
    cell: IntArray
    """(m,) which of them each triangle fills."""
    left_open: tuple[IntArray, ...]
    """Loops around openings, and around the outside of a sheet."""
    creases: IntArray
    """(c, 2) wires over which the surface may bend: those given, and those around openings that were closed."""


def report_fields(report: FairResult, old_count: int) -> dict[str, Any]:
    """The fields of a report on ``old_count`` old vertices and then new ones; `triangles` is missing."""
    own = {each.name for each in fields(NewMeshResult)}
    values = {each.name: getattr(report, each.name) for each in fields(report) if each.name in own}
    values["cut"] = False
    for name in ("vertices", "mean_curvature"):
        values[name] = read_only(values[name][old_count:])
    return values


def read_only(array: Any) -> Any:
    result = np.ascontiguousarray(array)
    if result is array or result.base is not None:
        result = result.copy()
    result.flags.writeable = False
    return result
