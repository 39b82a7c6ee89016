"""Results, warnings and errors of the package."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import numpy.typing as npt

from fairing import _core

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]
CODES: tuple[str, ...] = _core.CODES  # all that a `Diagnostic` may have
FOLDS = ("FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION")  # codes of warnings about the surface itself


@dataclass(frozen=True, eq=False)
class Diagnostic:
    """A warning, or the reason of a :class:`MeshError`.

    ``elements`` are indices into the caller's vertices or triangles, as ``kind`` says; edges are given by
    their two vertices, one after the other. ``message`` is a sentence for readers of English; ``code`` (one of
    :data:`fairing.CODES`), ``elements`` and ``figures``, the numbers of the case by name, are for words of your own.
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
class FairResult:
    """What :func:`fairing.fair` gives back. All arrays are read-only.

    D is twice the largest distance of a component's fixed vertices from their centroid; where there are
    several components, the worst of each figure is given.
    """

    equation: str
    """The equation that holds: the one asked for, or "least_variation" where any component has it instead, or "loft"
    where any is a loft, "smoothed" where any is its own shape, smoothed, or "bilaplacian" where any has nothing better
    (see ``otherwise`` of :func:`fairing.fair`; the warning NO_SOLUTION names the component). ``converged`` refers to
    it. The last three solve no equation: ``residual`` says nothing about them."""
    provenance: str
    """Where the surface comes from: "equation"; "low_passed", the same between boundary loops without their short
    waves, beside which the real ones lie; or what stands in for a surface that the equation does not have:
    "least_variation", "loft", "least_bent", "swept_tube", "old_shape" or "first_surface". Of several components
    the last in this order. All but the first come with the warning NO_SOLUTION."""
    vertices: FloatArray
    """(n, 3) positions; vertices that are neither free nor in ``moved`` keep their bits."""
    base: FloatArray
    """(n, 3) the fair surface alone: ``vertices`` without their ``detail``, which is linear in that option. All figures
    are about this surface."""
    fixed: IntArray
    """(k',) all fixed vertices: those given, in their order, then the other border vertices."""
    mean_curvature: FloatArray
    """(n,) H, in length⁻¹: −1/R on a sphere of radius R with outward normals (eq. 8)."""
    boundary_angle: FloatArray
    """(k',) degrees between prescribed and obtained normals, in the order of ``fixed``."""
    join: FloatArray
    """(k',) degrees, in the order of ``fixed``: how visible the join is (see :func:`fairing.visible_join`). Where no
    triangles outside were given, they are taken for the patch's mirror image across the prescribed tangent planes."""
    girth: tuple[float, float] | None
    """How thin and how thick the surface is between boundary loops that are ends of tubes: the radius of the thinnest
    cross-section over that of the thinner end, and of the thickest over the thicker end's, by the areas within. About
    (1, 1) for tubes and cones, less for waists, more for balloons. None where no component has two loops or more, or
    one of them is no tube's end."""
    continuity: Literal["G1", "G2"]
    """"G2": the surface continues the curvature of its surroundings, wherever that is known (G2_NOT_MET names the other
    vertices). "G1": only their slopes, because no more was asked for or because G2_NOT_MET says why."""
    converged: bool
    """Whether every component has its surface: the equation is solved to the tolerance, and the vertices lie on the
    solution without folds. Where not, the best positions found are given."""
    polished: bool
    """Whether the discrete equation holds on the connectivity given. False, with ``converged``: it was solved on a mesh
    of the engine's own, and the vertices were placed on that surface; it is as fair, but ``residual`` may be large."""
    termination: Literal["converged", "iteration_limit", "stalled", "folded"]
    """"folded": the surface was found, but the vertices could not be placed on it without triangles that are turned
    over or pass through others."""
    iterations: int
    """Steps of the iteration that led to the result (of the component with most), not of all that was tried."""
    residual: float
    """Largest |Δ_B H| D³ at a free vertex (|H| D for ``equation="soap_film"``; for "least_variation" the
    largest derivative of its energy by a height, times D). It has no unit, but grows
    with finer meshes of the same surface: compare it with ``initial_residual``, and judge by ``converged``."""
    initial_residual: float
    """The same for the initial surface."""
    levels: tuple[int, ...]
    """Vertex counts of the levels, coarse to fine."""
    seconds: dict[str, float]
    """Wall-clock time of each stage and in ``"total"``. Stages need not add up to it: attempts that were given up are
    not listed."""
    way: tuple[tuple[str, float], ...]
    """Name and seconds of each strategy that was tried, in order. The last one led to the result, unless none was
    accepted. "warm" begins at the last answer, "near" at the vertices given, "levels" goes from coarse to fine,
    "direct" stays on the mesh given, "own mesh" takes one of the engine's own, "low-passed" does so over the
    low-passed boundary, "uniform weights" stays with uniform ones, "lifted pins" begins without the pins. "least
    variation", "old shape", "loft", "first surface" and "paper" are the surfaces and the method of that name. Several
    components follow each other."""
    warnings: tuple[Diagnostic, ...]
    moved: IntArray = field(default_factory=lambda: np.empty(0, np.int32))
    """Fixed and outside vertices that ``outline="mended"``, ``feather`` or ``weights`` have moved, ascending."""
