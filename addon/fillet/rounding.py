"""From selected seams to the fillets in their place. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

import fairing

from ..arrays.boundary import two_sided_edges
from ..arrays.places import edge_keys
from ..arrays.region import MeshArrays, nothing, to_local
from ..arrays.types import Floats, Ints, Mask
from ..fair.engine import Progress
from ..mirror.reflected import Whole, with_image
from ..options.other_options import FilletOptions
from ..remesh.faces import Faces
from ..remesh.new_part import NewPart
from ..verdict.verdict import GOOD, LOOK, UNUSABLE, Verdict
from ..words.findings import Origin, found
from ..words.sentences import in_mesh_words, sentences
from ..words.words import said
from .rounded_part import rounded_part

LEAST_WEIGHT = 0.01  # of a vertex group: a fillet needs a width
FOLDS = ("FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION")
NO_SEAM = said("no_seam")


@dataclass(frozen=True)
class Rounded:
    """What takes the place of the faces at some seams."""

    part: NewPart
    new_positions: Floats  # (k, 3) of the new vertices, in the mesh's own coordinates
    points: Floats  # (n + k, 3) of old and new vertices, in world space
    result: fairing.results.FilletResult
    verdict: Verdict
    polygons: Faces
    unselected: int  # faces at the beginning that are pieces of old ones, outside
    warnings: tuple[str, ...] = ()
    vertices: Ints = field(default_factory=nothing)  # old ones that move: none
    positions: Floats = field(default_factory=lambda: np.empty((0, 3)))
    whole: Whole | None = None  # the mesh with its image, whose numbers these are but for the verdict's

    def for_half(self, whole: Whole) -> Rounded:
        """Return what was found for a whole, to be written to its half."""
        return replace(self, whole=whole, verdict=whole.about_half(self.verdict))

    @property
    def surface(self) -> tuple[Floats, Ints]:
        """Positions (k, 3) in world space and triangles (m, 3) of the new faces, for a preview."""
        triangles = self.result.triangles[self.result.outside :]
        used, numbered = np.unique(triangles, return_inverse=True)
        return self.points[used], numbered.reshape(-1, 3)

    def faces(self, _kinds: Ints) -> Faces:
        """Return what is written."""
        return self.polygons


def seams_of(mesh: MeshArrays, edges: Mask, by_edges: bool) -> Mask:
    """Return the (e,) mask of the seams that a selection names.

    Those of its edges that are on no selected face; and where faces are selected, hard edges between two of them.
    edges: (e,) selected ones. by_edges: whether edges were selected, not faces: all edges of a face select that, too,
    and are seams where they are hard.
    """
    of_faces = np.zeros(len(mesh.edges), dtype=bool)
    of_faces[mesh.corner_edges[mesh.in_patch[mesh.corner_faces]]] = True
    seams = edges & ~of_faces
    if not mesh.in_patch.any():
        return seams
    sides = two_sided_edges(mesh, np.ones(len(mesh.edges), dtype=bool))
    chosen = mesh.in_patch[sides.faces].sum(axis=1)
    within = np.zeros(len(mesh.edges), dtype=bool)
    within[sides.edges] = (chosen == 2) | (by_edges & (chosen == 1) & edges[sides.edges])
    return seams | (within & hard(mesh))


def hard(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of hard edges: by the mesh's shape, or marked sharp."""
    marked = None if mesh.sharp is None else mesh.edges[mesh.sharp]
    found = fairing.hard_edges(mesh.positions, mesh.triangles, marked=marked)
    return np.isin(edge_keys(mesh.edges), edge_keys(found))


def round_arrays(
    mesh: MeshArrays,
    seams: Mask,
    matrix: Floats,
    options: FilletOptions,
    progress: Progress | None = None,
) -> Rounded:
    """Round the seams in the (e,) mask, in the space that the 4×4 `matrix` leads to; `mesh` is never changed.

    Raises MeshRefusal, ValueError, fairing.SolverError and fairing.Cancelled.
    """
    if not seams.any():
        raise ValueError(NO_SEAM)
    touched = np.isin(np.arange(len(mesh.positions)), mesh.edges[seams])
    whole = with_image(mesh, touched)
    return whole.found(lambda mesh: _rounded(mesh, whole.edges(seams), matrix, options, progress))


def _rounded(
    mesh: MeshArrays, seams: Mask, matrix: Floats, options: FilletOptions, progress: Progress | None
) -> Rounded:
    world = mesh.transformed(matrix)
    count = len(world.positions)
    factors = np.ones(count) if mesh.parts is None else np.maximum(mesh.parts, LEAST_WEIGHT)
    seam, walls = world.edges[seams], world.edges[hard(world) & ~seams]
    as_given = Origin(np.arange(count), world.triangles, world.triangle_faces)
    with in_mesh_words(as_given):
        first = options.width or fairing.fillet_width(world.positions, world.triangles, seam, walls=walls)
        second = options.width_2 or first
        result = fairing.fillet(
            world.positions, world.triangles, seam,
            fairing.Options(fairing.Surface(continuity=options.continuity)),
            width=first * factors, width_2=None if second == first else second * factors,
            clamp=options.clamp, walls=walls, profile=options.profile, spacing=options.spacing,
            faces="quads" if options.quads else "triangles", neighbours=world.edges,
            progress=progress,
        )  # fmt: skip
    near = world.triangles[result.origin[0]][np.arange(len(result.vertices)), result.origin[1].argmax(axis=1)]
    origin = Origin(
        np.concatenate([np.arange(count), near]), result.triangles.astype(np.int64), world.triangle_faces[result.parent]
    )
    made = rounded_part(world, result)
    return Rounded(
        part=made.part,
        new_positions=to_local(result.vertices, matrix),
        points=np.concatenate([world.positions, result.vertices]),
        result=result,
        verdict=_verdict(result, origin),
        polygons=made.polygons,
        unselected=made.outside,
        warnings=sentences(result.warnings, origin),
    )


def _verdict(result: fairing.results.FilletResult, origin: Origin) -> Verdict:
    """Folds and what is no surface are not written; a stand-in is worth a look."""
    bad = [warning for warning in result.warnings if warning.code in FOLDS]
    if bad or not result.converged:
        spots = np.unique(np.concatenate([np.empty(0, np.int64), *(found(each, origin).vertices for each in bad)]))
        return Verdict(UNUSABLE, said("fillet_folds"), spots)
    if result.provenance != "equation":
        return Verdict(LOOK, sentences(result.warnings, origin)[0] if result.warnings else "")
    return Verdict(GOOD)
