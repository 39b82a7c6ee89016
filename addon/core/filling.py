"""From border loops to the surface over them. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

import fairing

from .across import HARD_EDGES, Across, Numbering, drawn_edges, marked_edges, within
from .around import nearby
from .arrays import Floats, Ints
from .border import BorderRefusal
from .checked import refuse_negative, refuse_other_kinds, refuse_unknown
from .engine import Progress, sub_range
from .faces import Faces, faces_of, paired_faces
from .fill_verdict import Surface, judge
from .findings import Origin
from .harmonic import harmonic, nearest
from .key_surface import NewSurface, Surroundings, key_surfaces
from .options import ACCEPT, CONTINUITIES, INNER, LEAST_SPACING, OF_CURVATURE
from .quality import Join, join_at
from .region import MeshArrays, nothing, to_local
from .verdict import UNUSABLE, Verdict
from .words import in_mesh_words, sentences

_TOO_MANY = "Bridge joins all {} selected boundary loops in one surface: select only those that belong together"
_TWO = "Bridge needs two boundary loops that face each other: switch it off to close each of them by itself"
_TOLD = ("NO_SOLUTION", "NOT_TANGENT", "EDGES_LEFT_ALONE")
SHAPES = ("AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY", "LEAST_VARIATION")


@dataclass(frozen=True)
class FillOptions:
    """The properties of `mesh.fair_fill`.

    Raises ValueError for a value it does not know, TypeError for one of another kind.
    """

    equation: str = "AUTOMATIC"
    continuity: str = "G1"  # G2: the curvature around is continued, too
    bridge: bool = False  # all loops of an object are joined
    hard_edges: str = "RUN_ON"  # those that end at a hole go on through it, as edges drawn across it do; IGNORED
    spacing: float = 1.0  # of new edges, as a factor of the boundary's
    inner: str = "OUTLINE"  # in proportion to the boundary's nearby; EVEN: of one length
    quads: bool = False  # triangles are written in pairs, as far as they can be
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
        refuse_negative(self, "max_vertices")
        refuse_negative(self, "limit_total")

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
    across: Across = field(default_factory=Across)  # what runs across it; drawn vertices come first among the k

    def faces(self, kinds: Ints, lines: Ints) -> Faces:
        """Return what is written; kinds: (m,) of the triangles, only those of one kind are paired.

        lines: (l, 2) edges that no quad runs across.
        """
        if not self.quads:
            return faces_of(self.triangles)
        return paired_faces(self.points, self.triangles, np.concatenate([lines, self.across.edges]), kinds)

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
        return harmonic(self.points, self.triangles, values)

    def keyed(self, places: list[Floats], carried: list[Floats]) -> list[Floats | None]:
        """Return (k, 3) for each shape key: where it has the new vertices, see core.key_surface.

        None where curves run across the surface: there they stay where they are carried.
        """
        if self.across.holds_any:
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
        for tail, head in ((0, 1), (1, 2), (2, 0)):
            at_edge = following[self.triangles[:, tail]] == self.triangles[:, head]
            of_face[at_edge] = self.triangles[at_edge, tail]
        return near[rim:], of_face


def fill(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None = None
) -> list[Piece]:
    """Fill each loop of border_loops, or join all of them, in the space that the 4×4 `matrix` leads to.

    Raises MeshRefusal, ValueError, fairing.SolverError and fairing.Cancelled. `mesh` is never changed.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        world = mesh.transformed(matrix)
    groups = [loops] if options.bridge else [[loop] for loop in loops]
    count = len(groups)
    return [
        _piece(world, matrix, group, options, sub_range(progress, i / count, (i + 1) / count))
        for i, group in enumerate(groups)
    ]


def _piece(
    world: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None
) -> Piece:
    outline = np.concatenate(loops)
    runs_on = options.hard_edges == "RUN_ON" and not options.bridge
    drawn = drawn_edges(world, outline) if runs_on else np.empty((0, 2), np.int64)
    vertices, around = _surroundings(world, outline, drawn)
    given = [np.searchsorted(vertices, loop) for loop in loops]
    origin = Origin(vertices, around, np.zeros(len(around), np.int64))
    with _joining(options, outline, len(loops)), in_mesh_words(origin):
        result = fairing.fill(
            world.positions[vertices], around, given, bridge=options.bridge, spacing=_spacing(world, loops, options),
            inner=options.inner.lower(), equation=options.equation.lower(),
            continuity="G2" if options.joins_curvature else "G1", max_vertices=options.max_vertices,
            edges=options.hard_edges.lower(), wires=within(drawn, vertices),
            marked=within(marked_edges(world), vertices), progress=progress,
        )  # fmt: skip
    number = Numbering.made(outline, vertices, result)
    triangles = number.of[result.triangles]
    inside = number.places(world.positions, result.vertices)
    points = np.concatenate([world.positions[outline], inside])
    whole = np.concatenate([world.positions[vertices], result.vertices])
    rim = np.concatenate(given)
    join = join_at(outline, fairing.visible_join(whole, result.triangles, around, rim))
    across = number.across(result, within(drawn, vertices))
    slopes = tuple(warning for warning in result.warnings if warning.code == "G2_NOT_MET")
    tangent_only = np.unique(np.concatenate([nothing(), *(vertices[warning.elements] for warning in slopes)]))
    verdict = judge(world, outline, Surface(points, triangles, result, join, tangent_only, across.edges))
    return Piece(
        loops=tuple(loops),
        points=points,
        positions=to_local(inside, matrix),
        triangles=triangles[:, ::-1] if world.mirrored else triangles,
        verdict=_advised(verdict, options, len(loops)),
        result=result,
        join=join,
        around=_keyed_from(vertices, around, outline, matrix),
        quads=options.quads,
        limit_total=options.limit_total,
        notes=_notes(result, slopes, origin),
        across=across,
    )


def _surroundings(world: MeshArrays, outline: Ints, drawn: Ints) -> tuple[Ints, Ints]:
    """Return the (q,) mesh vertices of the boundary, of the triangles around it and of drawn edges (w, 2), and these
    triangles, in their numbers."""
    finite = np.isfinite(world.positions).all(axis=1)
    start = np.zeros(len(finite), dtype=bool)
    start[outline] = True
    around = nearby(world.triangles[finite[world.triangles].all(axis=1)], start)
    vertices = np.unique(np.concatenate([outline, around.ravel(), drawn.ravel()]))
    return vertices, np.searchsorted(vertices, around)


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
