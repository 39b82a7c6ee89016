"""A live region on arrays alone: what is kept of the mesh, and the next answer for other positions."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.around import RINGS, outside_triangles
from ..arrays.places import numbers_in
from ..arrays.region import OF_EDGES, OF_FACES, OF_VERTICES, MeshArrays, Patch, chosen_of, make_patch, nothing, to_local
from ..arrays.types import Floats, Ints, Mask
from ..fair.boundary import boundary
from ..fair.engine import Problem, Progress, RepeatedSolve, go_on, solve
from ..fair.held_curves import ALONG, faired_curves
from ..fair.local_pins import pulled, without_lone_pins
from ..mirror.symmetry import mirror_map, symmetrised
from ..options.options import FairOptions


@dataclass(frozen=True)
class Surroundings:
    """The faces that decide the answer, as a mesh of their own, and its patch."""

    vertices: Ints  # (n,) of the whole mesh, ascending: those whose positions are read
    mesh: MeshArrays  # of these faces and vertices
    patch: Patch  # in the numbers of `mesh`


def surroundings(mesh: MeshArrays, patch: Patch) -> Surroundings:
    """Cut the patch and the faces around it out of a mesh, as far as normals and curves are fitted to them."""
    near = np.zeros(len(mesh.positions), dtype=bool)
    near[patch.vertices] = True
    faces = mesh.in_patch.copy()
    for _ in range(RINGS if mesh.hard is None else max(RINGS, ALONG)):
        faces[mesh.corner_faces[near[mesh.corner_vertices]]] = True
        near[mesh.corner_vertices[faces[mesh.corner_faces]]] = True
    vertices = np.flatnonzero(near)
    return Surroundings(
        vertices=vertices,
        mesh=_part(mesh, faces, near),
        patch=replace(patch, vertices=numbers_in(vertices, len(near))[patch.vertices]),
    )


def _part(mesh: MeshArrays, faces: Mask, vertices: Mask) -> MeshArrays:
    """Return the mesh of these faces and vertices alone, renumbered."""
    corners = faces[mesh.corner_faces]
    triangles = faces[mesh.triangle_faces]
    used_edges = np.zeros(len(mesh.edges), dtype=bool)
    used_edges[mesh.corner_edges[corners]] = True
    vertex, edge, face = (numbers_in(np.flatnonzero(mask), len(mask)) for mask in (vertices, used_edges, faces))
    normals = mesh.corner_normals
    mesh = replace(mesh, parts=None, sharp=None, held_by_angle=None)
    return replace(
        mesh,
        positions=mesh.positions[vertices],
        edges=vertex[mesh.edges[used_edges]],
        corner_vertices=vertex[mesh.corner_vertices[corners]],
        corner_edges=edge[mesh.corner_edges[corners]],
        corner_faces=face[mesh.corner_faces[corners]],
        triangles=vertex[mesh.triangles[triangles]],
        triangle_faces=face[mesh.triangle_faces[triangles]],
        **chosen_of(mesh, OF_VERTICES, lambda mask: mask[vertices]),
        **chosen_of(mesh, OF_EDGES, lambda mask: mask[used_edges]),
        **chosen_of(mesh, OF_FACES, lambda mask: mask[faces]),
        corner_normals=None if normals is None else normals[corners],
    )


def _side_of(mesh: MeshArrays, patch: Patch, side: str) -> str:
    """Return where slopes come from in all of a drag.

    Hard edges of the boundary are looked for at its begin alone: in a step the faces inside are still where the last
    one has left them, so that the boundary looks like one.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        first = boundary(mesh, patch, side, outside_triangles(mesh, patch))
    return side if side != "AUTOMATIC" or first.from_inside.any() else "SURROUNDING"


