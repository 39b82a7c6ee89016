"""The one place that calls the engine: a patch in world space, once or again and again."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import fairing

from .arrays import Floats
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

    Raises MeshRefusal (its `elements` are mesh vertices), ValueError, fairing.SolverError and fairing.Cancelled.
    """
    patch = problem.patch
    with in_mesh_words(patch.origin):
        return fairing.fair(
            problem.points,
            patch.triangles,
            fixed=patch.fixed,
            fixed_normals=problem.normals,
            neighbours=patch.neighbours,
            progress=progress,
            **options.engine_arguments(),
        )


def check(problem: Problem, options: FairOptions) -> None:
    """Let the engine look at the patch without solving it; raises what `solve` would for its input."""
    with suppress_cancel():
        solve(problem, options, lambda _fraction, stage: stage == "topology")


@contextmanager
def suppress_cancel() -> Iterator[None]:
    """End quietly where the engine was stopped on purpose."""
    try:
        yield
    except fairing.Cancelled:
        return


def islands(patch: Patch) -> int:
    """Count the pieces that are solved each on its own; raises MeshRefusal."""
    with in_mesh_words(patch.origin):
        return int(fairing.components(patch.triangles, fixed=patch.fixed).max(initial=-1)) + 1


class RepeatedSolve:
    """Solves one patch for positions and normals that move, or for other options, each time from the last answer."""

    def __init__(self, patch: Patch, options: FairOptions, reference: Floats | None = None) -> None:
        """Solve nothing yet; raises MeshRefusal where the patch can't be.

        reference: (p, 3), the shape that inner fairness belongs to; left out: the positions of each solve.
        """
        self._reference = reference
        with in_mesh_words(patch.origin):
            self._solver = fairing.Solver(
                patch.triangles, fixed=patch.fixed, neighbours=patch.neighbours, **options.engine_arguments()
            )

    def change(self, options: FairOptions) -> None:
        """Take these options from the next solve on."""
        self._solver.change(**options.engine_arguments())

    def __call__(self, problem: Problem, progress: Progress | None = None) -> fairing.FairResult:
        """Fair the patch, which must be the one given, as `solve` does; raises the same."""
        with in_mesh_words(problem.patch.origin):
            return self._solver.solve(problem.points, problem.normals, self._reference, progress)


def sub_range(progress: Progress | None, begin: float, end: float) -> Progress | None:
    """Map the fractions of one part of the work onto those of the whole."""
    if progress is None:
        return None
    return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)
