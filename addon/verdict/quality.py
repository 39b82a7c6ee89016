"""What is measured on a patch before and after: faces folded over, needles, faces that run through others, the join.

What is folded and what crosses is the engine's decision.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import fairing

from ..arrays.places import area_vectors
from ..arrays.region import MeshArrays, Patch, nothing
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem

LARGE = 50_000  # triangles


@dataclass(frozen=True)
class Quality:
    """Bad faces, as ascending numbers of the mesh's faces."""

    folded: Ints
    needles: Ints
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


def compare(patch: Patch, points: tuple[Floats, Floats], clear: bool) -> tuple[Quality, Quality]:
    """Measure the patch at the positions (p, 3) before and after, all finite.

    clear: known not to run into itself afterwards. In a large patch that doesn't, whether it did before stays open: to
    look takes as long as a tenth of the solve.
    """
    before, after = points
    found = np.empty(0, dtype=np.int64) if clear else crossing(patch, after)
    result = _measured(patch, after, found)
    look = len(patch.triangles) <= LARGE or bool(len(found))
    return _measured(patch, before, crossing(patch, before) if look else None), result


def measure(patch: Patch, points: Floats) -> Quality:
    """Measure one state of a patch, points (p, 3); crossings of a large one are not looked for."""
    look = len(patch.triangles) <= LARGE
    return _measured(patch, points, crossing(patch, points) if look else None)


def mean_area(points: Floats, triangles: Ints) -> float:
    """Return the mean area of some triangles."""
    return 0.5 * float(np.linalg.norm(area_vectors(points, triangles), axis=1).mean())


def _measured(patch: Patch, points: Floats, crossing: Ints | None) -> Quality:
    needles: Ints = np.unique(patch.faces[fairing.looks.needles(points, patch.triangles).all])
    return Quality(folded(patch, points), needles, crossing)


def folded(patch: Patch, points: Floats) -> Ints:
    """Return the faces that are turned over, those aside that have no vertex free to move."""
    found = fairing.looks.flipped_triangles(points, patch.triangles, fixed=patch.fixed).astype(np.int64)
    movable = np.isin(patch.triangles[found], patch.free).any(axis=1)
    faces: Ints = np.unique(patch.faces[found[movable]])
    return faces


def crossing(patch: Patch, points: Floats) -> Ints:
    """Return the faces that pass through others of the patch."""
    faces: Ints = np.unique(patch.faces[fairing.self_intersections(points, patch.triangles)])
    return faces


def join(problem: Problem, points: Floats) -> Join:
    """Measure the join of the patch with the faces around it at the positions (q, 3) of problem.vertices.

    Where the slope is that of the selected faces the boundary stays a hard edge, and where the surface finds its own it
    may have one: neither is a kink.
    """
    patch = problem.patch
    rim = np.intersect1d(patch.outline, problem.outside)
    rim = np.setdiff1d(rim[~np.isin(patch.vertices[rim], problem.inward)], patch.free_slopes)
    return join_at(patch.vertices[rim], fairing.looks.visible_join(points, patch.triangles, problem.outside, rim))


def join_at(vertices: Ints, found: fairing.looks.VisibleJoin) -> Join:
    """Return the engine's figures at these mesh vertices (k,)."""
    order = np.argsort(-found.degrees[found.seen], kind="stable")
    return Join(vertices, found.degrees, found.seen[order].astype(np.int64), found.limit)


def swollen(before: tuple[Patch, Floats], after: tuple[Patch, Floats]) -> Ints:
    """Return the mesh vertices at the tops of knobs that a patch has after, compared with those before.

    Each with its positions (p, 3).
    """
    patch, points = after
    _, found = _knobs(patch, points)
    if len(found):  # else what was there before, which only makes them fewer, need not be measured
        _, found = _knobs(patch, points, _knobs(*before)[0])
    tops: Ints = patch.vertices[found]
    return tops


def _knobs(patch: Patch, points: Floats, before: float = 0.0) -> tuple[float, Ints]:
    extent, tops = fairing.looks.knobs(points, patch.triangles, fixed=patch.fixed, before=before)
    return extent, tops.astype(np.int64)


def is_spoilt(mesh: MeshArrays) -> bool:
    """Return whether the patch's own shape is no texture to keep: it has a spike, or all of it is crumpled."""
    inside = mesh.in_patch[mesh.triangle_faces]
    with np.errstate(invalid="ignore"):
        return fairing.looks.is_spoilt(mesh.positions, mesh.triangles[inside], mesh.triangles[~inside])


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
