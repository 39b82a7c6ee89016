"""From a mesh to the engine's answer for its patch, asked anew or remembered."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

import fairing

from ..arrays.around import numbered, outside_triangles, wide_outside, wound_alike
from ..arrays.boundary import boundary_notes, precision_note
from ..arrays.region import MeshArrays, Patch, make_patch, nothing
from ..arrays.types import Floats
from ..arrays.winding import winding_note, with_one_winding
from ..options.options import FairOptions
from ..words.findings import Origin
from ..words.sentences import sentences
from ..words.words import said
from . import engine
from .boundary import boundary
from .engine import Progress
from .feather import band_weights
from .held_curves import faired_curves
from .local_pins import pulled, without_lone_pins
from .memory import ANSWER, SOLVER, Memory, digest

NO_ANSWER = ("FOLDED", "NOT_CONVERGED")  # codes that are reasons of a verdict
NO_ACTION = ("SHARP_BOUNDARY",)  # codes that leave nothing to do to whom they are said


@dataclass(frozen=True)
class Solved:
    """What the engine gave, before blending: the factor changes nothing here, and detail nothing but positions."""

    problem: engine.Problem
    result: fairing.FairResult
    warnings: tuple[str, ...]
    failures: tuple[str, ...] = ()  # why there is no answer, where there is none


@dataclass(frozen=True)
class Kept:
    """What the redo panel answers from."""

    # Answers where nothing but factor and detail changed since a former call, solvers where only options did; a solver
    # of None: a mesh that was solved once.
    memory: Memory
    ahead: bool = False  # make a solver at the first call already, whose start for the next one takes a while
    # Is given the problem and the (p, 3) vertices of its first surface.
    preview: Callable[[engine.Problem, Floats], object] | None = None


def solve(
    mesh: MeshArrays,
    matrix: Floats,
    options: FairOptions,
    progress: Progress | None = None,
    kept: Kept | None = None,
) -> Solved:
    """Solve for the patch of `mesh` in the space that the 4×4 `matrix` leads to.

    kept: what former calls left.
    Raises fairing.MeshError (its `elements` are vertices of `mesh` here), ValueError,
    fairing.SolverError and fairing.Cancelled. `mesh` is never changed.
    """
    options, mesh = options.resolved(mesh.textured), replace(mesh, textured=False)  # asked for by some options only
    released, lone = without_lone_pins(mesh, options)
    if lone.any():
        without = solve(released, matrix, replace(options, pin_group=""), progress, kept)
        vertices = pulled(without.problem, without.result.vertices, lone, options.pin_radius)
        if not _folds(without, vertices):
            return replace(without, result=replace(without.result, vertices=vertices))
    share, options = options.detail, replace(options, detail=float(options.detail > 0.0))
    # Of two results for the same input the bits are the same, so that a former one is as good.
    place = digest(mesh, matrix) if kept is not None else ""
    key = digest(place, replace(options, factor=1.0, allow_folds=True))
    solved: Solved | None = kept.memory.get(ANSWER, key) if kept is not None else None
    if solved is None:
        problem, warnings = pose(mesh, matrix, options)
        if kept is not None:
            result = _solve_again(digest(place, problem.patch), problem, options, progress, kept)
            solved = _solved(problem, result, warnings)
            kept.memory.put(ANSWER, key, solved)
        else:
            solved = _solved(problem, engine.solve(problem, options, progress), warnings)
    return _with_detail(solved, share)


def _folds(without: Solved, vertices: Floats) -> bool:
    """Return whether the pull turns faces over, as pins far aside do: the surface passes through these as a whole."""
    triangles = without.problem.patch.triangles
    found, before = (len(fairing.looks.flipped_triangles(v, triangles)) for v in (vertices, without.result.vertices))
    return found > before


def _with_detail(solved: Solved, share: float) -> Solved:
    """Return the answer with a part of the detail put back; the engine gives all of it or none."""
    if share in (0.0, 1.0):
        return solved
    result = solved.result
    vertices = result.base + share * (result.vertices - result.base)
    return replace(solved, result=replace(result, vertices=vertices))


def pose(mesh: MeshArrays, matrix: Floats, options: FairOptions) -> tuple[engine.Problem, tuple[str, ...]]:
    """Return the patch with its boundary data in world space, and warnings."""
    options = options.resolved(mesh.textured)
    # What is not finite outside the patch is none of our business, and the engine looks inside.
    with np.errstate(invalid="ignore", over="ignore"):
        world, turned = with_one_winding(mesh.transformed(matrix))
        patch = make_patch(world, by_connectivity=not options.keeps_triangles)
        wide = options.takes_base
        outside = wide_outside(world, patch, options.falloff) if wide else outside_triangles(world, patch)
        known = boundary(world, patch, options.boundary_normals, outside)
        inward = known.inward(patch)
        vertices, around = numbered(patch, wound_alike(world, outside))
        weights = band_weights(world, patch, vertices, around, options.falloff) if options.moves_band else None
        odd = boundary_notes(world) + _odd_in_words(mesh, patch, options)
        curve, places = faired_curves(world) if options.fairs_pinned_edges else (nothing(), np.empty((0, 3)))
    curvatures = known.curvatures if options.joins_curvature else None
    problem = engine.Problem(
        patch, world.positions[vertices], known.normals, vertices, around, curvatures, weights,
        np.searchsorted(patch.vertices, curve), places, inward,
    )  # fmt: skip
    return problem, known.notes + winding_note(turned) + odd + mesh.notes


def _odd_in_words(mesh: MeshArrays, patch: Patch, options: FairOptions) -> tuple[str, ...]:
    """Return notes on positions that are too coarse, and on groups of boundary vertices that have none."""
    notes = [precision_note(mesh)]
    if mesh.free_slopes is not None and not len(patch.free_slopes):
        notes.append(said("continuity_group_empty", name=options.continuity_group))
    if patch.continued is not None and not patch.continued.any():
        notes.append(said("continuity_group_empty", name=options.continuity_group))
    return tuple(note for note in notes if note)


def _solve_again(
    key: str, problem: engine.Problem, options: FairOptions, progress: Progress | None, kept: Kept
) -> fairing.FairResult:
    """Solve with the solver of a former call for the same patch, if there was one: other options move less."""
    preview = partial(kept.preview, problem) if kept.preview is not None else None
    if options.reads_surroundings:
        return engine.solve(problem, options, progress, preview)
    was_here = kept.memory.has(SOLVER, key)
    solver = kept.memory.take(SOLVER, key)
    if not was_here and not kept.ahead:
        kept.memory.put(SOLVER, key, None)
        return engine.solve(problem, options, progress, preview)
    solver = solver or engine.RepeatedSolve(problem.patch, options)
    try:
        solver.change(options)
        return solver(problem, progress, preview)
    finally:
        kept.memory.put(SOLVER, key, solver)  # errors leave it usable


def _solved(problem: engine.Problem, result: fairing.FairResult, warnings: tuple[str, ...]) -> Solved:
    reported, failures = reported_by(result, problem.origin)
    return Solved(problem, result, warnings + reported, failures)


def reported_by(
    result: fairing.FairResult | fairing.RemeshResult, origin: Origin
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return what the engine warned of, in sentences: what is always reported, and why there is no answer."""
    said_of = [each for each in result.warnings if not _is_measured(each) and each.code not in NO_ACTION]
    reported = tuple(warning for warning in said_of if warning.code not in NO_ANSWER)
    failures = tuple(warning for warning in said_of if warning.code in NO_ANSWER)
    return sentences(reported, origin), sentences(failures, origin)


def _is_measured(warning: fairing.Diagnostic) -> bool:
    """Return whether `quality` counts it in what is written, mirrored or blended as that may be."""
    return warning.code == "SELF_INTERSECTION" or (
        warning.code == "FLIPPED_TRIANGLES" and "triangles" in warning.figures
    )
