"""Where the free vertices go, and what that is worth."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np

import fairing

from ..arrays.around import MovedKey, nearby, numbered, wide_outside, wound_alike
from ..arrays.region import MeshArrays, Patch, nothing, to_local
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem, Progress, go_on, islands
from ..fair.solve import Solved
from ..mirror.symmetry import mirror_map, symmetrised, with_band
from ..options.options import FairOptions
from ..selection.selection import left_out, tunnel_hint
from ..words.words import said
from . import quality
from .eaten import Eaten, eaten_edges
from .evidence import Evidence, Flank
from .lost import Lost, is_smoother, kept_key, moved_border, sunken
from .piercing import Sheet, pierced, places
from .quality import Join, Quality
from .verdict import GOOD, LOOK, Verdict, because_of, judge


class Moves(Protocol):
    """What is written to a mesh whose vertices stay the same: new positions, in the mesh's own coordinates."""

    @property
    def vertices(self) -> Ints:
        """(k,) mesh indices, ascending."""

    @property
    def positions(self) -> Floats:
        """(k, 3)."""

    @property
    def keys(self) -> tuple[MovedKey, ...]:
        """Shape keys that move as well."""


@dataclass(frozen=True)
class Fairing:
    """New positions for the vertices that move, in the mesh's own coordinates, and what they are worth."""

    vertices: Ints  # (k,) mesh indices, ascending
    positions: Floats  # (k, 3)
    result: fairing.FairResult | fairing.RemeshResult  # for the patch, in world space
    warnings: tuple[str, ...]
    before: Quality
    after: Quality
    distortion: float  # area-weighted mean of the conformal distortion − 1
    curvature: tuple[float, float]  # largest |H| inside and on the boundary, in 1/length
    join: Join
    verdict: Verdict
    free_count: int  # of the patch; `vertices` beyond it belong to a fitted boundary or a band
    keys: tuple[MovedKey, ...] = field(default=(), kw_only=True)  # that were faired as well


def outcome(
    mesh: MeshArrays, matrix: Floats, options: FairOptions, solved: Solved, progress: Progress | None = None
) -> Fairing:
    """Blend the answer with the mesh that it is for, measure both, and judge: as long as the solution takes.

    Raises fairing.SolverError where the answer is not finite in the mesh's own coordinates, and fairing.Cancelled.
    """
    problem, result = solved.problem, solved.result
    patch, before = problem.patch, problem.points
    moving = np.unique(np.concatenate([patch.free, result.moved, problem.curve])).astype(np.int64)
    if problem.weights is not None:
        moving = moving[problem.weights[moving] > 0.0]  # the others keep their bits
    positions, warnings = _positions(mesh, matrix, options.factor, solved, moving)
    after = before.copy()
    after[moving] = positions @ matrix[:3, :3].T + matrix[:3, 3]
    own = len(patch.vertices)
    as_solved = options.factor == 1.0 and not options.takes_base
    clear = as_solved and not mesh.mirror_x and _is_clear(patch, result)
    go_on(progress)
    quality_before, quality_after = quality.compare(patch, (before[:own], after[:own]), clear)
    join = quality.join(problem, after)
    go_on(progress)
    swollen = quality.swollen((patch, before[:own]), (patch, after[:own]))
    moves_outside = len(np.setdiff1d(moving, patch.free)) > 0 and (options.smooth_boundary or options.moves_band)
    rounded = _rounded(mesh, matrix, problem, after, moving) if moves_outside else nothing()
    odd = rounded, swollen, _eaten(mesh, problem, after)
    go_on(progress)
    through = _pierced(mesh, matrix, problem, after)
    held = np.intersect1d(patch.fixed, patch.outline)
    seams = patch.vertices[fairing.looks.seam_kinks(after[:own], patch.triangles, held, join.limit)]
    go_on(progress)
    evidence = Evidence(
        problem, result, solved.failures, quality_before, quality_after, join, *odd, pierced=through, points=after,
        flank=flank_of(mesh, matrix, problem, after), left_out=left_out(mesh), seams=seams,
        lost=_lost(mesh, matrix, problem, after),
    )  # fmt: skip
    go_on(progress)
    verdict = judge(evidence, options.resolved(mesh.textured))
    tunnels = () if verdict.grade == GOOD else tunnel_hint(patch)
    verdict = because_of(verdict, tunnels)
    order = np.argsort(problem.vertices[moving])
    return Fairing(
        vertices=problem.vertices[moving][order],
        positions=positions[order],
        result=leading_part(result, own),
        warnings=solved.warnings + warnings + (tunnels if verdict.grade == LOOK else ()),
        before=quality_before,
        after=quality_after,
        distortion=quality.texture_distortion(before, after, patch.triangles),
        curvature=_largest_curvatures(patch, result),
        join=join,
        verdict=verdict,
        free_count=len(patch.free),
    )


def _pierced(mesh: MeshArrays, matrix: Floats, problem: Problem, after: Floats) -> Ints:
    """Return the mesh vertices of the patch's triangles that pass through unselected faces, and did not before."""
    own = problem.patch.vertices[problem.patch.triangles]
    before = places(mesh, matrix)
    moved = before.copy()
    moved[problem.vertices] = after
    return pierced(mesh, Sheet(before, own), Sheet(moved, own))


