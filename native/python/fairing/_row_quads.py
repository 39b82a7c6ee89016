"""Quads in rows along rounded seams: strips across each of them, blocks where they meet, caps where they fade out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from fairing._corner_quads import Quad, blocks, end_cap, grid_quads
from fairing._cut_anew import ChosenPoints
from fairing._fillet_strips import Seams, Strips, arriving, continues, strips_of
from fairing._found_line import NoRowsError
from fairing._row_origins import Wanted
from fairing._seam_arcs import LEFT, RIGHT, Arc, End
from fairing._strip_surface import Placed, Solved
from fairing._strips import Spot, Strip, parted
from fairing._types import FloatArray, IntArray

_WIDE = 170.0  # degrees: a quad with a wider angle is mended
_MOST_RINGS = 3  # of quads around those that are mended
_SWEEPS = 60  # of the relaxation around poles: more move nothing that is seen


@dataclass
class RowMesh:
    """Quads over the places of chosen points of the line, and new ones."""

    chosen: ChosenPoints
    quads: IntArray
    places: FloatArray
    """(k, 3) of the new vertices, which have the numbers after those of the line's points;"""
    triangle: IntArray
    """(k,) where they lie on the solved mesh,"""
    weights: FloatArray
    """(k, 3) and where there;"""
    wanted: list[Wanted]
    """where they have to lie on the old one."""


def row_mesh(seams: Seams, solved: list[Solved]) -> RowMesh:
    """Raises NoRowsError."""
    return _Making(seams, strips_of(seams, solved)).made()


