"""The one place that calls the engine: a patch in world space, whole or piece by piece, once or again and again."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import fairing

from .arrays import Floats, Ints
from .components import Component, components, outline_radius
from .options import FairOptions
from .region import Patch
from .words import in_mesh_words

Progress = Callable[[float, str], "bool | None"]

# What `solve` raises for input that it can't fair here; the mesh is untouched then.
REFUSALS = (ValueError, fairing.SolverError, MemoryError)


@dataclass(frozen=True)
class Problem:
    """A patch with its G1 data, in world space."""

    patch: Patch
    points: Floats  # (p, 3) of patch.vertices
    normals: Floats  # (k, 3) unit, in the order of patch.fixed


def solve(problem: Problem, options: FairOptions, progress: Progress | None = None) -> fairing.FairResult:
    """Fair the patch; indices in the result are patch indices.

    A bulge is measured by each piece's own outline, so that pieces are solved one after the other
    then. Raises MeshRefusal (its `elements` are mesh vertices), ValueError,
    fairing.SolverError and fairing.Cancelled.
    """
    if options.equation != "CONSTANT" or options.bulge == 0.0:
        return _solve_part(problem, options, 0.0, progress)
    pieces = components(problem.patch)
    if len(pieces) <= 1:
        return _solve_part(problem, options, _load(problem, problem.patch.outline, options), progress)
    return _solve_pieces(problem, pieces, options, progress)


def check(problem: Problem, options: FairOptions) -> None:
    """Let the engine look at the patch without solving it; raises what `solve` would for its input."""
    with suppress_cancel():
        _solve_part(problem, options, 0.0, lambda _fraction, stage: stage == "topology")


@contextmanager
def suppress_cancel() -> Iterator[None]:
    """End quietly where the engine was stopped on purpose."""
    try:
        yield
    except fairing.Cancelled:
        return


def _load(problem: Problem, outline: Ints, options: FairOptions) -> float:
    """Return the engine's load, in length⁻³: 8 bulge / a³ with a the outline's RMS radius."""
    return 8.0 * options.bulge / outline_radius(problem.points[outline]) ** 3


def _solve_part(problem: Problem, options: FairOptions, load: float, progress: Progress | None) -> fairing.FairResult:
    patch = problem.patch
    with in_mesh_words(patch.origin):
        return fairing.fair(
            problem.points,
            patch.triangles,
            fixed=patch.fixed,
            fixed_normals=problem.normals,
            neighbours=patch.neighbours,
            load=load,
            progress=progress,
            **options.engine_arguments(),
        )


class KeptSolver:
    """Solves one patch for options that change while the mesh stays, each time from the last answer."""

    def __init__(self, patch: Patch) -> None:
        """Solve nothing yet; raises MeshRefusal where the patch can't be."""
        with in_mesh_words(patch.origin):
            self._solver = fairing.Solver(patch.triangles, fixed=patch.fixed, neighbours=patch.neighbours)

    def __call__(self, problem: Problem, options: FairOptions, progress: Progress | None) -> fairing.FairResult:
        """Fair the patch, which must be the one given, as `solve` does; raises the same."""
        with in_mesh_words(problem.patch.origin):
            load = 0.0
            if options.equation == "CONSTANT" and options.bulge != 0.0:
                load = _load(problem, problem.patch.outline, options)
            self._solver.change(load=load, **options.engine_arguments())
            return self._solver.solve(problem.points, problem.normals, progress=progress)


def is_one_load(problem: Problem, options: FairOptions) -> bool:
    """Tell whether all pieces of a patch have the same load, so that they can be solved in one go."""
    return options.equation != "CONSTANT" or options.bulge == 0.0 or len(components(problem.patch)) <= 1