def flank_of(mesh: MeshArrays, matrix: Floats, problem: Problem, after: Floats) -> Flank | None:
    """Find a boundary on the slope of a bump or a dent; a hard edge is none."""
    patch = problem.patch
    if len(problem.inward):
        return None
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite outside the patch
        world = mesh.transformed(matrix)
    vertices, around = numbered(patch, wound_alike(world, wide_outside(world, patch)))
    world.positions[problem.vertices] = after
    points = world.positions[vertices]
    found = fairing.looks.flank(points, patch.triangles, around, fixed=patch.fixed)
    if found is None:
        return None
    edges, _ = fairing.edges_with_uses(around)
    edge = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean()
    return Flank(found.boundary.astype(np.int64), found.is_bump, int(np.ceil(found.width / edge)))


def _lost(mesh: MeshArrays, matrix: Floats, problem: Problem, after: Floats) -> Lost:
    """Find what the surface has lost of the shape around it."""
    patch = problem.patch
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite outside the patch
        world = mesh.transformed(matrix)
    offsets = None if mesh.shown_offsets is None else mesh.shown_offsets @ matrix[:3, :3].T
    return replace(
        sunken(patch, after[: len(patch.vertices)], problem),
        is_smoother=is_smoother(world, world.positions, problem, after),
        is_rougher=_is_plain(patch) and fairing.looks.is_rougher(after, patch.triangles, problem.outside),
        border=moved_border(problem, after),
        key=kept_key(problem, after, offsets),
    )


def _is_plain(patch: Patch) -> bool:
    """Return whether one loop bounds the patch and nothing is held inside: fillets and pins bend as they must."""
    held_inside = len(np.setdiff1d(patch.fixed, patch.outline)) > 0
    return not held_inside and len(fairing.boundary_loops(patch.triangles)) == 1


def _eaten(mesh: MeshArrays, problem: Problem, after: Floats) -> Eaten:
    """Find hard edges that are no more, though they run on outside or were marked sharp."""
    sharp = None if mesh.sharp is None else mesh.edges[mesh.sharp]
    return eaten_edges(problem, after, sharp)


def _rounded(mesh: MeshArrays, matrix: Floats, problem: Problem, after: Floats, moving: Ints) -> Ints:
    """Return the mesh vertices outside at hard edges that a smoothed boundary or a band has rounded."""
    outside = problem.vertices[np.setdiff1d(moving, problem.patch.free)]
    moves = np.zeros(len(mesh.positions), dtype=bool)
    moves[outside] = True
    around = nearby(mesh.triangles, moves)  # one row before the boundary shows no hard edge by itself
    before = places(mesh, matrix)
    points = before.copy()
    points[problem.vertices] = after
    rounded = fairing.looks.rounded_edges(before, points, around, np.sort(problem.vertices[moving]))
    found: Ints = np.intersect1d(rounded, outside)
    return found


def leading_part(result: fairing.FairResult, own: int) -> fairing.FairResult:
    """Leave out all but the first `own` vertices: those of the faces around the patch, say."""
    return replace(
        result,
        vertices=result.vertices[:own],
        base=None if result.base is None else result.base[:own],
        mean_curvature=result.mean_curvature[:own],
        moved=result.moved[result.moved < own],
    )


def _positions(
    mesh: MeshArrays, matrix: Floats, factor: float, solved: Solved, moving: Ints
) -> tuple[Floats, tuple[str, ...]]:
    """Return where the vertices `moving` of the problem go (k, 3), in the mesh's own coordinates, and warnings."""
    problem = solved.problem
    local = to_local(solved.result.vertices, matrix)
    fair, warnings = _mirrored(mesh, problem, local, moving)
    fair = fair[moving]
    if factor == 1.0:
        return fair, warnings
    original = mesh.positions[problem.vertices[moving]]
    # Blended in local space, so that factor 0 gives the very bits that were there.
    return original + factor * (fair - original), warnings


def _is_clear(patch: Patch, result: fairing.FairResult) -> bool:
    """Return whether the engine, which looks at each piece, has found that no triangle passes through another."""
    found = any(diagnostic.code == "SELF_INTERSECTION" for diagnostic in result.warnings)
    return not found and islands(patch) <= 1


def _mirrored(mesh: MeshArrays, problem: Problem, fair: Floats, moving: Ints) -> tuple[Floats, tuple[str, ...]]:
    """Make the local positions (q, 3) symmetric where the mesh asks for that; only those `moving` count."""
    if not mesh.mirror_x:
        return fair, ()
    image = mirror_map(mesh, problem.patch)
    if image is not None and problem.weights is not None:
        image = with_band(image, mesh.positions[problem.vertices], moving)
    if image is None:
        return fair, (said("patch_not_symmetric"),)
    whole = fair.copy()
    whole[: len(image)] = symmetrised(fair[: len(image)], image)
    return whole, ()


def _largest_curvatures(patch: Patch, result: fairing.FairResult) -> tuple[float, float]:
    sizes = np.abs(result.mean_curvature)
    return float(sizes[patch.free].max(initial=0.0)), float(sizes[patch.outline].max(initial=0.0))