class _Making:
    """One mesh in the making."""

    def __init__(self, seams: Seams, found: Strips) -> None:
        self._seams, self._rows = seams, seams.rows
        self._network, self._ends, self._strips, self._on = found.network, found.ends, found.strips, found.on
        self._chosen = ChosenPoints(seams.line, seams.points)
        self._quads: list[Quad] = []
        self._surfaces: list[Solved] = []  # under each
        self._places: list[Placed] = []
        self._wanted: list[Wanted] = []
        self._columns: dict[End, list[int]] = {}  # from the right to the left of each arc's end

    def made(self) -> RowMesh:
        self._choose()
        self._chosen.number()
        for number in range(len(self._strips)):
            self._add_strip(number)
        for loop in self._meetings():
            self._add_meeting(loop)
        for rings in range(1, _MOST_RINGS + 1):
            if not self._mend(rings):
                break
        places, triangles, weights = zip(*self._places, strict=True) if self._places else ((), (), ())
        return RowMesh(
            self._chosen, np.array(self._quads, dtype=np.int32).reshape(-1, 4), np.array(places).reshape(-1, 3),
            np.array(triangles, dtype=np.int32), np.array(weights).reshape(-1, 3), self._wanted,
        )  # fmt: skip

    def _choose(self) -> None:
        """All points of the line and of walls that the quads need."""
        for strip in self._strips:
            for column in strip.columns:
                for spot in strip.spots(column):
                    self._chosen.add(spot)
        for end, spots in self._ends.around.items():
            if end == self._other(end) and self._rows < 4:
                raise NoRowsError
            places = parted(spots, self._network.onward[end][2], self._rows, self._seams.must)
            self._ends.around[end] = places
            for spot in places:
                self._chosen.add(spot)
        for number in range(len(self._strips)):
            for which in (0, 1):
                if not continues(self._network, (number, which)):
                    self._choose_wall((number, which))

    def _other(self, end: End) -> End:
        return self._network.onward[end][0]

    def _choose_wall(self, end: End) -> None:
        number, which = end
        strip = self._strips[number]
        column = strip.columns[-which]
        vertex = strip.arc.vertices[-which]
        for side, (spot, way) in enumerate(zip(strip.spots(column), strip.walled[column], strict=True)):
            hook = strip.hooks.get((which, side))
            if hook is None:
                self._chosen.add_wall(spot, vertex, way)
                continue
            quarters = max(1, round(hook.length / (0.5 * np.pi * self._seams.width)))
            hook.spots = parted(hook.spots, hook.segments, quarters * self._rows // 2, self._seams.must)
            for each in hook.spots:
                self._chosen.add(each)
            self._chosen.add_wall(hook.spots[-1], vertex, hook.wall)

    def _mend(self, rings: int) -> bool:
        """Relax so many rings around quads that are not convex; return whether there are any."""
        quads = np.array(self._quads)
        count = self._chosen.vertex_count
        used, local = np.unique(quads, return_inverse=True)
        local = local.reshape(quads.shape)
        places = np.array([self._place(v) for v in used.tolist()])
        near = np.zeros(len(used), dtype=bool)
        near[local[widest(places[local]) > _WIDE]] = True
        if not near.any():
            return False
        for _ in range(rings):
            near[local[near[local].any(axis=1)]] = True
        for surface in {id(each): each for each in self._on}.values():
            own = np.array([self._surfaces[k] is surface for k in range(len(quads))])
            free = near & (used >= count) & np.isin(np.arange(len(used)), local[own])
            around = own & free[local].any(axis=1)
            held = np.setdiff1d(local[around], np.flatnonzero(free))
            order = np.concatenate([held, np.flatnonzero(free)])
            name = np.zeros(len(used), dtype=np.int64)
            name[order] = np.arange(len(order))
            found = surface.relaxed(name[local[around]].tolist(), places[order], len(held), _SWEEPS)
            for v, placed in zip(used[free].tolist(), found, strict=True):
                self._places[v - count] = placed
        return True

    def _add_strip(self, number: int) -> None:
        strip, surface = self._strips[number], self._on[number]
        pairs = [strip.spots(column) for column in strip.columns]
        last = len(pairs) - 1
        walled = [k for which, k in ((0, 0), (1, last)) if not continues(self._network, (number, which))]
        inner = [k for k in range(last + 1) if k not in walled and not (strip.arc.closed and k == last)]
        found = surface.sections(strip, [strip.columns[k] for k in inner], self._rows)
        grid: list[list[int]] = [[] for _ in pairs]
        for at, k in enumerate(inner):
            wanted = self._wanted_across(strip, pairs[k])
            new = [self._new(found[at * (self._rows - 1) + row], wanted[row]) for row in range(self._rows - 1)]
            grid[k] = [self._chosen.vertex(pairs[k][0]), *new, self._chosen.vertex(pairs[k][1])]
        for k in walled:
            right, left = (self._half(number, (1 if k else 0, side), pairs[k][side]) for side in (RIGHT, LEFT))
            grid[k] = [*right, strip.arc.vertices[-1 if k else 0], *left[::-1]]
        if strip.arc.closed:
            grid[last] = grid[0]
        self._columns[number, 0], self._columns[number, 1] = grid[0], grid[last]
        self._add_quads(grid_quads(grid), surface)

    def _half(self, number: int, at: tuple[int, int], spot: Spot) -> list[int]:
        """Of a column at walls: from one side's spot to the arc's end, which is not among them."""
        strip = self._strips[number]
        which, side = at
        vertex, hook = strip.arc.vertices[-which], strip.hooks.get(at)
        if hook is None:
            return self._chosen.wall(spot, vertex)
        half, surface = self._rows // 2, self._on[number]
        wanted = Wanted(self._chosen.triangle(hook.spots[half // 2]))
        columns = []
        for each in hook.spots[:-1:half]:
            found = surface.across([each.place], [self._seams.points[vertex]], half)
            columns.append([self._chosen.vertex(each), *(self._new(placed, wanted) for placed in found)])
        columns.append(self._chosen.wall(hook.spots[-1], vertex))
        for k, (column, after) in enumerate(pairwise(columns)):
            around = [self._chosen.vertex(each) for each in hook.spots[k * half : (k + 1) * half + 1]]
            sides = [around, [*after, vertex], [vertex, *column[::-1]]]
            if arriving(which) != side:
                sides = [[vertex, *after[::-1]], around[::-1], [*column, vertex]]
            quads, count = self._filled(partial(blocks, sides))
            self._lay_out(quads, [v for own in sides for v in own[:-1]], [wanted] * count, surface)
        return columns[0]

    def _wanted_across(self, strip: Strip, spots: tuple[Spot, Spot]) -> list[Wanted]:
        """On both sides of the seam, or on the walls that lead to it; the middle one on the seam."""
        right, left = (
            Wanted(edges=self._seams.line.walls[:, 1:3]) if self._chosen.is_walled(spot) else
            Wanted(triangle=self._chosen.triangle(spot))
            for spot in spots
        )  # fmt: skip
        half = self._rows // 2
        return [*[right] * (half - 1), Wanted(edges=_edges(strip.arc)), *[left] * (half - 1)]

    def _new(self, placed: Placed, wanted: Wanted) -> int:
        self._places.append(placed)
        self._wanted.append(wanted)
        return self._chosen.vertex_count + len(self._places) - 1

    def _meetings(self) -> list[list[End]]:
        """The ends of arcs around each, counter-clockwise."""
        left = set(self._network.onward)
        found = []
        while left:
            loop = [min(left)]
            left.discard(loop[0])
            while self._other(loop[-1]) != loop[0]:
                loop.append(self._other(loop[-1]))
                if loop[-1] not in left:
                    raise NoRowsError
                left.discard(loop[-1])
            found.append(loop)
        return found

    def _add_meeting(self, loop: list[End]) -> None:
        sides: list[list[int]] = []
        wanted: list[Wanted] = []
        for end in loop:
            column = self._columns[end]
            sides.append(column if end[1] == 0 else column[::-1])
            wanted.append(Wanted(edges=_edges(self._strips[end[0]].arc)))
            if end in self._ends.around:
                spots = self._ends.around[end]
                sides.append([self._chosen.vertex(spot) for spot in spots])
                wanted.append(Wanted(self._chosen.triangle(spots[len(spots) // 2])))
        rim = [v for side in sides for v in side[:-1]]
        if len(sides) == 2 and len(loop) == 1:
            quads, count = self._filled(partial(end_cap, sides[0], sides[1]))
            own = [Wanted()] * count
        elif len(sides) > 2:
            quads, count = self._filled(partial(blocks, sides))
            half = self._rows // 2
            corners = [Wanted(self._chosen.triangle_at(side[-1])) for side in sides]
            arc = self._strips[loop[0][0]].arc
            own = [
                Wanted(vertex=arc.vertices[-loop[0][1]]),
                *(wish for wish in wanted for _ in range(half - 1)),
                *(wish for wish in corners for _ in range((half - 1) ** 2)),
            ]
        else:
            raise NoRowsError
        self._lay_out(quads, rim, own, self._on[loop[0][0]])

    def _filled(self, make: Callable[[Callable[[], int]], list[Quad]]) -> tuple[list[Quad], int]:
        """Quads with new vertices −1, −2 …, and how many of these there are."""
        made = [0]

        def new() -> int:
            made[0] -= 1
            return made[0]

        return make(new), -made[0]

    def _lay_out(self, quads: list[Quad], rim: list[int], wanted: list[Wanted], surface: Solved) -> None:
        """Put the new vertices of some quads on the surface."""
        count = len(wanted)
        local = {v: k for k, v in enumerate(rim)} | {-1 - k: len(rim) + k for k in range(count)}
        rows = [[local[v] for v in quad] for quad in quads]
        known = np.array([self._place(v) for v in rim])
        found = surface.laid_out(rows, known, count, _SWEEPS)
        names = {-1 - k: self._new(found[k], wanted[k]) for k in range(count)}
        named = [[names.get(v, v) for v in quad] for quad in quads]
        self._add_quads([(a, b, c, d) for a, b, c, d in named], surface)

    def _add_quads(self, quads: list[Quad], surface: Solved) -> None:
        self._quads += quads
        self._surfaces += [surface] * len(quads)

    def _place(self, vertex: int) -> FloatArray:
        if vertex < len(self._seams.points):
            found: FloatArray = self._seams.points[vertex]
            return found
        if vertex < self._chosen.vertex_count:
            return self._chosen.place(vertex)
        return self._places[vertex - self._chosen.vertex_count][0]


def _edges(arc: Arc) -> IntArray:
    return np.column_stack([arc.vertices[:-1], arc.vertices[1:]])


def widest(corners: FloatArray) -> FloatArray:
    """(q,) degrees: the widest angle of quads (q, 4, 3); 360 less the angle where one is not convex."""
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = np.cross(ahead, back)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    angles = np.degrees(np.arctan2(np.linalg.norm(cross, axis=2), (ahead * back).sum(axis=2)))
    result: FloatArray = np.where((cross * normals[:, None]).sum(axis=2) <= 0, 360 - angles, angles).max(axis=1)
    return result
