"""A mesh of any library as points, polygons and their data."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing._hole_loops import hole_loops
from fairing._types import FloatArray, IntArray

Data = dict[str, npt.NDArray[Any]]


@dataclass(frozen=True, eq=False)
class Polygons:
    """Faces with any number of corners."""

    corners: IntArray
    """(Σ sizes,) vertices of all faces, one face after the other."""
    sizes: IntArray
    """(m,) how many of them each face has."""

    @classmethod
    def of(cls, rows: npt.ArrayLike) -> Polygons:
        """Faces that all have as many corners, (m, k)."""
        array = np.asarray(rows)
        if array.dtype.kind not in "iu" or array.ndim != 2 or array.shape[1] < 3:
            raise ValueError(f"faces: whole numbers, (m, 3) or wider, are needed, not {array.dtype} {array.shape}")
        return cls(array.ravel().astype(np.int32), np.full(len(array), array.shape[1], dtype=np.int32))

    @classmethod
    def joined(cls, parts: list[Polygons]) -> Polygons:
        """All faces of the parts, in their order."""
        return cls(np.concatenate([part.corners for part in parts]), np.concatenate([part.sizes for part in parts]))

    @cached_property
    def first(self) -> IntArray:
        """(m,) where in ``corners`` each face begins."""
        begins: IntArray = np.cumsum(self.sizes) - self.sizes
        return begins

    @cached_property
    def face_of(self) -> IntArray:
        """(t,) the face of each triangle."""
        faces: IntArray = np.repeat(np.arange(len(self.sizes), dtype=np.int32), self.sizes - 2)
        return faces

    @cached_property
    def triangles(self) -> IntArray:
        """(t, 3) each face as a fan around its first corner, wound as it is."""
        step = np.arange(len(self.face_of)) - np.repeat(np.cumsum(self.sizes - 2) - (self.sizes - 2), self.sizes - 2)
        begin = self.first[self.face_of]
        places = np.column_stack([begin, begin + step + 1, begin + step + 2])
        return np.ascontiguousarray(self.corners[places], dtype=np.int32)

    def edges(self, faces: IntArray, same: IntArray) -> IntArray:
        """(e, 2) the edges of some faces, those between two of them once; ``same``: which vertex stands for each."""
        kept = self.chosen(faces)
        after = np.arange(len(kept.corners)) + 1
        after[kept.first + kept.sizes - 1] = kept.first
        pairs = np.sort(same[np.column_stack([kept.corners, kept.corners[after]])], axis=1)
        found: IntArray = np.unique(pairs, axis=0)
        return found

    def chosen(self, faces: npt.NDArray[Any]) -> Polygons:
        """Some of the faces."""
        taken = np.zeros(len(self.sizes), dtype=bool)
        taken[faces] = True
        return Polygons(self.corners[np.repeat(taken, self.sizes)], self.sizes[taken])

    def rows(self) -> npt.NDArray[np.int32] | list[IntArray]:
        """(m, k) where all have k corners, else a list with the corners of each."""
        if len(self.sizes) and (self.sizes == self.sizes[0]).all():
            return self.corners.reshape(len(self.sizes), -1)
        return [self.corners[begin : begin + size] for begin, size in zip(self.first, self.sizes, strict=True)]


@dataclass(frozen=True, eq=False)
class Parts:
    """Points, faces, and what is stored for each."""

    points: FloatArray
    faces: Polygons
    vertex_data: Data = field(default_factory=dict)
    face_data: Data = field(default_factory=dict)

    @classmethod
    def checked(cls, points: npt.ArrayLike, faces: Polygons, vertex_data: Data, face_data: Data) -> Parts:
        """The same with its arrays checked; the numbers of rows, too."""
        at = _arguments.floats("vertices", points)
        _arguments.triangles_within(faces.triangles, len(at))
        for what, data, count in (("vertex", vertex_data, len(at)), ("face", face_data, len(faces.sizes))):
            for name, values in data.items():
                if len(values) != count:
                    raise ValueError(f"{what} data {name!r}: {count} rows are needed, not {len(values)}")
        return cls(at, faces, vertex_data, face_data)

    @cached_property
    def same(self) -> IntArray:
        """(n,) the first vertex in the same place, where both are on a border: files part vertices along seams."""
        numbers = np.arange(len(self.points), dtype=np.int32)
        loops = hole_loops(self.points, self.faces.triangles)
        border = np.unique(np.concatenate([np.empty(0, np.int32), *loops.loops, *loops.torn]))
        if len(border):
            _, first, place = np.unique(self.points[border], axis=0, return_index=True, return_inverse=True)
            numbers[border] = border[first[place.ravel()]]
        return numbers

    @cached_property
    def triangles(self) -> IntArray:
        """(t, 3) with one vertex for each place along seams."""
        return np.ascontiguousarray(self.same[self.faces.triangles])

    def in_triangles(self) -> Parts:
        """The same with each face as a fan of triangles, which all have what is stored for it."""
        data = {name: values[self.faces.face_of] for name, values in self.face_data.items()}
        return Parts(self.points, Polygons.of(self.faces.triangles), self.vertex_data, data)
