"""The solved surface of a fillet: sections across its strips, and places for the quads where these meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing._found_line import NoRowsError
from fairing._strips import Column, Strip
from fairing._types import FloatArray, IntArray

# Of the bulge over a column's chord: where the surface leaves the quads between two columns by more, one comes between.
_OFF = 0.6  # where strips meet at corners it is up to 0.47, between vertices of a ring less
_OFF_AT_WALLS = 0.25  # where it ends at a wall and fades, 1.4 from one end to the other
_FLAT = 0.02  # of the width: what bulges less is flat
_MOST_HALVINGS = 8  # of the way between two columns
_INSIDE = 1e-6  # of the strip: as far inside its ends are cut, since along them its boundary may lie in their planes
_LEAST_NORMAL = 0.05  # sine between the chord and the mean normal of its ends: below no plane is known

Placed = tuple[FloatArray, int, FloatArray]
"""A place, the triangle under it and the weights there."""


@dataclass
class Solved:
    """One component; its triangles have the numbers `numbers` among all."""

    vertices: FloatArray
    triangles: IntArray
    numbers: IntArray
    fixed: IntArray
    normals: FloatArray

    def __post_init__(self) -> None:
        self._surface = _core.FilletSurface(self.vertices, self.triangles, self.fixed, self.normals)

    def distance(self, place: FloatArray) -> float:
        """To the nearest vertex of the boundary."""
        return float(np.linalg.norm(self.vertices[self.fixed] - place, axis=1).min())

    def sections(self, strip: Strip, columns: Sequence[Column], rows: int) -> list[Placed]:
        """rows − 1 places on each column, right to left. Raises NoRowsError."""
        pairs = [strip.beside(column, _INSIDE * strip.sides[0].length) for column in columns]
        return self.across([pair[0].place for pair in pairs], [pair[1].place for pair in pairs], rows)

    def across(self, first: Sequence[FloatArray], last: Sequence[FloatArray], rows: int) -> list[Placed]:
        """rows − 1 places on the way from each place of the boundary to another one. Raises NoRowsError."""
        if not first or rows < 2:
            return []
        starts, ends = np.array(first), np.array(last)
        found = self._surface.sections(starts, ends, self._planes(starts, ends), rows)
        placed = self._placed(found)
        return placed if found["found"].all() else self._mended(placed, found["found"], (starts, ends), rows)

    def _mended(
        self, placed: list[Placed], found: npt.NDArray[np.bool_], ends: tuple[FloatArray, FloatArray], rows: int
    ) -> list[Placed]:
        """With the places on columns whose planes lead elsewhere: those of the nearest column, moved with its ends."""
        places = np.array([place for place, _, _ in placed]).reshape(len(found), rows - 1, 3)
        shares = np.arange(1, rows)[:, None] / rows
        middles = 0.5 * (ends[0] + ends[1])
        for k in np.flatnonzero(~found).tolist():
            places[k] = (1 - shares) * ends[0][k] + shares * ends[1][k]
            if found.any():
                near = np.flatnonzero(found)[np.linalg.norm(middles[found] - middles[k], axis=1).argmin()]
                places[k] += places[near] - (1 - shares) * ends[0][near] - shares * ends[1][near]
        lost = np.repeat(~found, rows - 1)
        put = iter(self._placed(self._surface.relaxed([], places.reshape(-1, 3)[lost], 0, 0)))
        return [next(put) if gone else own for own, gone in zip(placed, lost.tolist(), strict=True)]

    def laid_out(self, quads: list[list[int]], known: FloatArray, count: int, sweeps: int) -> list[Placed]:
        """Of `count` vertices after the known ones: at the means of their neighbours, and then relaxed."""
        return self.relaxed(quads, np.concatenate([known, _means(quads, known, count)]), len(known), sweeps)

    def relaxed(self, quads: list[list[int]], places: FloatArray, held: int, sweeps: int) -> list[Placed]:
        """All but the first vertices of some quads."""
        return self._placed(self._surface.relaxed(quads, places, held, sweeps))[held:]

    def refine(self, strip: Strip, rows: int, width: float) -> None:
        """Columns between others where the surface is not straight."""
        fresh = list(zip(strip.columns, strip.columns[1:], strict=False))
        known: dict[Column, FloatArray] = {}
        most = _OFF_AT_WALLS if strip.walled else _OFF
        for _ in range(_MOST_HALVINGS):
            if not fresh:
                return
            middles = [before.between(after, 0.5) for before, after in fresh]
            self._find(strip, [c for pair in fresh for c in pair] + middles, rows, known)
            added = []
            for (before, after), middle in zip(fresh, middles, strict=True):
                straight = 0.5 * (known[before] + known[after])
                off = np.linalg.norm(known[middle] - straight, axis=1).max(initial=0.0)
                ends = [spot.place for spot in strip.spots(middle)]
                bulge = np.linalg.norm(known[middle] - 0.5 * (ends[0] + ends[1]), axis=1).min(initial=np.inf)
                size = max(after.right - before.right, after.left - before.left)
                if off > max(most * bulge, _FLAT * width) and size > 0.5 * width:
                    strip.columns.insert(strip.columns.index(after), middle)
                    added += [(before, middle), (middle, after)]
            fresh = added

    def _find(self, strip: Strip, columns: list[Column], rows: int, known: dict[Column, FloatArray]) -> None:
        wanted = [c for c in dict.fromkeys(columns) if c not in known]
        known |= {c: strip.along_walls(c, self.vertices) for c in wanted if c in strip.walled}
        wanted = [c for c in wanted if c not in known]
        found = self.sections(strip, wanted, rows)
        for k, column in enumerate(wanted):
            known[column] = np.array([place for place, _, _ in found[k * (rows - 1) : (k + 1) * (rows - 1)]])

    def _placed(self, found: dict[str, FloatArray]) -> list[Placed]:
        numbers = self.numbers[found["triangle"]]
        return list(zip(found["places"], numbers.tolist(), found["weights"], strict=True))

    def _planes(self, starts: FloatArray, ends: FloatArray) -> FloatArray:
        """(c, 3) normals of the planes through both ends and along the mean of the surface's normals there."""
        upward = sum(self.normals[self._nearest(at)] for at in (starts, ends))
        chords = ends - starts
        normals = np.cross(chords, upward)
        sizes = np.linalg.norm(normals, axis=1)
        if (sizes < _LEAST_NORMAL * np.linalg.norm(chords, axis=1)).any():
            raise NoRowsError
        planes: FloatArray = normals / sizes[:, None]
        return planes

    def _nearest(self, at: FloatArray) -> IntArray:
        rim = self.vertices[self.fixed]
        return np.array([np.linalg.norm(rim - place, axis=1).argmin() for place in at], dtype=np.int64)


def _means(quads: list[list[int]], known: FloatArray, count: int) -> FloatArray:
    """(count, 3): each vertex after the known ones is the mean of its neighbours."""
    total = len(known) + count
    beside = np.zeros((total, total))
    for quad in quads:
        for k in range(4):
            beside[quad[k], quad[k - 1]] = beside[quad[k - 1], quad[k]] = 1.0
    new = slice(len(known), total)
    system = np.diag(beside[new].sum(axis=1)) - beside[new, new]
    places: FloatArray = np.linalg.solve(system, beside[new, : len(known)] @ known)
    return places
