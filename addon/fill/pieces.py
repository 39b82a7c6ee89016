"""What Fair Fill is asked for, and the surfaces that it makes. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

import fairing

from ..arrays.border import Left
from ..arrays.harmonic import harmonic, nearest
from ..arrays.region import nothing
from ..arrays.types import Floats, Ints
from ..mirror.reflected import Whole
from ..options.other_options import FillOptions
from ..remesh.faces import Faces, faces_in_rows, faces_of, paired_faces
from ..remesh.key_surface import NewSurface, Surroundings, key_surfaces
from ..verdict.quality import Join
from ..verdict.verdict import UNUSABLE, Verdict
from .across import Across


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
    quads: bool = False  # whether faces are quads
    rows: bool = False  # whether these are in rows: those of the result
    notes: tuple[str, ...] = field(default=())
    across: Across = field(default_factory=Across)  # what runs across it; drawn vertices come first among the k

    def faces(self, kinds: Ints, lines: Ints) -> Faces:
        """Return what is written; kinds: (m,) of the triangles, of which only those of one kind are paired in no rows.

        lines: (l, 2) edges that no quad runs across.
        """
        closes_at_once = not len(self.positions) and len(self.triangles) == 2
        if not (self.quads or closes_at_once):
            return faces_of(self.triangles)
        if self.rows and self.result.quads is not None:
            return faces_in_rows(self.triangles, self.result.quads.pairs.astype(np.int64), lines)
        return paired_faces(self.points, self.triangles, np.concatenate([lines, self.across.edges]), kinds)

    @property
    def boundary(self) -> Ints:
        """The (r,) mesh vertices around it."""
        return np.concatenate(self.loops)

    @property
    def rims(self) -> tuple[Ints, ...]:
        """Each loop as numbers of `points`."""
        return tuple(np.split(np.arange(len(self.boundary)), np.cumsum([len(loop) for loop in self.loops])[:-1]))

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
        if len(self.across.edges):
            return [None] * len(places)
        mirrored = np.linalg.det(self.around.matrix[:3, :3]) < 0.0
        triangles = self.triangles[:, ::-1] if mirrored else self.triangles
        return key_surfaces(NewSurface(self.points, triangles, self.result.equation), self.around, places, carried)

    def examples(self) -> tuple[Ints, Ints]:
        """Return (k,) and (m,): boundary vertices whose data new vertices and new faces take, for what has no mean.

        That of a face stands for the edge from there to the next one: at the boundary it is the face's own.
        """
        rim = len(self.boundary)
        near = nearest(self.triangles, len(self.points), rim)
        of_face = near[self.triangles[:, 0]]
        following = np.append(self.following, np.full(len(self.points) - rim, -1))
        for tail, head in ((0, 1), (1, 2), (2, 0)):
            at_edge = following[self.triangles[:, tail]] == self.triangles[:, head]
            of_face[at_edge] = self.triangles[at_edge, tail]
        return near[rim:], of_face


@dataclass(frozen=True)
class Filled:
    """The surfaces of one mesh, and the holes that can't be filled."""

    pieces: list[Piece]
    left: tuple[Left, ...] = ()
    whole: Whole | None = None  # that mesh with its image, likewise but for verdicts; None: it is no half

    @property
    def left_vertices(self) -> Ints:
        """The vertices of the holes that stay open, ascending."""
        vertices: Ints = np.unique(np.concatenate([nothing(), *(each.vertices for each in self.left)]))
        return vertices

    def with_left(self, left: tuple[Left, ...]) -> Filled:
        """Return it with more holes that stay open, before its own."""
        return replace(self, left=(*left, *self.left))

    def for_half(self, whole: Whole) -> Filled:
        pieces = [replace(piece, verdict=whole.about_half(piece.verdict)) for piece in self.pieces]
        return replace(self, pieces=pieces, left=tuple(each.named(whole.own) for each in self.left), whole=whole)

    def unfilled(self) -> Filled:
        """Return it without any surface."""
        left = (Left(self._boundary(piece), piece.verdict.reason, piece.verdict.spots) for piece in self.pieces)
        return Filled([], (*self.left, *left))

    def _boundary(self, piece: Piece) -> Ints:
        return np.unique(piece.boundary if self.whole is None else self.whole.own(piece.boundary))

    def usable(self, options: FillOptions) -> Filled:
        """Return what is to be written: surfaces that are not usable are left out where others are."""
        usable = [piece for piece in self.pieces if piece.verdict.grade != UNUSABLE]
        if options.allow_folds or not usable or len(usable) == len(self.pieces):
            return self
        bad = replace(self, pieces=[piece for piece in self.pieces if piece.verdict.grade == UNUSABLE], left=())
        return replace(self, pieces=usable, left=(*self.left, *bad.unfilled().left))
