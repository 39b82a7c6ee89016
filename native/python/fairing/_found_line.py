"""The line where a fillet ends, as the engine finds it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing._types import FloatArray, IntArray


class NoRowsError(Exception):
    """Why a fillet has no rows."""


@dataclass(frozen=True)
class FoundLine:
    """The line of `_core.fillet_line`, p points close to each other; fillets are on its left."""

    places: FloatArray
    """(p, 3)"""
    numbers: IntArray
    """(p, 3) vertex, number of the edge, triangle."""
    along: FloatArray
    ends: IntArray
    """(p, 2) of the edges that they are on, or −1."""
    feet: IntArray
    """(p, 2) the half-edge of a seam from which each is reached,"""
    foot_along: FloatArray
    corner: npt.NDArray[np.bool_]
    segments: IntArray
    """(s, 3) from, to, triangle."""
    seams: IntArray
    walls: IntArray
    """(w, 5) edge, tail, head, triangle, corner there."""

    @classmethod
    def of(cls, found: dict[str, Any]) -> FoundLine:
        whole = {"numbers": 3, "segments": 3, "walls": 5}
        for name, width in whole.items():
            found[name] = np.array(found[name], dtype=np.int64).reshape(-1, width)
        return cls(**{name: np.asarray(value) for name, value in found.items()})

    def is_bound(self) -> npt.NDArray[np.bool_]:
        """(p,) at vertices and on edges: these points stay."""
        bound: npt.NDArray[np.bool_] = (self.numbers[:, :2] >= 0).any(axis=1)
        return bound

    def chains(self) -> Iterator[tuple[list[int], list[int], bool]]:
        """The points of each chain, its segments, and whether it is closed: its first point then comes last, too.

        Segment −1 leads along a wall.
        """
        after: dict[int, int] = {}
        for number, (begin, _, _) in enumerate(self.segments.tolist()):
            if begin in after:
                raise NoRowsError
            after[begin] = number
        over = self._over_walls(after)
        heads = {*self.segments[:, 1].tolist()} - {*over} | {*over.values()}
        starts = [begin for begin in after if begin not in heads]
        for start in [*starts, *after]:
            points, segments = [start], []
            while points[-1] in after or points[-1] in over:
                segments.append(after.pop(points[-1], -1))
                points.append(int(self.segments[segments[-1], 1]) if segments[-1] >= 0 else over.pop(points[-1]))
            if segments:
                yield points, segments, points[0] == points[-1]

    def _over_walls(self, after: dict[int, int]) -> dict[int, int]:
        """Where the line ends at a wall: the point of the same fillet on the same wall at which it goes on."""
        heads = {*self.segments[:, 1].tolist()}
        starts = [p for p in after if p not in heads]
        found: dict[int, int] = {}
        for p in heads - {*after}:
            own = self._reached_end(p)
            beside = [q for q in starts if own and self._reached_end(q) == own]
            if beside:
                found[p] = min(beside, key=lambda q: abs(float(self.along[q] - self.along[p])))
        return found

    def _reached_end(self, point: int) -> tuple[int, int] | None:
        """Of a point on a wall: the edge, and its end on the seam from which it is reached; none where it has none."""
        ends = [v for v in self.ends[point].tolist() if v in self.feet[point]]
        return (int(self.numbers[point, 1]), ends[0]) if len(ends) == 1 and ends[0] >= 0 else None