class LiveRegion:
    """Answers for one region while its surroundings move. Knows nothing of Blender."""

    def __init__(self, mesh: MeshArrays, matrix: Floats, options: FairOptions) -> None:
        """Prepare for the patch of `mesh`; raises ValueError where it can't be faired."""
        self.options = options
        options = options.resolved(mesh.textured)
        mesh, self._lone = without_lone_pins(mesh, options)
        world = mesh.transformed(matrix)
        patch = make_patch(world, by_connectivity=not options.keeps_triangles)
        self._around = surroundings(mesh, patch)
        self._options = options
        self._image = mirror_map(mesh, patch) if mesh.mirror_x else None
        self.faces = np.flatnonzero(mesh.in_patch)  # of the mesh
        self._patch = patch  # in the numbers of the whole mesh, which refusals name
        self._reference = world.positions[patch.vertices]
        self._solve = RepeatedSolve(patch, options, self._reference)
        self._quick: RepeatedSolve | None = None
        self._start = world.positions[self._around.vertices]
        part = replace(self._around.mesh, positions=self._start)
        curve = faired_curves(part)[0] if options.fairs_pinned_edges else nothing()
        self._side = _side_of(part, self._around.patch, self._options.boundary_normals)
        pins = np.flatnonzero(self._lone[patch.vertices])
        moving = np.union1d(self._around.patch.free, np.searchsorted(self._around.patch.vertices, curve))
        self._moving = np.setdiff1d(moving, pins)

    @property
    def vertices(self) -> Ints:
        return self._around.vertices

    @property
    def free(self) -> Ints:
        """Mesh indices of the vertices that answers are for, ascending: those of edges that become fair, too."""
        free: Ints = self._around.vertices[self._around.patch.vertices[self._moving]]
        return free

    @property
    def boundary(self) -> Ints:
        patch = self._around.patch
        boundary: Ints = self._around.vertices[patch.vertices[patch.boundary]]
        return boundary

    def answer(self, positions: Floats, matrix: Floats, progress: Progress | None = None) -> Floats | None:
        """Return the free vertices' positions (k, 3) in the mesh's own coordinates; None where there is no convergence.

        positions: (n, 3) of `vertices`, in the mesh's own coordinates. Raises what engine.solve does.
        """
        problem = self._problem(positions, matrix)
        result = self._solve(problem, progress)
        return self._moved(problem, result.vertices, matrix) if result.converged else None

    def afresh(self, positions: Floats, matrix: Floats, progress: Progress | None = None) -> Floats | None:
        """Answer without what former answers left, as the operator would; the same contract."""
        self._solve = RepeatedSolve(self._patch, self._options, self._reference)
        return self.answer(positions, matrix, progress)

    def stand_in(self, positions: Floats, matrix: Floats, progress: Progress | None = None) -> Floats | None:
        """Return the surface of least variation where `answer` has none; the same contract. Takes a while."""
        options = replace(self._options, shape="LEAST_VARIATION", inner_fairness="UNIFORM", continuity="G1")
        problem = replace(self._problem(positions, matrix), curvatures=None)
        result = solve(problem, options, progress)
        return self._moved(problem, result.vertices, matrix) if result.converged else None

    def first(self, positions: Floats, matrix: Floats) -> Floats:
        """Return the surface (k, 3) that there always is, within milliseconds; the same contract, and never None.

        With a solver of its own: a search may be using the other one.
        """
        if self._quick is None:
            self._quick = RepeatedSolve(self._patch, self._options, self._reference)
        problem = self._problem(positions, matrix)
        return self._moved(problem, self._quick.first(problem), matrix)

    def _problem(self, positions: Floats, matrix: Floats) -> Problem:
        patch = self._around.patch
        with np.errstate(invalid="ignore", over="ignore"):
            world = replace(self._around.mesh, positions=positions).transformed(matrix)
            outside = outside_triangles(world, patch)
            known = boundary(world, patch, self._side, outside)
            points = self._posed(world)
        curvatures = known.curvatures if self._options.joins_curvature else None
        return Problem.of(self._patch, points, known.normals, curvatures)

    def _posed(self, world: MeshArrays) -> Floats:
        """Return the patch's points (p, 3) with edges that run through where they go."""
        points: Floats = world.positions[self._around.patch.vertices]
        if self._options.fairs_pinned_edges:
            curve, places = faired_curves(world, self._start)
            at = np.searchsorted(self._around.patch.vertices, curve)
            follows = np.isin(at, self._moving)
            points[at[follows]] = places[follows]
        return points

    def _moved(self, problem: Problem, points: Floats, matrix: Floats) -> Floats:
        """Return the vertices (k, 3) that move, in the mesh's own coordinates; points: (p, 3) in world space."""
        fair = to_local(pulled(problem, points, self._lone, self._options.pin_radius), matrix)
        if self._image is not None:
            fair = symmetrised(fair, self._image)
        moved: Floats = fair[self._moving]
        return moved


LEISURE = 3.0  # seconds of the processor for each of the two searches for an answer: other work is no reason to give up


@dataclass(frozen=True)
class Found:
    """How a search has ended."""

    positions: Floats | None = None  # (k, 3) of the region's free vertices; None: there is no surface
    stands_in: bool = False  # the surface of least variation instead of the one that was asked for


def sought(
    region: LiveRegion, positions: Floats, matrix: Floats, progress: Progress | None, seconds: float = LEISURE
) -> Found:
    """Search for the surface itself, then for the one that stands in for it, so many seconds each.

    positions: (n, 3) of region.vertices; matrix: (4, 4) to world space. Raises fairing.Cancelled where `progress` says
    so before either, and ValueError for what can't be faired.
    """
    for ask in (region.afresh, region.stand_in):
        go_on(progress)  # even to begin may take a while
        try:
            answer = ask(positions, matrix, _in_time(progress, time.thread_time() + seconds))
        except (fairing.Cancelled, fairing.SolverError):
            continue
        if answer is not None:
            return Found(answer, ask == region.stand_in)
    return Found()


def _in_time(progress: Progress | None, end: float) -> Progress:
    return lambda part, stage: (progress is None or progress(part, stage) is not False) and time.thread_time() < end
