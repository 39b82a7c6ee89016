"""What the engine sees of a new surface in its mesh, in one call, by the mesh's faces and vertices. Plain numpy."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import fairing

from ..arrays.places import area_vectors
from ..arrays.region import MeshArrays, Patch, nothing
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem, Progress


@dataclass(frozen=True)
class Quality:
    """Bad faces, as ascending numbers of the mesh's faces."""

    folded: Ints
    crossing: Ints | None  # None: not looked for


@dataclass(frozen=True)
class Join:
    """How visible the join is at the k boundary vertices that have faces outside."""

    vertices: Ints  # (k,) of the mesh
    degrees: Floats  # (k,) by how much the bend there exceeds what is usual around; see fairing.looks.visible_join
    kinks: Ints = field(default_factory=nothing)  # places in `vertices` where the eye finds one, the worst first
    limit: float = fairing.looks.LIMITS["visible_kink"]  # degrees from which it does

    @property
    def typical(self) -> float:
        """The median, degrees; 0 without any vertices."""
        return float(np.median(self.degrees)) if len(self.degrees) else 0.0

    @property
    def worst(self) -> float:
        """The largest, degrees; 0 without any vertices."""
        return float(self.degrees.max(initial=0.0))

    @property
    def worst_seen(self) -> float:
        """The largest of those that are seen, degrees; 0 where none is."""
        return float(self.degrees[self.kinks].max(initial=0.0))

    @property
    def seen(self) -> Ints:
        """The mesh vertices where the eye finds a kink, the worst first."""
        found: Ints = self.vertices[self.kinks]
        return found


@dataclass(frozen=True)
class Measured:
    """All of it; mesh vertices, ascending."""

    before: Quality
    after: Quality
    join: Join
    pierced: Ints = field(default_factory=nothing)  # where the surface passes through faces outside, and did not before
    rounded: Ints = field(default_factory=nothing)  # outside, at hard edges that moved vertices have rounded
    running_on: Ints = field(default_factory=nothing)  # inside, at hard edges that lead out and are no more
    marked: Ints = field(default_factory=nothing)  # at edges marked sharp, though not pinned, that are no more
    seams: Ints = field(default_factory=nothing)  # of held seams of doubled vertices that show as crests


@dataclass(frozen=True)
class Sheet:
    """The mesh with a new surface: where the vertices of a patch are in it."""

    points: Floats  # (n + k, 3) in world space, the mesh's own first
    numbers: Ints  # (p,) of the patch's vertices
    nearest: Ints  # (n + k,) mesh vertices: themselves, or old ones next to new ones


def places(mesh: MeshArrays, matrix: Floats) -> Floats:
    """Return the mesh's (n, 3) positions in the space that the 4×4 `matrix` leads to."""
    with np.errstate(invalid="ignore", over="ignore"):
        found: Floats = mesh.positions @ matrix[:3, :3].T + matrix[:3, 3]
    return found


def moved_sheet(before: Floats, problem: Problem, after: Floats) -> Sheet:
    """Return the mesh with positions (n, 3) whose vertices problem.vertices are at (q, 3) now."""
    points = before.copy()
    points[problem.vertices] = after
    return Sheet(points, problem.patch.vertices, np.arange(len(points)))


def measured(
    mesh: MeshArrays,
    before: tuple[Floats, Patch],
    after: tuple[Sheet, Problem],
    *,
    moved: Ints | None = None,
    is_clear: bool = False,
    progress: Progress | None = None,
) -> Measured:
    """Measure a surface among the faces of the mesh that are no part of it, and compare it with what was there.

    Where the slope is that of the selected faces the boundary stays a hard edge, and where the surface finds its own it
    may have one: neither is a kink. moved: mesh vertices whose edges are compared; None: the faces are others.
    is_clear: known not to run into itself. Raises fairing.Cancelled.
    """
    (was, old), (sheet, problem) = before, after
    patch = problem.patch
    rim = np.intersect1d(patch.boundary, problem.outside)
    rim = np.setdiff1d(rim[~np.isin(patch.vertices[rim], problem.inward)], patch.free_slopes)
    found = fairing.looks.judged(
        sheet.points, sheet.numbers[patch.triangles], mesh.triangles[~mesh.in_patch[mesh.triangle_faces]],
        held=sheet.numbers[patch.fixed], rim=sheet.numbers[rim], before=was, old=old.vertices[old.triangles],
        moved=() if moved is None else np.sort(moved), marked=None if mesh.sharp is None else mesh.edges[mesh.sharp],
        is_clear=is_clear, progress=None if progress is None else lambda _, stage: progress(1.0, stage),
    )  # fmt: skip
    assert found.before is not None
    own = np.zeros(len(sheet.points), dtype=bool)
    own[sheet.numbers[patch.free]] = True
    return Measured(
        before=_quality(old, found.before),
        after=_quality(patch, found.now),
        join=join_at(patch.vertices[rim], found.join),
        pierced=np.unique(patch.vertices[patch.triangles[found.pierced]]),
        rounded=sheet.nearest[found.rounded[~own[found.rounded]]],
        running_on=sheet.nearest[found.rounded[own[found.rounded]]],
        marked=sheet.nearest[found.blunt],
        seams=sheet.nearest[found.seams],
    )


def _quality(patch: Patch, faults: fairing.looks.Faults) -> Quality:
    return Quality(np.unique(patch.faces[faults.folded]), np.unique(patch.faces[faults.crossing]))


def join_at(vertices: Ints, found: fairing.looks.VisibleJoin) -> Join:
    """Return the engine's figures at these mesh vertices (k,)."""
    order = np.argsort(-found.degrees[found.seen], kind="stable")
    return Join(vertices, found.degrees, found.seen[order].astype(np.int64), found.limit)


def mean_area(points: Floats, triangles: Ints) -> float:
    """Return the mean area of some triangles."""
    return 0.5 * float(np.linalg.norm(area_vectors(points, triangles), axis=1).mean())


def texture_distortion(before: Floats, after: Floats, triangles: Ints) -> float:
    """Return the area-weighted mean of conformal distortion − 1; 0 where all angles are kept.

    Weighted by the areas after: what shrinks to nothing, such as a removed limb, is seen no more. Triangles without
    area on either side are left out.
    """
    distortion = fairing.conformal_distortion(before, after, triangles)
    areas = np.linalg.norm(area_vectors(after, triangles), axis=1)
    usable = np.isfinite(distortion) & (areas > 0.0)
    if not usable.any():
        return 0.0
    return float(np.average(distortion[usable] - 1.0, weights=areas[usable]))
