"""From selected edges without faces to the surface over them. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .checked import refuse_negative, refuse_other_kinds
from .engine import Progress
from .faces import Faces, faces_of, paired_faces
from .fill_options import CURVES
from .findings import Origin
from .harmonic import harmonic, nearest
from .option_items import INNER
from .option_shared import LEAST_SPACING
from .option_table import fields_of, read_named
from .reflected import Whole, with_image
from .region import MeshArrays, nothing, to_local
from .sentences import in_mesh_words, sentences
from .words import said

NO_WIRE = said("no_wire")
WIRES_ALONE = said("wires_alone")
NOT_SPANNED = said("not_spanned")
_PLATE = "bilaplacian"  # what stands in where there is no surface of least variation
_FOLDS = ("FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION")


@dataclass(frozen=True)
class CurvesOptions:
    """What the options of `mesh.fair_from_curves` (fill_options.py) come to.

    Raises ValueError for a value it does not know, TypeError for one of another kind.
    """

    fill_openings: bool = False  # what the curves go around gets a surface, too
    spacing: float = 1.0  # of new edges, as a factor of the curves' own
    inner: str = "OUTLINE"  # in proportion to those nearby; EVEN: of one length
    quads: bool = False  # triangles are written in pairs, as far as they can be
    max_vertices: int = 0  # more new ones are refused; 0: twenty times as many as the curves' own edges ask for
    limit_total: int = 0  # vertex groups of bones of a new vertex; 0: as many as one vertex of the curves has

    def __post_init__(self) -> None:
        if self.inner not in INNER:
            raise ValueError(f"inner: expected one of {', '.join(INNER)}, got {self.inner!r}")
        refuse_other_kinds(self)
        if not self.spacing >= LEAST_SPACING:
            raise ValueError(f"spacing: expected {LEAST_SPACING} or more, got {self.spacing!r}")
        for name in ("max_vertices", "limit_total"):
            refuse_negative(self, name)

    @classmethod
    def named(cls, properties: dict[str, Any]) -> CurvesOptions:
        """Read options from a caller's keyword arguments; raises TypeError for one that does not exist."""
        return cls(**read_named(CURVES, properties, "fair_from_curves"))

    @classmethod
    def of(cls, properties: Any) -> CurvesOptions:
        """Read every option from an object that has them as attributes."""
        return cls(**fields_of(CURVES, partial(getattr, properties)))


@dataclass(frozen=True)
class Spanned:
    """A surface over r vertices of curves, with k new ones."""

    outline: Ints  # (r,) mesh vertices
    points: Floats  # (r + k, 3) in world space
    positions: Floats  # (k, 3) of the new ones, in the mesh's own coordinates
    triangles: Ints  # (m, 3) in numbers of `points`, seen from outside in the mesh's own coordinates
    wires: Ints  # (e, 2) likewise
    creases: Ints  # (c, 2) likewise: edges over which it may bend
    cells: int
    left_open: int
    warnings: tuple[str, ...]
    options: CurvesOptions
    whole: Whole | None = None  # the mesh with its image, whose numbers these are

    def for_half(self, whole: Whole) -> Spanned:
        """Return what was found for a whole, to be written to its half."""
        return replace(self, whole=whole)

    @property
    def faces(self) -> Faces:
        """What is written; quads do not reach over curves."""
        if not self.options.quads:
            return faces_of(self.triangles)
        return paired_faces(self.points, self.triangles, self.wires, np.zeros(len(self.triangles), dtype=np.int64))

    def carried(self, values: Floats) -> Floats:
        """Return (k, w): values at the curves' vertices (r, w), carried over the surface."""
        return harmonic(self.points, self.triangles, values)

    @property
    def near(self) -> Ints:
        """Which of the curves' vertices each new one is next to, (k,)."""
        return nearest(self.triangles, len(self.points), len(self.outline))[len(self.outline) :]


def span_arrays(
    mesh: MeshArrays, chosen: Mask, matrix: Floats, options: CurvesOptions, progress: Progress | None = None
) -> Spanned:
    """Span the edges `chosen` (e,), which have no faces; those marked sharp are creases.

    Raises MeshRefusal (its `elements` are mesh vertices), ValueError, fairing.SolverError and fairing.Cancelled.
    """
    touched = np.isin(np.arange(len(mesh.positions)), mesh.edges[chosen])
    whole = with_image(mesh, touched)
    return whole.found(lambda mesh: _spanned(mesh, whole.edges(chosen), matrix, options, progress))


def _spanned(
    mesh: MeshArrays, chosen: Mask, matrix: Floats, options: CurvesOptions, progress: Progress | None
) -> Spanned:
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        points = mesh.transformed(matrix).positions
    wires = mesh.edges[chosen]
    creases = None if mesh.sharp is None else mesh.edges[chosen & mesh.sharp]
    lengths = np.linalg.norm(points[wires[:, 0]] - points[wires[:, 1]], axis=1)
    # A curve that is not finite is refused by the engine.
    spacing = 0.0 if options.spacing == 1.0 else options.spacing * float(np.nan_to_num(lengths).mean())
    origin = Origin(np.arange(len(points)), np.empty((0, 3), dtype=np.int64), nothing())
    with in_mesh_words(origin):
        result = fairing.surface_from_curves(
            points, wires, creases=creases, closed=options.fill_openings, spacing=spacing,
            inner=options.inner.lower(), max_vertices=options.max_vertices, progress=progress,
        )  # fmt: skip
    folds = any(warning.code in _FOLDS for warning in result.warnings)
    if folds or not (result.converged or result.equation == _PLATE):
        raise ValueError(NOT_SPANNED)
    outline = np.unique(result.triangles[result.triangles < len(points)]).astype(np.int64)
    number = np.full(len(points) + len(result.vertices), -1, dtype=np.int64)
    number[outline] = np.arange(len(outline))
    number[len(points) :] = len(outline) + np.arange(len(result.vertices))
    triangles = number[result.triangles]
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        triangles = triangles[:, ::-1]
    return Spanned(
        outline=outline,
        points=np.concatenate([points[outline], result.vertices]),
        positions=to_local(result.vertices, matrix),
        triangles=triangles,
        wires=number[wires],
        creases=number[result.creases],
        cells=len(result.cells),
        left_open=len(result.left_open),
        warnings=sentences(result.warnings, origin),
        options=options,
    )
