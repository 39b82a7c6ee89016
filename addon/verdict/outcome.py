"""Where the free vertices go, and what that is worth."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np

import fairing

from ..arrays.around import MovedKey
from ..arrays.region import MeshArrays, Patch, nothing, to_local
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem, Progress, go_on, islands
from ..fair.solve import Solved
from ..mirror.symmetry import mirrored
from ..options.options import FairOptions
from ..selection.selection import left_out, tunnel_hint
from . import quality
from .evidence import Evidence
from .lost import Lost, kept_key, moved_border
from .quality import Join, Quality, moved_sheet, places
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
    here = places(mesh, matrix)
    seen = quality.measured(
        mesh, (here, patch), (moved_sheet(here, problem, after), problem),
        moved=problem.vertices[moving], is_clear=clear, progress=progress,
    )  # fmt: skip
    if not (options.smooth_boundary or options.moves_band):
        seen = replace(seen, rounded=nothing())
    evidence = Evidence(
        problem, result, solved.failures, seen, points=after, left_out=left_out(mesh),
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
        before=seen.before,
        after=seen.after,
        distortion=quality.texture_distortion(before, after, patch.triangles),
        curvature=_largest_curvatures(patch, result),
        join=seen.join,
        verdict=verdict,
        free_count=len(patch.free),
    )


def _lost(mesh: MeshArrays, matrix: Floats, problem: Problem, after: Floats) -> Lost:
    """Find what the surface has lost of the shape around it."""
    offsets = None if mesh.shown_offsets is None else mesh.shown_offsets @ matrix[:3, :3].T
    return Lost(moved_border(problem, after), kept_key(problem, after, offsets))


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
    band = None if problem.weights is None else (problem.vertices, moving)
    fair, warnings = mirrored(mesh, problem.patch, local, band)
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


def _largest_curvatures(patch: Patch, result: fairing.FairResult) -> tuple[float, float]:
    sizes = np.abs(result.mean_curvature)
    return float(sizes[patch.free].max(initial=0.0)), float(sizes[patch.boundary].max(initial=0.0))
