"""From border loops to the surface over them, and what it is worth. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

import fairing

from .around import nearby
from .arrays import Floats, Ints
from .border import BorderRefusal
from .checked import refuse_other_kinds, refuse_unknown
from .engine import Progress, sub_range
from .faces import Faces, faces_of, paired_faces
from .findings import Origin
from .harmonic import harmonic, nearest
from .options import ACCEPT, LEAST_SPACING
from .quality import VISIBLE
from .region import MeshArrays, to_local
from .verdict import GOOD, LOFT_REASON, LOOK, UNUSABLE, Verdict
from .words import counted, in_mesh_words

_TOO_MANY = "Bridge joins all {} selected outlines in one surface: select only those that belong together"
SHAPES = ("HARMONIC", "MINIMAL_ENERGY", "LEAST_VARIATION")


@dataclass(frozen=True)
class FillOptions:
    """The properties of `mesh.fair_fill`.

    Raises ValueError for a value it does not know, TypeError for one of another kind.
    """

    equation: str = "HARMONIC"
    bridge: bool = False  # all loops of an object are joined
    spacing: float = 1.0  # of new edges, as a factor of the outline's
    quads: bool = False  # triangles are written in pairs, as far as they can be
    accept: str = "USABLE"  # ALL: written whatever it is worth

    def __post_init__(self) -> None:
        if self.equation not in SHAPES:
            raise ValueError(f"equation: expected one of {', '.join(SHAPES)}, got {self.equation!r}")
        if self.accept not in ACCEPT:
            raise ValueError(f"accept: expected one of {', '.join(ACCEPT)}, got {self.accept!r}")
        refuse_other_kinds(self)
        if not self.spacing >= LEAST_SPACING:
            raise ValueError(f"spacing: expected {LEAST_SPACING} or more, got {self.spacing!r}")

    @classmethod
    def named(cls, properties: dict[str, Any]) -> FillOptions:
        """Read options from a caller's keyword arguments; raises TypeError for one that does not exist."""
        refuse_unknown((each.name for each in fields(cls)), properties)
        return cls(**properties)

    @classmethod
    def of(cls, properties: Any) -> FillOptions:
        """Read every option from an object with attributes of the same names."""
        return cls(**{each.name: getattr(properties, each.name) for each in fields(cls)})


@dataclass(frozen=True)
class Piece:
    """One surface, over a loop or between several: r outline vertices, k new ones."""

    loops: tuple[Ints, ...]  # mesh vertices, each loop with the surface on its left
    points: Floats  # (r + k, 3) in world space, the outline's first, loop after loop
    positions: Floats  # (k, 3) of the new vertices, in the mesh's own coordinates
    triangles: Ints  # (m, 3) in numbers of `points`, wound like the mesh
    verdict: Verdict
    result: fairing.FillResult
    quads: bool = False  # whether triangles are written in pairs
    notes: tuple[str, ...] = field(default=())

    def faces(self, kinds: Ints) -> Faces:
        """Return what is written; kinds: (m,) of the triangles, only those of one kind are paired."""
        if not self.quads:
            return faces_of(self.triangles)
        return paired_faces(self.points, self.triangles, np.empty((0, 2), dtype=np.int64), kinds)

    @property
    def outline(self) -> Ints:
        """The (r,) mesh vertices around it."""
        return np.concatenate(self.loops)

    @property
    def following(self) -> Ints:
        """For each of the r outline vertices the next one, as numbers of `points`."""
        numbers = np.split(np.arange(len(self.outline)), np.cumsum([len(loop) for loop in self.loops])[:-1])
        return np.concatenate([np.roll(part, -1) for part in numbers])

    def carried(self, values: Floats) -> Floats:
        """Return (k, c): values (r, c) of the outline at the new vertices."""
        return harmonic(self.points, self.triangles, values)

    def examples(self) -> tuple[Ints, Ints]:
        """Return (k,) and (m,): the outline vertex whose data a new vertex takes, and a new face, for what has no mean.

        That of a face stands for the edge from there to the next one: at the outline it is the face's own.
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
    vertices, around = _surroundings(world, outline)
    given = [np.searchsorted(vertices, loop) for loop in loops]
    with (
        _joining(options, outline, len(loops)),
        in_mesh_words(Origin(vertices, around, np.zeros(len(around), np.int64))),
    ):
        result = fairing.fill(
            world.positions[vertices], around, given, bridge=options.bridge, spacing=_spacing(world, loops, options),
            equation=options.equation.lower(), progress=progress,
        )  # fmt: skip
    number = np.full(len(vertices) + len(result.vertices), -1, dtype=np.int64)
    number[np.concatenate(given)] = np.arange(len(outline))
    number[len(vertices) :] = len(outline) + np.arange(len(result.vertices))
    triangles = number[result.triangles]
    points = np.concatenate([world.positions[outline], result.vertices])
    return Piece(
        loops=tuple(loops),
        points=points,
        positions=to_local(result.vertices, matrix),
        triangles=triangles[:, ::-1] if world.mirrored else triangles,
        verdict=_advised(judge(world, outline, (points, triangles), result), options, len(loops)),
        result=result,
        quads=options.quads,
        notes=_notes(options, result),
    )


def _surroundings(world: MeshArrays, outline: Ints) -> tuple[Ints, Ints]:
    """Return the (q,) mesh vertices of the outline and of the triangles around it, and these, in their numbers."""
    finite = np.isfinite(world.positions).all(axis=1)
    start = np.zeros(len(finite), dtype=bool)
    start[outline] = True
    around = nearby(world.triangles[finite[world.triangles].all(axis=1)], start)
    vertices = np.union1d(outline, around)
    return vertices, np.searchsorted(vertices, around)


def _spacing(world: MeshArrays, loops: list[Ints], options: FillOptions) -> float:
    """Return the wanted length; 0, which follows the outline's own edges, for a factor of 1."""
    if options.spacing == 1.0:
        return 0.0
    edges = [world.positions[np.roll(loop, -1)] - world.positions[loop] for loop in loops]
    return options.spacing * float(np.linalg.norm(np.concatenate(edges), axis=1).mean())


