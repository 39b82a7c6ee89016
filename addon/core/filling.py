"""From border loops to the surface over them. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

import fairing

from .across import HARD_EDGES, Across, Loose, Numbering, drawn_edges, marked_edges, within
from .arrays import Floats, Ints
from .border import BorderRefusal, Left, left_by
from .checked import refuse_negative, refuse_other_kinds, refuse_unknown
from .doubled import doubled_places, doubled_triangles
from .engine import Progress, sub_range
from .faces import Faces, faces_of, paired_faces
from .fill_verdict import Surface, judge
from .findings import Origin
from .half_surface import half_surface
from .halves import Half, symmetric_half
from .harmonic import carried_over_half, harmonic, nearest
from .islands import with_islands
from .key_surface import NewSurface, Surroundings, key_surfaces
from .neighbourhood import Neighbourhood
from .options import ACCEPT, CONTINUITIES, INNER, LEAST_SPACING, OF_CURVATURE
from .parted import parted, stars_of
from .passes import numbered_by_pass
from .quality import Join, join_at
from .region import MeshArrays, nothing, to_local
from .verdict import UNUSABLE, Verdict
from .words import in_mesh_words, sentences

_TOO_MANY = "Bridge joins all {} selected boundary loops in one surface: select only those that belong together"
_TWO = "Bridge needs two boundary loops that face each other: switch it off to close each of them by itself"
SMALL = 8  # edges of loops that are filled in one call, as most of them take a fan; see fairing's _hub.py
SHAPES = ("AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY", "MINIMAL", "LEAST_VARIATION")
_TOLD = ("NO_SOLUTION", "NOT_TANGENT", "EDGES_LEFT_ALONE")


@dataclass(frozen=True)
class FillOptions:
    """The properties of `mesh.fair_fill`.

    Raises ValueError for a value it does not know, TypeError for one of another kind.
    """

    equation: str = "AUTOMATIC"
    continuity: str = "G1"  # G2: the curvature around is continued, too
    bridge: bool = False  # all loops of an object are joined
    islands: bool = False  # loose pieces of faces inside a hole are joined with it
    hard_edges: str = "RUN_ON"  # those that end at a hole go on through it, as edges drawn across it do; IGNORED
    spacing: float = 1.0  # of new edges, as a factor of the boundary's
    inner: str = "OUTLINE"  # in proportion to the boundary's nearby; EVEN: of one length
    quads: bool = False  # triangles are written in pairs, as far as they can be
    longest: int = 0  # edges: longer borders stay open; 0: any number
    longest_length: float = 0.0  # likewise by their lengths in world space
    max_vertices: int = 0  # more new ones for a surface are refused; 0: twenty times as many as over flat ones
    limit_total: int = 0  # vertex groups of bones of a new vertex; 0: as many as one vertex of the boundary has
    accept: str = "USABLE"  # ALL: written whatever it is worth

    def __post_init__(self) -> None:
        if self.equation not in SHAPES:
            raise ValueError(f"equation: expected one of {', '.join(SHAPES)}, got {self.equation!r}")
        if self.continuity not in CONTINUITIES:
            raise ValueError(f"continuity: expected one of {', '.join(CONTINUITIES)}, got {self.continuity!r}")
        if self.inner not in INNER:
            raise ValueError(f"inner: expected one of {', '.join(INNER)}, got {self.inner!r}")
        if self.hard_edges not in HARD_EDGES:
            raise ValueError(f"hard_edges: expected one of {', '.join(HARD_EDGES)}, got {self.hard_edges!r}")
        if self.accept not in ACCEPT:
            raise ValueError(f"accept: expected one of {', '.join(ACCEPT)}, got {self.accept!r}")
        refuse_other_kinds(self)
        if not self.spacing >= LEAST_SPACING:
            raise ValueError(f"spacing: expected {LEAST_SPACING} or more, got {self.spacing!r}")
        for name in ("longest", "max_vertices", "limit_total"):
            refuse_negative(self, name)
        if not 0.0 <= self.longest_length < float("inf"):
            raise ValueError(f"longest_length: expected 0 or a positive number, got {self.longest_length!r}")

    @classmethod
    def named(cls, properties: dict[str, Any]) -> FillOptions:
        """Read options from a caller's keyword arguments; raises TypeError for one that does not exist."""
        refuse_unknown((each.name for each in fields(cls)), properties)
        return cls(**properties)

    @classmethod
    def of(cls, properties: Any) -> FillOptions:
        """Read every option from an object with attributes of the same names."""
        return cls(**{each.name: getattr(properties, each.name) for each in fields(cls)})

    @property
    def joins_curvature(self) -> bool:
        """Whether the curvature around counts: only for the harmonic shape."""
        return self.continuity == "G2" and self.equation in OF_CURVATURE


