"""The one place that calls the engine: a patch in world space, once or again and again."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import fairing

from ..arrays.region import Patch, nothing
from ..arrays.types import Floats, Ints, Words
from ..options.options import FairOptions
from ..words.findings import Origin
from ..words.sentences import in_mesh_words
from .feather import naming_the_band

Progress = Callable[[float, str], "bool | None"]

Preview = Callable[[Floats], object]  # is given the (p, 3) vertices of a run's first surface

# What the engine answers: on the mesh that is there, on a new one, or over a hole.
Result = fairing.FairResult | fairing.RemeshResult | fairing.FillResult | fairing.results.FilletResult

# What `solve` raises for input that it can't fair here; the mesh is untouched then.
REFUSALS = (ValueError, fairing.SolverError, MemoryError)


@dataclass(frozen=True)
class Problem:
    """A patch with its G1 data, in world space."""

    patch: Patch
    points: Floats  # (q, 3) of `vertices`
    normals: Floats  # (k, 3) unit, in the order of patch.fixed
    vertices: Ints  # (q,) mesh indices: the patch's p, then those of the faces around it
    outside: Ints  # (o, 3) triangles around the patch, in numbers of `vertices`
    curvatures: Floats | None = None  # (k,) H outside, NaN where it is not known; None: not to be continued
    weights: Floats | None = None  # (q,) each vertex's own factor; None: 1 inside, 0 outside
    curve: Ints = field(default_factory=nothing)  # patch indices of fixed vertices that move before all else
    curve_points: Floats = field(default_factory=lambda: np.empty((0, 3)))  # where they go
    inward: Ints = field(default_factory=nothing)  # mesh vertices of the boundary with the slope of the selected faces

    @classmethod
    def of(cls, patch: Patch, points: Floats, normals: Floats, curvatures: Floats | None = None) -> Problem:
        """Pose it for the patch (p, 3) alone, without what is around it."""
        return cls(patch, points, normals, patch.vertices, np.empty((0, 3), dtype=np.int64), curvatures)

    @property
    def origin(self) -> Origin:
        return Origin(self.vertices, self.patch.triangles, self.patch.faces)

    @property
    def kinds(self) -> Words | None:
        """The (k,) continuity along patch.fixed, where it differs; None: one for all."""
        return None if self.patch.continued is None else np.where(self.patch.continued, "G2", "G1")

    @property
    def own_points(self) -> Floats:
        """The (p, 3) points of the patch alone."""
        return self.points[: len(self.patch.vertices)]

    @property
    def posed(self) -> Floats:
        """The (q, 3) points with its curves where they go."""
        if not len(self.curve):
            return self.points
        points = self.points.copy()
        points[self.curve] = self.curve_points
        return points


def solve(
    problem: Problem, options: FairOptions, progress: Progress | None = None, preview: Preview | None = None
) -> fairing.FairResult:
    """Fair the patch; indices in the result are patch indices.

    Raises MeshRefusal (its `elements` are mesh vertices), ValueError, fairing.SolverError and fairing.Cancelled.
    """
    patch = problem.patch
    if options.smooth_boundary and np.isin(patch.creases, patch.boundary).any():
        raise ValueError(
            "Smooth Boundary would round off the creases that run out of the selection: turn it off, "
            "or choose At Pinned Edges: Averaged"
        )
    reads = options.reads_surroundings
    boundary = fairing.Boundary(
        patch.fixed,
        problem.normals,
        problem.curvatures if options.joins_curvature else None,
        problem.outside if reads else None,
        problem.kinds if options.joins_curvature else None,
    )
    wanted = fairing.Options.of(
        neighbours=patch.neighbours if problem.weights is None else None,  # the band has none
        outline="mended" if options.smooth_boundary else "given",
        weights=problem.weights,
        **_held_inside(patch, options),
        **options.engine_arguments(),
    )
    points = problem.posed if reads else problem.posed[: len(patch.vertices)]
    with naming_the_band(options), in_mesh_words(problem.origin):
        return fairing.fair(points, patch.triangles, boundary, wanted, progress=progress, preview=preview)


def go_on(progress: Progress | None) -> None:
    """Ask between steps of the add-on's own, which ask nobody meanwhile; raises fairing.Cancelled."""
    if progress is not None and progress(1.0, "measurement") is False:
        raise fairing.Cancelled("cancelled between two measurements")


def _held_inside(patch: Patch, options: FairOptions) -> dict[str, Any]:
    """Return what holds inside the patch with a slope that the surface finds."""
    return {
        "creases": patch.slopes_found,
        "smooth_curves": patch.smooth_curves,
        "open_border": "faired" if options.fair_open_borders else "held",
    }


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


def bad_outline(problem: Problem) -> Ints:
    """Return the mesh vertices of the boundary whose surroundings say little about the surface; creases are meant."""
    rim = np.intersect1d(problem.patch.boundary, problem.outside)
    found = fairing.bad_outline(problem.points, problem.outside, rim)
    bad: Ints = problem.vertices[np.setdiff1d(found, problem.patch.slopes_found)]
    return bad


def islands(patch: Patch) -> int:
    """Count the pieces that are solved each on its own; raises MeshRefusal."""
    with in_mesh_words(patch.origin):
        return int(fairing.components(patch.triangles, fixed=patch.fixed).max(initial=-1)) + 1


class RepeatedSolve:
    """Solves one patch for positions and normals that move, each time from the last answer, or for other options."""

    def __init__(self, patch: Patch, options: FairOptions, reference: Floats | None = None) -> None:
        """Solve nothing yet; raises MeshRefusal where the patch can't be.

        reference: (p, 3), the shape that inner fairness belongs to; left out: the positions of each solve.
        """
        self._reference = reference
        with in_mesh_words(patch.origin):
            self._solver = fairing.Solver(
                patch.triangles,
                fixed=patch.fixed,
                neighbours=patch.neighbours,
                **_held_inside(patch, options),
                **options.engine_arguments(),
            )

    def change(self, options: FairOptions) -> None:
        self._solver.change(**options.engine_arguments())

    def __call__(
        self, problem: Problem, progress: Progress | None = None, preview: Preview | None = None
    ) -> fairing.FairResult:
        """Fair the patch, which must be the one given, as `solve` does; raises the same."""
        with in_mesh_words(problem.patch.origin):
            own = problem.posed[: len(problem.patch.vertices)]
            return self._solver.solve(
                own, problem.normals, self._reference, progress, fixed_curvatures=problem.curvatures, preview=preview,
                continuity=problem.kinds,
            )  # fmt: skip

    def first(self, problem: Problem) -> Floats:
        """Return the (p, 3) vertices of the surface that there always is, within milliseconds; raises MeshRefusal."""
        found: list[Floats] = []

        def take(vertices: Floats) -> None:
            found.append(vertices)
            raise fairing.Cancelled("the first surface was all that was wanted")

        with suppress_cancel():
            self(problem, preview=take)
        return found[0]


def sub_range(progress: Progress | None, begin: float, end: float) -> Progress | None:
    """Map the fractions of one part of the work onto those of the whole."""
    if progress is None:
        return None
    return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)
