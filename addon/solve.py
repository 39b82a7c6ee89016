"""Arrays in, arrays out: the one path from a mesh to its fair positions, for all callers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from . import engine, quality
from .arrays import Floats, Ints
from .boundary import prescribed_normals
from .components import components
from .engine import Progress
from .memory import Memory, digest
from .options import FairOptions
from .outline import outline_notes, precision_note
from .quality import Quality
from .region import MeshArrays, Patch, make_patch
from .symmetry import mirror_map, symmetrised
from .warnings_text import sentences


@dataclass(frozen=True)
class Fairing:
    """New positions for the free vertices, in the mesh's own coordinates, and what they are worth."""

    vertices: Ints  # (k,) mesh indices, ascending
    positions: Floats  # (k, 3)
    result: fairing.FairResult  # for the patch, in world space
    warnings: tuple[str, ...]
    before: Quality
    after: Quality
    distortion: float  # area-weighted mean of the conformal distortion − 1
    curvature: tuple[float, float]  # largest |H| inside and on the outline, in 1/length


@dataclass(frozen=True)
class Solved:
    """What the engine gave, before blending: the factor changes nothing here."""

    problem: engine.Problem
    result: fairing.FairResult
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class Kept:
    """What the redo panel answers from."""

    results: Memory[Solved]  # where nothing but the factor changed since a former call
    solvers: Memory[engine.KeptSolver | None]  # where only options changed; None: a mesh that was solved once
    ahead: bool = False  # make a solver at the first call already, whose start for the next one takes a while


def fair_arrays(
    mesh: MeshArrays,
    matrix: Floats,
    options: FairOptions,
    progress: Progress | None = None,
    kept: Kept | None = None,
) -> Fairing:
    """Fair the patch of `mesh` in the space that the 4×4 `matrix` leads to.

    kept: what former calls left.
    Raises fairing.MeshError (its `elements` are vertices of `mesh` here), ValueError,
    fairing.SolverError and fairing.Cancelled. `mesh` is never changed.
    """
    # Of two results for the same input the bits are the same, so that a former one is as good.
    key = digest(mesh, matrix, replace(options, factor=1.0)) if kept is not None else ""
    solved = kept.results.get(key) if kept is not None else None
    if solved is None:
        problem, warnings = pose(mesh, matrix, options)
        if kept is not None:
            result = _solve_again(digest(mesh, matrix, problem.patch), problem, options, progress, kept)
            solved = _solved(problem, result, warnings)
            kept.results.put(key, solved)
        else:
            solved = _solved(problem, engine.solve(problem, options, progress), warnings)
    return _finish(mesh, matrix, options.factor, solved)


def pose(mesh: MeshArrays, matrix: Floats, options: FairOptions) -> tuple[engine.Problem, tuple[str, ...]]:
    """Return the patch with its boundary data in world space, and warnings."""
    # What is not finite outside the patch is none of our business, and the engine looks inside.
    with np.errstate(invalid="ignore", over="ignore"):
        world = mesh.transformed(matrix)
        # Conformal weights belong to the present shape, and so do its triangles.
        patch = make_patch(world, even=options.inner_fairness != "CONFORMAL")
        normals, warnings = prescribed_normals(world, patch, options.boundary_normals)
        precision = precision_note(mesh)
        notes = outline_notes(world) + ((precision,) if precision else ()) + mesh.notes
    return engine.Problem(patch, world.positions[patch.vertices], normals), warnings + notes


def _solve_again(
    key: str, problem: engine.Problem, options: FairOptions, progress: Progress | None, kept: Kept
) -> fairing.FairResult:
    """Solve with the solver of a former call for the same patch, if there was one: other options move less."""
    if not engine.is_one_load(problem, options):
        return engine.solve(problem, options, progress)
    was_here = key in kept.solvers
    solver = kept.solvers.take(key)
    if not was_here and not kept.ahead:
        kept.solvers.put(key, None)
        return engine.solve(problem, options, progress)
    solver = solver or engine.KeptSolver(problem.patch)
    try:
        return solver(problem, options, progress)
    finally:
        kept.solvers.put(key, solver)  # errors leave it usable


def _solved(problem: engine.Problem, result: fairing.FairResult, warnings: tuple[str, ...]) -> Solved:
    return Solved(problem, result, warnings + sentences(result.warnings))


def _finish(mesh: MeshArrays, matrix: Floats, factor: float, solved: Solved) -> Fairing:
    patch, result = solved.problem.patch, solved.result
    fair, warnings = _mirrored(mesh, patch, to_local(result.vertices, matrix))
    free = patch.vertices[patch.free]
    original = mesh.positions[free]
    # Blended in local space, so that factor 0 gives the very bits that were there.
    blended = original + factor * (fair[patch.free] - original)
    positions: Floats = fair[patch.free] if factor == 1.0 else blended
    before = solved.problem.points
    after = before.copy()
    after[patch.free] = positions @ matrix[:3, :3].T + matrix[:3, 3]
    clear = factor == 1.0 and not mesh.mirror_x and _is_clear(patch, result)
    quality_before, quality_after = quality.compare(before, after, patch.triangles, clear)
    return Fairing(
        vertices=free,
        positions=positions,
        result=result,
        warnings=solved.warnings + warnings,
        before=quality_before,
        after=quality_after,
        distortion=quality.texture_distortion(before, after, patch.triangles),
        curvature=_largest_curvatures(patch, result),
    )


def _is_clear(patch: Patch, result: fairing.FairResult) -> bool:
    """Tell whether the engine, which looks at each piece, has found that no triangle passes through another."""
    found = any(diagnostic.code == "SELF_INTERSECTION" for diagnostic in result.warnings)
    return not found and len(components(patch)) <= 1


def _mirrored(mesh: MeshArrays, patch: Patch, fair: Floats) -> tuple[Floats, tuple[str, ...]]:
    """Make the local positions (p, 3) symmetric where the mesh asks for that."""
    if not mesh.mirror_x:
        return fair, ()
    image = mirror_map(mesh, patch)
    if image is None:
        return fair, ("X mirror is on, but the selection is not symmetric: it was faired as it is",)
    return symmetrised(fair, image), ()


def _largest_curvatures(patch: Patch, result: fairing.FairResult) -> tuple[float, float]:
    sizes = np.abs(result.mean_curvature)
    return float(sizes[patch.free].max(initial=0.0)), float(sizes[patch.outline].max(initial=0.0))


def to_local(positions: Floats, matrix: Floats) -> Floats:
    """Take world positions (k, 3) back; raises SolverError rather than pass on a NaN."""
    local: Floats = np.linalg.solve(matrix[:3, :3], (positions - matrix[:3, 3]).T).T
    if not np.isfinite(local).all():
        raise fairing.SolverError("The solution is not finite; the mesh was left as it was")
    return local