@dataclass(frozen=True)
class Piece:
    """One surface, over a loop or between several: r boundary vertices, k new ones."""

    loops: tuple[Ints, ...]  # mesh vertices, each loop with the surface on its left
    points: Floats  # (r + k, 3) in world space, the boundary's first, loop after loop
    positions: Floats  # (k, 3) of the new vertices, in the mesh's own coordinates
    triangles: Ints  # (m, 3) in numbers of `points`, wound like the mesh
    verdict: Verdict
    result: fairing.FillResult
    join: Join
    around: Surroundings
    quads: bool = False  # whether triangles are written in pairs
    limit_total: int = 0  # as FillOptions has it
    notes: tuple[str, ...] = field(default=())
    on_plane: Ints = field(default_factory=nothing)  # points that close a boundary which is a chain: see core.halves
    across: Across = field(default_factory=Across)  # what runs across it; drawn vertices come first among the k

    def faces(self, kinds: Ints, lines: Ints) -> Faces:
        """Return what is written; kinds: (m,) of the triangles, only those of one kind are paired.

        lines: (l, 2) edges that no quad runs across.
        """
        closes_at_once = not len(self.positions) and len(self.triangles) == 2
        if not (self.quads or closes_at_once):
            return faces_of(self.triangles)
        return paired_faces(self.points, self.triangles, np.concatenate([lines, self.across.edges]), kinds)

    @property
    def is_open(self) -> bool:
        """Whether it is half of a surface, whose boundary is a chain."""
        return len(self.on_plane) > 0

    @property
    def outline(self) -> Ints:
        """The (r,) mesh vertices around it."""
        return np.concatenate(self.loops)

    @property
    def rims(self) -> tuple[Ints, ...]:
        """Each loop as numbers of `points`."""
        return tuple(np.split(np.arange(len(self.outline)), np.cumsum([len(loop) for loop in self.loops])[:-1]))

    @property
    def following(self) -> Ints:
        """For each of the r boundary vertices the next one, as numbers of `points`."""
        return np.concatenate([np.roll(rim, -1) for rim in self.rims])

    def carried(self, values: Floats) -> Floats:
        """Return (k, c): values (r, c) of the boundary at the new vertices."""
        if self.is_open:
            return carried_over_half(self.points, self.triangles, values, self.on_plane)
        return harmonic(self.points, self.triangles, values)

    def keyed(self, places: list[Floats], carried: list[Floats]) -> list[Floats | None]:
        """Return (k, 3) for each shape key: where it has the new vertices, see core.key_surface.

        None where curves run across the surface, and over halves: there they stay where they are carried.
        """
        if len(self.across.edges) or self.is_open:
            return [None] * len(places)
        mirrored = np.linalg.det(self.around.matrix[:3, :3]) < 0.0
        triangles = self.triangles[:, ::-1] if mirrored else self.triangles
        return key_surfaces(NewSurface(self.points, triangles, self.result.equation), self.around, places, carried)

    def examples(self) -> tuple[Ints, Ints]:
        """Return (k,) and (m,): boundary vertices whose data new vertices and new faces take, for what has no mean.

        That of a face stands for the edge from there to the next one: at the boundary it is the face's own.
        """
        rim = len(self.outline)
        near = nearest(self.triangles, len(self.points), rim)
        of_face = near[self.triangles[:, 0]]
        following = np.append(self.following, np.full(len(self.points) - rim, -1))
        following[rim - 1] = -1 if self.is_open else following[rim - 1]
        for tail, head in ((0, 1), (1, 2), (2, 0)):
            at_edge = following[self.triangles[:, tail]] == self.triangles[:, head]
            of_face[at_edge] = self.triangles[at_edge, tail]
        return near[rim:], of_face


