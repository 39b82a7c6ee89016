"""From selected edges without faces to the surface over them. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.harmonic import harmonic, nearest
from ..arrays.places import numbers_in
from ..arrays.region import MeshArrays, nothing, to_local
from ..arrays.types import Floats, Ints, Mask
from ..fair.engine import Progress
from ..mirror.reflected import Whole, with_image
from ..options.other_options import CurvesOptions
from ..remesh.faces import Faces, faces_of, paired_faces
from ..verdict.looks import STAND_INS
from ..verdict.verdict import GOOD, LOOK, Verdict
from ..words.findings import Origin
from ..words.sentences import in_mesh_words, sentences
from ..words.words import said

NO_WIRE = said("no_wire")
WIRES_ALONE = said("wires_alone")
NOT_SPANNED = said("not_spanned")
_PLATE = "bilaplacian"  # what stands in where there is no surface of least variation
_FOLDS = ("FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION")


@dataclass(frozen=True)
class Spanned:
    """A surface over r vertices of curves, with k new ones."""

    boundary: Ints  # (r,) mesh vertices
    points: Floats  # (r + k, 3) in world space
    positions: Floats  # (k, 3) of the new ones, in the mesh's own coordinates
    triangles: Ints  # (m, 3) in numbers of `points`, seen from outside in the mesh's own coordinates
    wires: Ints  # (e, 2) likewise
    creases: Ints  # (c, 2) likewise: edges over which it may bend
    cells: int
    left_open: int
    warnings: tuple[str, ...]
    options: CurvesOptions
    verdict: Verdict
    whole: Whole | None = None  # the mesh with its image, whose numbers these are

    def for_half(self, whole: Whole) -> Spanned:
        return replace(self, whole=whole, verdict=whole.about_half(self.verdict))

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
        return nearest(self.triangles, len(self.points), len(self.boundary))[len(self.boundary) :]


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
            inner="outline", progress=progress,
        )  # fmt: skip
    folds = any(warning.code in _FOLDS for warning in result.warnings)
    if folds or not (result.converged or result.equation == _PLATE):
        raise ValueError(NOT_SPANNED)
    boundary = np.unique(result.triangles[result.triangles < len(points)]).astype(np.int64)
    new = len(points) + np.arange(len(result.vertices))
    number = numbers_in(np.concatenate([boundary, new]), len(points) + len(new))
    triangles = number[result.triangles]
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        triangles = triangles[:, ::-1]
    return Spanned(
        boundary=boundary,
        points=np.concatenate([points[boundary], result.vertices]),
        positions=to_local(result.vertices, matrix),
        triangles=triangles,
        wires=number[wires],
        creases=number[result.creases],
        cells=len(result.cells),
        left_open=len(result.left_open),
        warnings=sentences(result.warnings, origin),
        options=options,
        verdict=Verdict(LOOK, STAND_INS[result.equation], boundary) if result.equation in STAND_INS else Verdict(GOOD),
    )