def _notes(options: FillOptions, result: fairing.FillResult) -> tuple[str, ...]:
    if result.equation == "least_variation" and options.equation != "LEAST_VARIATION":
        return ("No surface of that shape fits these outlines: even curvature was used",)
    if result.equation == "loft":
        return ("No fair surface fits these outlines: they were joined by a loft",)
    return ()


def judge(world: MeshArrays, outline: Ints, surface: tuple[Floats, Ints], result: fairing.FillResult) -> Verdict:
    """Return the verdict on a surface: its points, those of the outline first, and its triangles.

    world: the mesh around, in the same space. outline: (r,) its vertices. result: of the surface's solve.
    """
    points, triangles = surface
    edges = counted(len(outline), "edge", "edges")
    if not result.converged and result.termination != "folded":
        return Verdict(UNUSABLE, f"No fair surface was found for an outline of {edges}", np.unique(outline))
    folds = fairing.flipped_triangles(points, triangles, fixed=np.arange(len(outline)))
    if len(folds) or result.termination == "folded":
        text = f"The surface over an outline of {edges} is folded over"
        return Verdict(UNUSABLE, text, np.unique(outline))
    crossing = _crossing(world, outline, points, triangles)
    if crossing:
        text = counted(crossing, "new face passes through others", "new faces pass through others")
        return Verdict(UNUSABLE, text, np.unique(outline))
    seen = result.join > VISIBLE
    if seen.any():
        text = counted(int(seen.sum()), "vertex", "vertices")
        worst = float(result.join.max())
        return Verdict(LOOK, f"A kink shows at {text} of the outline, of {worst:.0f}° at worst", np.unique(outline))
    if result.equation == "loft":
        return Verdict(LOOK, LOFT_REASON, np.unique(outline))
    return Verdict(GOOD)


def _advised(verdict: Verdict, options: FillOptions, loops: int) -> Verdict:
    """Return the verdict with what to do about it where too many outlines were joined."""
    if verdict.grade != UNUSABLE or not options.bridge or loops < 3:
        return verdict
    return replace(verdict, reason=f"{verdict.reason}. {_TOO_MANY.format(loops)}")


@contextmanager
def _joining(options: FillOptions, outline: Ints, loops: int) -> Iterator[None]:
    """Let the engine's MeshErrors tell what to do about outlines that no surface joins."""
    try:
        yield
    except fairing.MeshError as error:
        if not options.bridge or error.code != "NONMANIFOLD_EDGE" or "doubles" in error.diagnostic.figures:
            raise
        raise BorderRefusal(f"No surface joins these outlines. {_TOO_MANY.format(loops)}", outline) from error


def _crossing(world: MeshArrays, outline: Ints, points: Floats, triangles: Ints) -> int:
    """Count the new triangles that pass through each other or through those of the mesh, wherever these are."""
    low, high = points.min(axis=0), points.max(axis=0)
    corners = world.positions[world.triangles]
    with np.errstate(invalid="ignore"):
        near = ((corners.min(axis=1) <= high) & (corners.max(axis=1) >= low)).all(axis=1)
    old = world.triangles[near]
    vertices = np.setdiff1d(old, outline)
    number = np.zeros(len(world.positions), dtype=np.int64)
    number[outline] = np.arange(len(outline))
    number[vertices] = len(points) + np.arange(len(vertices))
    everything = np.concatenate([points, world.positions[vertices]])
    found = fairing.self_intersections(everything, np.concatenate([triangles, number[old]]))
    return int(np.count_nonzero(found < len(triangles)))


def worst(pieces: list[Piece]) -> Verdict:
    """Return the verdict on the piece that is worth least."""
    order = (GOOD, LOOK, UNUSABLE)
    return max((piece.verdict for piece in pieces), key=lambda verdict: order.index(verdict.grade))
