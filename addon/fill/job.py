"""The surfaces of one run of Fair Fill. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.around import RINGS, Neighbourhood
from ..arrays.border import BorderRefusal
from ..arrays.places import no_pairs, numbers_in
from ..arrays.region import MeshArrays, to_local
from ..arrays.types import Floats, Ints
from ..fair.engine import Progress
from ..options.other_options import FillOptions
from ..remesh.key_surface import Surroundings
from ..verdict.quality import join_at
from ..verdict.verdict import UNUSABLE, Verdict
from ..words.findings import Origin
from ..words.sentences import in_mesh_words, sentences
from ..words.words import said
from .across import Loose, Numbering, drawn_edges, marked_edges, numbered_by_pass, renumbered, within
from .pieces import Piece
from .verdict import judge, measured

_SEEN = 11  # rings around a hole that the engine looks at: slopes, and what is usual around hard edges
_TOLD = ("NO_SOLUTION", "NOT_TANGENT", "EDGES_LEFT_ALONE", "NO_QUAD_ROWS")


@dataclass(frozen=True)
class Job:
    """The surfaces of one run, in world space."""

    world: MeshArrays
    matrix: Floats
    options: FillOptions
    near: Neighbourhood
    loose: Loose

    @classmethod
    def of(cls, mesh: MeshArrays, matrix: Floats, options: FillOptions) -> Job:
        """Begin with a mesh in its own coordinates."""
        world = mesh.transformed(matrix)
        return cls(world, matrix, options, Neighbourhood(world.positions, world.triangles), Loose.of(world))

    def piece(self, loops: list[Ints], progress: Progress | None) -> Piece:
        """Make one surface, over a loop or between several."""
        boundary = np.concatenate(loops)
        local = self._local(boundary, _SEEN)
        with _joining(self.options, boundary, len(loops)), in_mesh_words(local.origin):
            result = self.filled(local, loops, progress)
        return self._made(loops, result, local.vertices)

    def together(self, groups: list[list[Ints]], progress: Progress | None) -> dict[int, Piece]:
        """Make those over lone loops in one call, by the groups' numbers; none of one that has no surface."""
        if self.options.bridge or self.options.spacing != 1.0 or len(groups) < 2:
            return {}
        lone = [loop for (loop,) in groups]
        local = self._local(np.concatenate(lone), _SEEN)
        try:
            result = self.filled(local, lone, progress)
        except (fairing.MeshError, fairing.SolverError):
            return {}  # each by itself tells why
        found = {frozenset(hole.loops[0].tolist()): hole.surface for hole in result.holes}
        surfaces = {k: found.get(frozenset(local.numbers(loop).tolist())) for k, loop in enumerate(lone)}
        return {k: self._made([lone[k]], own, local.vertices) for k, own in surfaces.items() if own is not None}

    def _local(self, boundary: Ints, rings: int = RINGS) -> Local:
        """Return what is around a boundary, with edges that are drawn across."""
        drawn = drawn_edges(self.loose, boundary) if self.options.runs_on and len(self.loose.edges) else no_pairs()
        around = self.near.around(np.unique(boundary), rings)
        vertices = np.unique(np.concatenate([boundary, around.ravel(), drawn.ravel()]))
        return Local(vertices, np.searchsorted(vertices, around), within(drawn, vertices))

    def filled(self, local: Local, loops: list[Ints], progress: Progress | None) -> fairing.FillResult:
        options = self.options
        surface = fairing.Surface(options.equation, continuity="G2" if options.joins_curvature else "G1")
        return fairing.fill(
            self.world.positions[local.vertices], local.around, [local.numbers(loop) for loop in loops],
            fairing.Options(surface), bridge=options.bridge,
            spacing=_spacing(self.world, loops, options), inner="outline",
            faces="quads" if options.quads else "triangles",
            edges="run_on" if options.run_on else "ignored", wires=local.drawn,
            marked=within(marked_edges(self.world), local.vertices), progress=progress,
        )  # fmt: skip

    def _made(self, loops: list[Ints], found: fairing.FillResult, named: Ints) -> Piece:
        """named: the mesh vertices that the engine was given."""
        world, boundary = self.world, np.concatenate(loops)
        local = self._local(boundary)
        vertices, around = local.vertices, local.around
        result = renumbered(found, named, vertices)
        number = Numbering.made(boundary, vertices, result)
        given = [local.numbers(loop) for loop in loops]
        triangles = numbered_by_pass(number.of[result.triangles], result.triangles.astype(np.int64), given)
        inside = number.places(world.positions, result.vertices)
        points = np.concatenate([world.positions[boundary], inside])
        across = number.across(result, local.drawn)
        held = np.union1d(np.arange(len(boundary)), across.edges)
        seen = measured(world, boundary, points, triangles, held)
        join = join_at(np.unique(boundary), seen.join)
        slopes = tuple(warning for warning in result.warnings if warning.code == "G2_NOT_MET")
        verdict = judge(boundary, result, join, seen)
        return Piece(
            loops=tuple(loops),
            points=points,
            positions=to_local(inside, self.matrix),
            triangles=triangles[:, ::-1] if world.mirrored else triangles,
            verdict=_advised(verdict, self.options, len(loops)),
            result=result,
            join=join,
            around=_keyed_from(vertices, around, boundary, self.matrix),
            quads=self.options.quads,
            rows=self.options.quads and not any(warning.code == "NO_QUAD_ROWS" for warning in result.warnings),
            notes=_notes(result, slopes, local.origin),
            across=across,
        )