class RepeatedSolve:
    """Solves one patch for boundaries that move, each time from the last answer.

    A bulge is measured by each piece's own outline, which moves: its pieces are solved at the size 1, where
    the load stays the same.
    """

    def __init__(self, patch: Patch, points: Floats, options: FairOptions) -> None:
        """Prepare for the patch; `points` (p, 3) is the shape that inner fairness belongs to."""
        self._bulges = options.equation == "CONSTANT" and options.bulge != 0.0
        whole = Problem(patch, points, np.zeros((len(patch.fixed), 3)))
        self._pieces = components(patch) if self._bulges else ()
        parts = [_part(whole, piece)[0] for piece in self._pieces] or [whole]
        self._references = [part.points for part in parts]
        load = 8.0 * options.bulge if self._bulges else 0.0
        self._solvers = [self._solver(part.patch, load, options) for part in parts]

    @staticmethod
    def _solver(patch: Patch, load: float, options: FairOptions) -> fairing.Solver:
        with in_mesh_words(patch.origin):
            return fairing.Solver(
                patch.triangles,
                fixed=patch.fixed,
                neighbours=patch.neighbours,
                load=load,
                **options.engine_arguments(),
            )

    def __call__(self, problem: Problem, progress: Progress | None = None) -> fairing.FairResult:
        """Fair the patch as `solve` does; raises the same. `progress` begins anew with each piece."""
        if not self._bulges:
            return self._solve_part(0, problem, 1.0, progress)
        results = []
        for index, piece in enumerate(self._pieces):
            part, used = _part(problem, piece)
            size = outline_radius(problem.points[piece.outline])
            results.append((used, self._solve_part(index, part, size, progress)))
        return _merged(problem, results)

    def _solve_part(
        self, index: int, part: Problem, size: float, progress: Progress | None = None
    ) -> fairing.FairResult:
        with in_mesh_words(part.patch.origin):
            result = self._solvers[index].solve(part.points / size, part.normals, self._references[index], progress)
        return replace(result, vertices=result.vertices * size, mean_curvature=result.mean_curvature / size)


def _solve_pieces(
    problem: Problem, pieces: tuple[Component, ...], options: FairOptions, progress: Progress | None
) -> fairing.FairResult:
    sizes = np.array([len(piece.triangles) for piece in pieces], dtype=np.float64)
    ends = np.cumsum(sizes) / sizes.sum()
    results = []
    for piece, end, share in zip(pieces, ends, sizes / sizes.sum(), strict=True):
        part, used = _part(problem, piece)
        load = _load(problem, piece.outline, options)
        results.append((used, _solve_part(part, options, load, sub_range(progress, end - share, end))))
    return _merged(problem, results)


def sub_range(progress: Progress | None, begin: float, end: float) -> Progress | None:
    """Map the fractions of one part of the work onto those of the whole."""
    if progress is None:
        return None
    return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)


def _part(problem: Problem, piece: Component) -> tuple[Problem, Ints]:
    """Cut one piece out; return it and the patch indices of its vertices."""
    patch = problem.patch
    triangles = patch.triangles[piece.triangles]
    number = np.full(len(patch.vertices), -1, dtype=np.int64)
    number[triangles] = 0
    used = np.flatnonzero(number == 0)
    number[used] = np.arange(len(used))
    held = number[patch.fixed] >= 0
    edges = patch.neighbours
    part = Patch(
        vertices=patch.vertices[used],
        triangles=number[triangles],
        faces=patch.faces[piece.triangles],
        free=_present(number[patch.free]),
        fixed=number[patch.fixed[held]],
        outline=number[piece.outline],
        neighbours=None if edges is None else number[edges[(number[edges] >= 0).all(axis=1)]],
    )
    return Problem(part, problem.points[used], problem.normals[held]), used


def _present(numbers: Ints) -> Ints:
    return numbers[numbers >= 0]


def _merged(problem: Problem, results: list[tuple[Ints, fairing.FairResult]]) -> fairing.FairResult:
    """Put the pieces' results together: every array in patch order, of every figure the worst."""
    worst = max((result for _, result in results), key=lambda result: (not result.converged, result.residual))
    points = problem.points.copy()
    curvature = np.zeros(len(points))
    angles = np.zeros(len(points))
    for used, result in results:
        free = np.setdiff1d(np.arange(len(used)), result.fixed)
        points[used[free]] = result.vertices[free]
        curvature[used] = result.mean_curvature
        angles[used[result.fixed]] = np.maximum(angles[used[result.fixed]], result.boundary_angle)
    whole: dict[str, Any] = {
        "vertices": points,
        "fixed": problem.patch.fixed.astype(np.int32),
        "mean_curvature": curvature,
        "boundary_angle": angles[problem.patch.fixed],
        "polished": all(result.polished for _, result in results),
        "iterations": max(result.iterations for _, result in results),
        "initial_residual": max(result.initial_residual for _, result in results),
        "seconds": {"total": sum(result.seconds["total"] for _, result in results)},
        "warnings": tuple(warning for _, result in results for warning in result.warnings),
    }
    return replace(worst, **whole)
