"""A patch on a new mesh: posed, solved, and what that is worth. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.lines import inner_curves, inner_lines
from ..arrays.region import MeshArrays, Patch, to_local
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem, Progress
from ..fair.solve import pose, reported_by
from ..mirror.reflected import Whole, with_image
from ..options.options import FairOptions
from ..selection.selection import left_out, tunnel_hint
from ..verdict import quality
from ..verdict.evidence import Evidence
from ..verdict.outcome import Fairing
from ..verdict.quality import Sheet, places
from ..verdict.verdict import GOOD, LOOK, because_of, judge
from ..words.findings import Origin
from ..words.sentences import in_mesh_words
from ..words.words import said
from .faces import Faces, faces_in_rows, faces_of, paired_faces
from .new_part import NewPart, new_part

MOST_SQUEEZED = 0.25  # of the old length of an edge that stays: below, it counts as squeezed,
LEAST_SQUEEZED = 4  # where so many are


@dataclass(frozen=True)
class Remeshed(Fairing):
    """A patch with a mesh of its own: `vertices` and `positions` are those of lines, which move."""

    part: NewPart
    new_positions: Floats  # (k, 3) of the new vertices, in the mesh's own coordinates
    points: Floats  # (r + k, 3) of all vertices of the part, in world space
    quads: bool  # whether faces are quads
    unselected: int = 0  # faces at the beginning that are not to be selected
    whole: Whole | None = None  # the mesh with its image, whose numbers these are but for the verdict's

    def for_half(self, whole: Whole) -> Remeshed:
        return replace(self, whole=whole, verdict=whole.about_half(self.verdict))

    def faces(self, kinds: Ints) -> Faces:
        """Return what is written; kinds: (m,) of the triangles: quads in rows have one kind, and each pair has."""
        if not self.quads:
            return faces_of(self.part.triangles)
        if len(self.part.pairs) and (kinds == kinds[:1]).all():
            return faces_in_rows(self.part.triangles, self.part.pairs, self.part.lines)
        return paired_faces(self.points, self.part.triangles, self.part.lines, kinds)


def remesh_arrays(mesh: MeshArrays, matrix: Floats, options: FairOptions, progress: Progress | None = None) -> Remeshed:
    """Fair the patch of `mesh` on a new mesh, in the space that the 4×4 `matrix` leads to.

    Raises MeshRefusal, ValueError, fairing.SolverError and fairing.Cancelled. `mesh` is never changed.
    """
    return with_image(mesh).found(lambda mesh: _remeshed(mesh, matrix, options, progress))


def _remeshed(mesh: MeshArrays, matrix: Floats, options: FairOptions, progress: Progress | None) -> Remeshed:
    lines = inner_lines(mesh) | inner_curves(mesh)
    problem, warnings = pose(mesh, matrix, options)
    kept = _kept_edges(problem, mesh.edges[lines])
    result = _solved(problem, kept, options, progress)
    part = new_part(mesh, problem, result, lines)
    place, posed = _places(problem, problem.points), _places(problem, problem.posed)
    after = _new_problem(problem, part, result, posed)
    before = np.concatenate([place[part.stay], part.vertices.mean(place)])
    points = before + options.factor * (after.own_points - before)
    own = replace(after, points=np.concatenate([points, after.points[len(points) :]]))
    origin = _origin(problem, result)
    reported, failures = reported_by(result, origin)
    here = places(mesh, matrix)
    seen = quality.measured(mesh, (here, problem.patch), (_sheet(here, part, points), own), progress=progress)
    evidence = Evidence(
        after, result, failures, seen, squeezed=_squeezed(problem, kept, result), points=own.points, origin=origin,
        left_out=left_out(mesh),
    )  # fmt: skip
    verdict = judge(evidence, options)
    tunnels = () if verdict.grade == GOOD else tunnel_hint(problem.patch)
    verdict = because_of(verdict, tunnels)
    odd = tunnels if verdict.grade == LOOK else ()
    local = to_local(points, matrix)
    stay = len(part.stay)
    return Remeshed(
        vertices=part.stay[part.fixed_count :],
        positions=local[part.fixed_count : stay],
        result=result,
        warnings=warnings + reported + _limits(mesh) + odd,
        before=seen.before,
        after=seen.after,
        distortion=quality.texture_distortion(before, points, part.triangles),
        curvature=_largest_curvatures(result),
        join=seen.join,
        verdict=verdict,
        free_count=len(points) - part.held_count,
        part=_wound_back(part) if mesh.transformed(matrix).mirrored else part,
        new_positions=local[stay:],
        points=points,
        quads=options.quads,
    )


def squeezed(before: Floats, after: Floats, lines: Ints) -> Ints:
    """Return the ends of those of the lines (l, 2) that are far shorter at one state of the points than before.

    None where there are few: some edge of a crumpled old surface always is.
    """
    lengths = [np.linalg.norm(points[lines[:, 0]] - points[lines[:, 1]], axis=1) for points in (before, after)]
    short = lengths[1] < MOST_SQUEEZED * lengths[0]
    ends: Ints = np.unique(lines[short]) if np.count_nonzero(short) >= LEAST_SQUEEZED else lines[:0, 0]
    return ends


def _squeezed(problem: Problem, kept: Ints, result: fairing.RemeshResult) -> Ints:
    """Return the mesh vertices on lines that stay where these have become a knot."""
    after = problem.own_points.copy()
    on_line = result.old >= 0
    after[result.old[on_line]] = result.vertices[on_line]
    found: Ints = problem.patch.vertices[squeezed(problem.own_points, after, kept)]
    return found


def _sheet(before: Floats, part: NewPart, points: Floats) -> Sheet:
    """Return the mesh with its new vertices, for which the old ones next to them stand; points: (r + k, 3)."""
    stay, count = len(part.stay), len(before)
    moved = before.copy()
    moved[part.stay] = points[:stay]
    numbers = np.concatenate([part.stay, count + np.arange(len(points) - stay)])
    nearest = np.concatenate([np.arange(count), part.vertices.heaviest])
    return Sheet(np.concatenate([moved, points[stay:]]), numbers, nearest)


def _solved(problem: Problem, kept: Ints, options: FairOptions, progress: Progress | None) -> fairing.RemeshResult:
    patch = problem.patch
    arguments = {**options.engine_arguments(), "creases": patch.slopes_found, "smooth_curves": patch.smooth_curves}
    for name in ("detail",):
        del arguments[name]
    boundary = fairing.Boundary(patch.fixed, problem.normals, problem.curvatures, continuity=problem.kinds)
    with in_mesh_words(problem.origin):
        return fairing.remesh(
            problem.posed[: len(patch.vertices)], patch.triangles, boundary, fairing.Options.of(**arguments),
            kept=kept, spacing=_spacing(problem, options), inner="outline",
            faces="quads" if options.quads else "triangles", progress=progress,
        )  # fmt: skip


def _kept_edges(problem: Problem, lines: Ints) -> Ints:
    """Return those of the mesh's edges that are edges of the patch's triangles, in its numbers: fins are no part."""
    patch = problem.patch
    number = {vertex: k for k, vertex in enumerate(patch.vertices.tolist())}
    pairs = [[number[a], number[b]] for a, b in lines.tolist()]
    sides = np.concatenate([patch.triangles[:, [0, 1]], patch.triangles[:, [1, 2]], patch.triangles[:, [2, 0]]])
    known = {tuple(side) for side in np.sort(sides, axis=1).tolist()}
    found = [pair for pair in pairs if tuple(sorted(pair)) in known]
    return np.array(found, dtype=np.int64).reshape(-1, 2)


def _spacing(problem: Problem, options: FairOptions) -> float:
    """Return the wanted length; 0, which stands for that of the boundary's edges, for a factor of 1."""
    if options.spacing == 1.0:
        return 0.0
    loops = fairing.boundary_loops(problem.patch.triangles)
    if not loops:
        return options.spacing * float(np.sqrt(quality.mean_area(problem.own_points, problem.patch.triangles)))
    edges = [problem.points[np.roll(loop, -1)] - problem.points[loop] for loop in loops]
    return options.spacing * float(np.linalg.norm(np.concatenate(edges), axis=1).mean())