@dataclass(frozen=True)
class Local:
    """The (q,) mesh vertices of some boundaries and of what is around them, ascending."""

    vertices: Ints
    around: Ints  # (o, 3) triangles, in numbers of these
    drawn: Ints  # (w, 2) edges that are drawn across, likewise

    def numbers(self, vertices: Ints) -> Ints:
        found: Ints = np.searchsorted(self.vertices, vertices)
        return found

    @property
    def origin(self) -> Origin:
        return Origin(self.vertices, self.around, np.zeros(len(self.around), np.int64))


def _keyed_from(vertices: Ints, around: Ints, boundary: Ints, matrix: Floats) -> Surroundings:
    """Return the surroundings with the boundary first; around: triangles in numbers of `vertices`."""
    others = np.setdiff1d(vertices, boundary)
    order = np.concatenate([boundary, others])
    return Surroundings(order, numbers_in(np.searchsorted(vertices, order), len(vertices))[around], matrix)


def _spacing(world: MeshArrays, loops: list[Ints], options: FillOptions) -> float:
    """Return the wanted length; 0, which stands for that of the boundary's edges, for a factor of 1."""
    if options.spacing == 1.0:
        return 0.0
    edges = [world.positions[np.roll(loop, -1)] - world.positions[loop] for loop in loops]
    return options.spacing * float(np.linalg.norm(np.concatenate(edges), axis=1).mean())


def _notes(result: fairing.FillResult, slopes: tuple[fairing.Diagnostic, ...], origin: Origin) -> tuple[str, ...]:
    """Report what stands in for the surface asked for, and where its curvature is not continued."""
    warnings = [warning for warning in result.warnings if warning.code in _TOLD]
    known = [replace(each, elements=each.elements[each.elements < len(origin.vertices)]) for each in warnings]
    return sentences((*known, *slopes), origin)


def _advised(verdict: Verdict, options: FillOptions, loops: int) -> Verdict:
    """Return the verdict with what to do about it where too many boundary loops were joined."""
    if verdict.grade != UNUSABLE or not options.bridge or loops < 3:
        return verdict
    return replace(verdict, reason=said("and_advice", reason=verdict.reason, advice=joining_advice(loops)))


def joining_advice(loops: int) -> str:
    """Return what to do where so many boundary loops were not joined."""
    return said("bridge_many", n=loops) if loops > 2 else said("bridge_two")


@contextmanager
def _joining(options: FillOptions, boundary: Ints, loops: int) -> Iterator[None]:
    """Let the engine's MeshErrors say what to do about boundary loops that no surface joins."""
    try:
        yield
    except fairing.MeshError as error:
        tells_why = {"turned", "between", "one_way"} & error.diagnostic.figures.keys()
        if error.code != "LOOPS_NOT_JOINED" or (loops == 2 and tells_why):
            raise
        raise BorderRefusal(said("not_joined", advice=joining_advice(loops)), boundary) from error
