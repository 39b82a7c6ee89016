"""Results, warnings and errors of the package."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from fairing import _core

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]
Progress = Callable[[float, str], "bool | None"]
CODES: tuple[str, ...] = _core.CODES  # all that a `Diagnostic` may have
FOLDS = ("FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION")  # codes of warnings about the surface itself


@dataclass(frozen=True, eq=False)
class Diagnostic:
    """A warning, or the reason of a :class:`MeshError`.

    ``elements`` are indices into the caller's vertices or triangles, as ``kind`` says; edges are given by
    their two vertices, one after the other. ``message`` is a sentence for readers of English; ``code`` (one of
    :data:`CODES`), ``elements`` and ``figures``, the numbers of the case by name, are for words of your own.
    """

    code: str
    message: str
    elements: IntArray
    kind: Literal["vertex", "triangle"]
    figures: dict[str, float] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.code}: {self.message}"


class MeshError(ValueError):
    """Input that can't be faired. ``code`` and ``elements`` say why and where (see `Diagnostic`)."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(str(diagnostic))
        self.diagnostic = diagnostic

    @property
    def code(self) -> str:
        return self.diagnostic.code

    @property
    def elements(self) -> IntArray:
        return self.diagnostic.elements

    @property
    def kind(self) -> str:
        return self.diagnostic.kind


class SolverError(RuntimeError):
    """The numerics broke down; nothing was changed."""


class Cancelled(RuntimeError):
    """The progress callback returned False; nothing was changed."""


@dataclass(frozen=True, eq=False)
class Solved:
    """What all calls that make surfaces tell of them. All arrays are read-only.

    D is twice the largest distance of a component's fixed vertices from their centroid; where there are
    several components, the worst of each figure is given.
    """

    equation: str
    """The equation that holds and that ``converged`` refers to: the one asked for, or what any component has instead
    (``otherwise``, NO_SOLUTION): "least_variation"; or, without an equation and with no ``residual`` to speak of,
    "loft", "smoothed" (its own shape), "bilaplacian"."""
    provenance: str
    """Where the surface comes from: "equation"; "low_passed", the same between boundary loops without their short
    waves; or what stands in (NO_SOLUTION): "least_variation", "loft", "least_bent", "swept_tube", "old_shape" or
    "first_surface". Of several components the last in this order."""
    vertices: FloatArray
    """(n, 3) positions of all vertices; those that are neither free nor in ``moved`` keep their bits. Of a new mesh:
    (k, 3) the new vertices alone."""
    fixed: IntArray
    """(k',) all fixed vertices: those given, in their order, then the other border vertices."""
    mean_curvature: FloatArray
    """(n,) or (k,) H at these vertices, in length⁻¹: −1/R on a sphere of radius R with outward normals (eq. 8)."""
    boundary_angle: FloatArray
    """(k',) degrees between prescribed and obtained normals, in the order of ``fixed``."""
    join: FloatArray
    """(k',) degrees, in the order of ``fixed``: how visible the join is (:func:`fairing.looks.visible_join`). Where no
    triangles outside were given, they are taken for the patch's mirror image across the prescribed tangent planes."""
    girth: tuple[float, float] | None
    """How thin and how thick the surface is between ends of tubes (:func:`fairing.looks.girth`). About (1, 1) for tubes
    and cones, less for waists, more for balloons. None where no component has two loops or more, or one is no end."""
    continuity: Literal["G1", "G2"]
    """"G2": the surface continues the curvature of its surroundings, wherever that is known (G2_NOT_MET names the other
    vertices). "G1": only their slopes, because no more was asked for or because G2_NOT_MET says why."""
    converged: bool
    """Whether every component has its surface: the equation is solved to the tolerance, and the vertices lie on the
    solution without folds. Where not, the best positions found are given."""
    polished: bool
    """Whether the discrete equation holds on this connectivity. False, with ``converged``: it was solved on another
    mesh, and the vertices were placed on that surface; it is as fair, but ``residual`` may be large."""
    termination: Literal["converged", "iteration_limit", "stalled", "folded"]
    """"folded": the surface was found, but the vertices could not be placed on it without triangles that are turned
    over or pass through others."""
    iterations: int
    """Steps of the iteration that led to the result (of the component with most), not of all that was tried."""
    residual: float
    """Largest |Δ_B H| D³ at a free vertex (|H| D for "soap_film"; for "least_variation" the largest derivative of its
    energy by a height, times D). Without a unit, but larger on finer meshes: compare it with ``initial_residual``."""
    initial_residual: float
    """The same for the initial surface."""
    levels: tuple[int, ...]
    """Vertex counts of the levels, coarse to fine."""
    seconds: dict[str, float]
    """Wall-clock time of each stage and in ``"total"``. Stages need not add up to it: attempts that were given up are
    not listed."""
    way: tuple[tuple[str, float], ...]
    """Name and seconds of each strategy that was tried, component by component. The last one led to the result, unless
    none was accepted. "warm" begins at the last answer, "near" at the vertices given, "levels" goes from coarse to
    fine, "direct" stays on the mesh given, "proxy mesh" takes one of the engine's own, "low-passed" does so over the
    low-passed boundary; the others are the weights, surfaces and the method of that name."""
    warnings: tuple[Diagnostic, ...]


@dataclass(frozen=True, eq=False)
class FairResult(Solved):
    """What :func:`fairing.fair` gives back."""

    base: FloatArray
    """(n, 3) the fair surface alone: ``vertices`` without their ``detail``, which is linear in that option. All figures
    are about this surface."""
    moved: IntArray = field(default_factory=lambda: np.empty(0, np.int32))
    """Fixed and outside vertices that ``outline="mended"``, ``feather`` or ``weights`` have moved, ascending."""


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
class NewMeshResult(Solved):
    """What a fairing on a new mesh gives back. Warnings name triangles and vertices of the mesh that was solved."""

    triangles: IntArray
    """(m, 3) the new triangles: indices below n are the caller's vertices, n … n + k − 1 the new ones, as in
    ``np.concatenate([vertices, result.vertices])``. They are wound as the triangles around."""
    cut: bool
    """Whether nothing was solved for this mesh: it was cut from the surface of another one, a finer new one
    (:func:`fairing.fill`) or the old one (:func:`fairing.remesh`)."""
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


@dataclass(frozen=True, eq=False)
class EdgesThrough:
    """What :func:`fairing.fair_edges` makes fair. All arrays are read-only."""

    edges: IntArray
    """(e, 2) edges of the patch, the smaller index first, ascending."""
    onward: IntArray
    """(o, 2) hard edges outside and along its boundary."""


@dataclass(frozen=True, eq=False)
class FairEdges:
    """Edges as fair curves. All arrays are read-only."""

    vertices: FloatArray
    """(n, 3) all vertices; those that are not in ``moved`` keep their bits."""
    moved: IntArray
    """(k,) ascending."""
    curves: tuple[IntArray, ...]
    """The vertices of each chain that is fair now, from end to end."""


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