def _places(problem: Problem, points: Floats) -> Floats:
    """Return the points (q, 3) of the problem by their numbers in the mesh; 0 for all others."""
    place = np.zeros((int(problem.vertices.max()) + 1, 3))
    place[problem.vertices] = points
    return place


def _new_problem(problem: Problem, part: NewPart, result: fairing.RemeshResult, place: Floats) -> Problem:
    """Return the new part as a patch: its own r + k points, then those of the faces around.

    place: of the old points with curves where they go, by their numbers in the mesh. A new vertex goes by the number of
    the old one that it is next to.
    """
    own = np.concatenate([part.stay, part.vertices.heaviest])
    outside = problem.vertices[problem.outside]
    others = np.setdiff1d(outside, part.stay)
    number = np.full(len(place), -1, dtype=np.int64)
    number[others] = len(own) + np.arange(len(others))
    number[part.stay] = np.arange(len(part.stay))
    lines, new = np.flatnonzero(result.old >= 0), np.flatnonzero(result.old < 0)
    fixed = part.stay[: part.held_count]
    points = np.concatenate([place[fixed], result.vertices[lines], result.vertices[new], place[others]])
    count = len(problem.patch.vertices)
    patch = Patch(
        vertices=own,
        triangles=part.triangles,
        faces=count + np.arange(len(part.triangles)) + int(problem.patch.faces.max(initial=-1)) + 1,
        free=np.arange(part.held_count, len(own)),
        fixed=np.arange(part.held_count),
        boundary=np.unique(np.concatenate([np.empty(0, np.int64), *fairing.boundary_loops(part.triangles)])),
        neighbours=None,
    )
    vertices = np.concatenate([own, others])
    return Problem(patch, points, np.empty((0, 3)), vertices, number[outside], inward=problem.inward)


def _origin(problem: Problem, result: fairing.RemeshResult) -> Origin:
    """Return what the engine's numbers in the warnings stand for: those of the mesh that was solved last."""
    if result.cut:
        return problem.origin
    patch = problem.patch
    near = patch.triangles[result.origin[0]][np.arange(len(result.old)), result.origin[1].argmax(axis=1)]
    vertices = np.concatenate([patch.vertices, patch.vertices[near]])
    return Origin(vertices, result.triangles.astype(np.int64), np.arange(len(result.triangles)))


def _largest_curvatures(result: fairing.RemeshResult) -> tuple[float, float]:
    largest = float(np.abs(result.mean_curvature).max(initial=0.0))
    return largest, largest


def _limits(mesh: MeshArrays) -> tuple[str, ...]:
    """Return what was asked for and a new mesh does not do."""
    return (said("borders_held"),) if mesh.fair_border else ()


def _wound_back(part: NewPart) -> NewPart:
    """Return the part with its triangles wound as the mesh's own."""
    order = (3 * np.arange(len(part.triangles))[:, None] + np.array([2, 1, 0])).ravel()
    corners = replace(part.corners, sources=part.corners.sources[order], weights=part.corners.weights[order])
    return replace(part, triangles=part.triangles[:, ::-1], corners=corners)
