"""What is measured on a patch before and after: faces folded over, needles, faces that run through others, the join.

What is folded and what crosses is the engine's decision.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .bends import bends
from .engine import Problem
from .groups import groups
from .region import Patch
from .vectors import area_vectors

LARGE = 50_000  # triangles
VISIBLE = fairing.VISIBLE_KINK  # degrees of Join from which the eye finds a kink among faces that bend as most do
FINE = 5.0  # and from which it finds one among faces that hardly bend
COARSE = 30.0  # and from which it finds one whatever the faces around bend
LONG = 5.0  # times these degrees: what neighbouring vertices of a kink add up to at least. A short one must be steep
FLATTEST = 1e-3  # height over longest side, below which a triangle is a needle


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
    degrees: Floats  # (k,) by how much the bend there exceeds what is usual around; see fairing.visible_join
    limit: float = VISIBLE  # degrees from which it is seen
    edges: Ints | None = None  # (e, 2) of the boundary, places in `vertices`; None: not known

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
        return float(self.degrees[self._is_seen()].max(initial=0.0))

    @property
    def seen(self) -> Ints:
        """The mesh vertices where it is more visible than the limit, the worst first."""
        order = np.argsort(-self.degrees, kind="stable")
        found: Ints = self.vertices[order[self._is_seen()[order]]]
        return found

    def _is_seen(self) -> Mask:
        """Return where it is above the limit, along so many neighbours that these add up."""
        above = self.degrees > self.limit
        if self.edges is None:
            return above
        seen = np.zeros(len(above), dtype=bool)
        for run in groups(len(above), self.edges[above[self.edges].all(axis=1)].tolist()):
            seen[run] = above[run].all() and self.degrees[run].sum() >= LONG * self.limit
        return seen


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
    return Quality(folded(patch, points), np.unique(patch.faces[degenerate(points, patch.triangles)]), crossing)


def folded(patch: Patch, points: Floats) -> Ints:
    """Return the faces that are turned over, those aside that have no vertex free to move."""
    found = fairing.flipped_triangles(points, patch.triangles, fixed=patch.fixed).astype(np.int64)
    movable = np.isin(patch.triangles[found], patch.free).any(axis=1)
    faces: Ints = np.unique(patch.faces[found[movable]])
    return faces


def crossing(patch: Patch, points: Floats) -> Ints:
    """Return the faces that pass through others of the patch."""
    faces: Ints = np.unique(patch.faces[fairing.self_intersections(points, patch.triangles)])
    return faces


def degenerate(positions: Floats, triangles: Ints) -> Mask:
    """Return the (m,) mask of triangles whose height is below FLATTEST times their longest side."""
    a, b, c = (positions[column] for column in triangles.T)
    longest_squared = np.max([((end - start) ** 2).sum(axis=1) for start, end in ((a, b), (b, c), (c, a))], axis=0)
    doubled = np.linalg.norm(area_vectors(positions, triangles), axis=1)
    flat: Mask = ~(doubled > FLATTEST * longest_squared)
    return flat


def join(problem: Problem, points: Floats) -> Join:
    """Measure the join of the patch with the faces around it at the positions (q, 3) of problem.vertices."""
    patch = problem.patch
    rim = np.intersect1d(patch.outline, problem.outside)
    degrees = fairing.visible_join(points, patch.triangles, problem.outside, rim)
    limit = visible_from(points, problem.outside)
    return Join(patch.vertices[rim], degrees, limit, np.searchsorted(rim, _outline_edges(patch, rim)))


def _outline_edges(patch: Patch, rim: Ints) -> Ints:
    """Return the edges (e, 2) at the patch's border between vertices of the rim."""
    edges, uses = fairing.edges_with_uses(patch.triangles)
    found: Ints = edges[(uses == 1) & np.isin(edges, rim).all(axis=1)]
    return found


def visible_from(points: Floats, triangles: Ints) -> float:
    """Return the degrees from which a kink stands out among triangles that bend as these do.

    Nine tenths of their edges bend within some range. Where it is narrow, what exceeds it is seen; of a wide one half
    is enough: coarse cages bend at every edge. Without any triangles nothing is known.
    """
    if not len(triangles):
        return VISIBLE
    degrees = bends(points, triangles).degrees
    low, high = np.percentile(degrees, [5.0, 95.0]) if len(degrees) else (0.0, 0.0)
    return float(np.clip(max(min(high - low, VISIBLE), 0.5 * (high - low)), FINE, COARSE))


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