@dataclass(frozen=True)
class Filled:
    """The surfaces of one mesh, and the holes that can't be filled."""

    pieces: list[Piece]
    left: tuple[Left, ...] = ()

    @property
    def left_vertices(self) -> Ints:
        """The vertices of the holes that stay open, ascending."""
        vertices: Ints = np.unique(np.concatenate([nothing(), *(each.vertices for each in self.left)]))
        return vertices

    def with_left(self, left: tuple[Left, ...]) -> Filled:
        """Return it with more holes that stay open, before its own."""
        return replace(self, left=(*left, *self.left))

    def unfilled(self) -> Filled:
        """Return it without any surface."""
        left = (Left(np.unique(piece.outline), piece.verdict.reason, piece.verdict.spots) for piece in self.pieces)
        return Filled([], (*self.left, *left))

    def settled(self, options: FillOptions) -> Filled:
        """Return what is to be written: surfaces that are not usable are left out where others are."""
        usable = [piece for piece in self.pieces if piece.verdict.grade != UNUSABLE]
        if options.accept == "ALL" or not usable or len(usable) == len(self.pieces):
            return self
        bad = Filled([piece for piece in self.pieces if piece.verdict.grade == UNUSABLE])
        return Filled(usable, (*self.left, *bad.unfilled().left))


def fill(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None = None,
    halves: Sequence[Half] = (),
) -> Filled:  # fmt: skip
    """Fill each loop of border_loops, or join all of them, in the space that the 4×4 `matrix` leads to; and halves.

    What is wrong with one loop stops no other. Raises the first MeshRefusal, BorderRefusal or fairing.SolverError where
    there is no surface at all; ValueError and fairing.Cancelled. `mesh` is never changed.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        job = Job.of(mesh, matrix, options)
    groups = _groups(job.world, loops, options)
    made = job.small(groups)
    pieces, errors, left = [], [], []
    count = len(groups) + len(halves)
    for i in range(count):
        part = sub_range(progress, i / count, (i + 1) / count)
        vertices = np.concatenate(groups[i]) if i < len(groups) else halves[i - len(groups)].chain
        try:
            if i < len(groups):
                pieces.append(made[i] if i in made else job.whole(mesh, groups[i], part))
            else:
                pieces.append(job.half(mesh, halves[i - len(groups)], part))
        except (ValueError, fairing.SolverError) as error:
            errors.append(error)
            left.append(left_by(error, np.unique(vertices)))
    if errors and not pieces:
        raise errors[0]
    return Filled(pieces, tuple(left)).settled(options)


def _groups(world: MeshArrays, loops: list[Ints], options: FillOptions) -> list[list[Ints]]:
    """Return the loops that one surface joins each."""
    if options.bridge or not options.islands:
        return [loops] if options.bridge else [[loop] for loop in loops]
    return [[loops[k] for k in numbers] for numbers in with_islands(world, loops)]


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

    def over(self, mesh: MeshArrays, spacing: float) -> Job:
        """Return the same over another mesh, with other edges."""
        return Job.of(mesh, self.matrix, replace(self.options, spacing=spacing))

    def half(self, mesh: MeshArrays, half: Half, progress: Progress | None) -> Piece:
        """Make the surface over half of a hole; mesh: in its own coordinates."""
        found, local = half_surface(self, mesh, half, progress), self.local(half.chain)
        triangles = found.surface.triangles
        return Piece(
            loops=(half.chain,),
            points=found.surface.points,
            positions=found.positions,
            triangles=triangles[:, ::-1] if self.world.mirrored else triangles,
            verdict=found.verdict,
            result=found.surface.result,
            join=found.surface.join,
            around=_keyed_from(local.vertices, local.around, half.chain, self.matrix),
            quads=self.options.quads,
            limit_total=self.options.limit_total,
            on_plane=found.on_plane,
        )

    def whole(self, mesh: MeshArrays, loops: list[Ints], progress: Progress | None) -> Piece:
        """Make one surface, symmetric where the mesh asks for it and the boundary is; mesh: in its own coordinates."""
        half = symmetric_half(mesh, loops[0]) if mesh.mirror_x and len(loops) == 1 else None
        if half is not None:
            try:
                return self.symmetric(mesh, half, progress)
            except (ValueError, fairing.SolverError):
                pass  # the hole may have a surface all the same, which tells why where it has none
        return self.piece(loops, progress)

    def symmetric(self, mesh: MeshArrays, half: Half, progress: Progress | None) -> Piece:
        """Make a surface that is symmetric to the last bit; mesh: in its own coordinates."""
        found = half_surface(self, mesh, half, progress)
        on = len(found.on_plane) - 2
        _, loop = half.whole(mesh)
        positions = doubled_places(found.positions, on)
        inside = positions @ self.matrix[:3, :3].T + self.matrix[:3, 3]
        triangles = doubled_triangles(found.surface.triangles, len(half.chain), on)
        local, world = self.local(loop), self.world
        points = np.concatenate([world.positions[loop], inside])
        rim = local.numbers(loop)
        joined = np.concatenate([world.positions[local.vertices], inside])
        numbers = np.concatenate([rim, len(local.vertices) + np.arange(len(inside))])
        at = np.sort(rim)
        join = join_at(local.vertices[at], fairing.visible_join(joined, numbers[triangles], local.around, at))
        surface = Surface(points, triangles, found.surface.result, join, nothing())
        return Piece(
            loops=(loop,),
            points=points,
            positions=positions,
            triangles=triangles[:, ::-1] if world.mirrored else triangles,
            verdict=judge(world, loop, surface, local.vertices[local.around]),
            result=surface.result,
            join=join,
            around=_keyed_from(local.vertices, local.around, loop, self.matrix),
            quads=self.options.quads,
            limit_total=self.options.limit_total,
        )

    def piece(self, loops: list[Ints], progress: Progress | None) -> Piece:
        """Make one surface, over a loop or between several."""
        outline = np.concatenate(loops)
        local = self.local(outline, self._drawn(outline))
        with _joining(self.options, outline, len(loops)), in_mesh_words(local.origin):
            result = self.filled(local, loops, progress, self.options.bridge or len(loops) > 1)
        return self._made(local, loops, result)

    def small(self, groups: list[list[Ints]]) -> dict[int, Piece]:
        """Make those over small loops in one call, by the groups' numbers; none where anything is wrong with one."""
        loops = {k: group[0] for k, group in enumerate(groups) if len(group) == 1}
        few = [k for k, loop in loops.items() if len(loop) <= SMALL and len(np.unique(loop)) == len(loop)]
        few = [k for k in few if not len(self._drawn(loops[k]))]
        if self.options.bridge or self.options.spacing != 1.0 or len(few) < 2:
            return {}
        chosen = [loops[k] for k in few]
        whole = self.local(np.unique(np.concatenate(chosen)), _no_edges())
        try:
            result = self.filled(whole, chosen, None)
        except (fairing.MeshError, fairing.SolverError):
            return {}  # each by itself tells why
        made, stars = {}, stars_of(result)
        for k, loop in zip(few, chosen, strict=True):
            local = self.local(loop, _no_edges())
            own = parted(result, stars, whole.numbers(loop), (whole.vertices, local.vertices))
            if own is not None:
                made[k] = self._made(local, [loop], own)
        return made

    def _drawn(self, outline: Ints) -> Ints:
        """Return the (w, 2) edges that are drawn across a hole."""
        runs_on = self.options.hard_edges == "RUN_ON" and not self.options.bridge
        return drawn_edges(self.loose, outline) if runs_on and len(self.loose.edges) else _no_edges()

    def local(self, outline: Ints, drawn: Ints | None = None) -> Local:
        drawn = _no_edges() if drawn is None else drawn
        around = self.near.around(np.unique(outline))
        vertices = np.unique(np.concatenate([outline, around.ravel(), drawn.ravel()]))
        return Local(vertices, np.searchsorted(vertices, around), within(drawn, vertices))

    def filled(
        self, local: Local, loops: list[Ints], progress: Progress | None, bridge: bool = False
    ) -> fairing.FillResult:
        options = self.options
        return fairing.fill(
            self.world.positions[local.vertices], local.around, [local.numbers(loop) for loop in loops],
            bridge=bridge, spacing=_spacing(self.world, loops, options), inner=options.inner.lower(),
            equation=options.equation.lower(), continuity="G2" if options.joins_curvature else "G1",
            max_vertices=options.max_vertices, edges=options.hard_edges.lower(), wires=local.drawn,
            marked=within(marked_edges(self.world), local.vertices), progress=progress,
        )  # fmt: skip

    def _made(self, local: Local, loops: list[Ints], result: fairing.FillResult) -> Piece:
        world, vertices, around, outline = self.world, local.vertices, local.around, np.concatenate(loops)
        number = Numbering.made(outline, vertices, result)
        given = [local.numbers(loop) for loop in loops]
        triangles = numbered_by_pass(number.of[result.triangles], result.triangles.astype(np.int64), given)
        inside = number.places(world.positions, result.vertices)
        points = np.concatenate([world.positions[outline], inside])
        whole = np.concatenate([world.positions[vertices], result.vertices])
        rim = np.unique(np.concatenate(given))
        join = join_at(vertices[rim], fairing.visible_join(whole, result.triangles, around, rim))
        across = number.across(result, local.drawn)
        slopes = tuple(warning for warning in result.warnings if warning.code == "G2_NOT_MET")
        tangent_only = np.unique(np.concatenate([nothing(), *(vertices[warning.elements] for warning in slopes)]))
        surface = Surface(points, triangles, result, join, tangent_only, across.edges)
        verdict = judge(world, outline, surface, vertices[around])
        return Piece(
            loops=tuple(loops),
            points=points,
            positions=to_local(inside, self.matrix),
            triangles=triangles[:, ::-1] if world.mirrored else triangles,
            verdict=_advised(verdict, self.options, len(loops)),
            result=result,
            join=join,
            around=_keyed_from(vertices, around, outline, self.matrix),
            quads=self.options.quads,
            limit_total=self.options.limit_total,
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
        """Return mesh vertices in local numbers."""
        found: Ints = np.searchsorted(self.vertices, vertices)
        return found

    @property
    def origin(self) -> Origin:
        """Where they are in the mesh."""
        return Origin(self.vertices, self.around, np.zeros(len(self.around), np.int64))


def _no_edges() -> Ints:
    return np.empty((0, 2), dtype=np.int64)


def _keyed_from(vertices: Ints, around: Ints, outline: Ints, matrix: Floats) -> Surroundings:
    """Return the surroundings with the boundary first; around: triangles in numbers of `vertices`."""
    others = np.setdiff1d(vertices, outline)
    order = np.concatenate([outline, others])
    number = np.empty(len(vertices), dtype=np.int64)
    number[np.searchsorted(vertices, order)] = np.arange(len(order))
    return Surroundings(order, number[around], matrix)


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
    return replace(verdict, reason=f"{verdict.reason}. {joining_advice(loops)}")


def joining_advice(loops: int) -> str:
    """Return what to do where so many boundary loops were not joined."""
    return _TOO_MANY.format(loops) if loops > 2 else _TWO


@contextmanager
def _joining(options: FillOptions, outline: Ints, loops: int) -> Iterator[None]:
    """Let the engine's MeshErrors say what to do about boundary loops that no surface joins."""
    try:
        yield
    except fairing.MeshError as error:
        tells_why = {"turned", "between"} & error.diagnostic.figures.keys()
        if error.code != "LOOPS_NOT_JOINED" or (loops == 2 and tells_why):
            raise
        raise BorderRefusal(f"No surface joins these boundary loops. {joining_advice(loops)}", outline) from error
