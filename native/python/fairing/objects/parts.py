"""A mesh of any library or file as points, polygons and their data."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.measure import edges_with_uses
from fairing.options import arguments
from fairing.results import FloatArray, IntArray

Data = dict[str, npt.NDArray[Any]]
PLACE = "\0place"  # vertex data: the number in its file of a vertex that stands there once for several values


def alike(rows: npt.NDArray[Any]) -> tuple[IntArray, IntArray]:
    """Rows (n, c) that are different, by the first of each in order, and (n,) which of these each row is."""
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    return first[order].astype(np.int32), np.argsort(order)[number.ravel()].astype(np.int32)


@dataclass(frozen=True, eq=False)
class Polygons:
    """Faces with any number of corners."""

    corners: IntArray
    """(Σ sizes,) vertices of all faces, one face after the other."""
    sizes: IntArray
    """(m,) how many of them each face has."""

    @classmethod
    def of(cls, rows: Any) -> Polygons:
        """Faces that all have as many corners, (m, k), or a list with the corners of each."""
        counts = [np.size(row) for row in rows] if isinstance(rows, (list, tuple)) else []
        array = np.concatenate([np.asarray(row) for row in rows])[None] if len({*counts}) > 1 else np.atleast_1d(rows)
        sizes = np.array(counts or [array.shape[-1]] * len(array), np.int32)
        if array.dtype.kind not in "iu" or array.ndim != 2 or (sizes < 3).any():
            raise ValueError(f"faces: whole numbers, 3 or more in each, are needed, not {array.dtype} {array.shape}")
        return cls(array.ravel().astype(np.int32), sizes)

    @classmethod
    def joined(cls, parts: list[Polygons]) -> Polygons:
        """All faces of the parts, in their order."""
        return cls(np.concatenate([part.corners for part in parts]), np.concatenate([part.sizes for part in parts]))

    @cached_property
    def first(self) -> IntArray:
        """(m,) where in ``corners`` each face begins."""
        return np.cumsum(self.sizes) - self.sizes

    @cached_property
    def face_of(self) -> IntArray:
        """(t,) the face of each triangle."""
        return np.repeat(np.arange(len(self.sizes), dtype=np.int32), self.sizes - 2)

    def sides(self, faces: npt.NDArray[Any]) -> IntArray:
        """(Σ k, 2) the sides of some faces, each as its face runs along it."""
        kept = self.chosen(faces)
        after = np.arange(len(kept.corners)) + 1
        after[kept.first + kept.sizes - 1] = kept.first
        return np.column_stack([kept.corners, kept.corners[after]])

    def chosen(self, faces: npt.NDArray[Any]) -> Polygons:
        """Some of the faces, in their order here."""
        taken = np.zeros(len(self.sizes), dtype=bool)
        taken[faces] = True
        return Polygons(self.corners[np.repeat(taken, self.sizes)], self.sizes[taken])

    def turned(self, faces: IntArray) -> Polygons:
        """The same with some faces wound the other way."""
        places = np.arange(len(self.corners))
        mine = np.repeat(np.isin(np.arange(len(self.sizes)), faces), self.sizes)
        ends = np.repeat(2 * self.first + self.sizes - 1, self.sizes)
        return Polygons(self.corners[np.where(mine, ends - places, places)], self.sizes)

    def rows(self) -> npt.NDArray[np.int32] | list[IntArray]:
        """(m, k) where all have k corners, else a list with the corners of each."""
        if len(self.sizes) and (self.sizes == self.sizes[0]).all():
            return self.corners.reshape(len(self.sizes), -1)
        return np.split(self.corners, self.first[1:])


@dataclass(frozen=True, eq=False)
class Parts:
    """Points, faces, and what is stored for each."""

    points: FloatArray
    faces: Polygons
    vertex_data: Data = field(default_factory=dict)
    face_data: Data = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", arguments.floats("vertices", self.points))
        arguments.indices_within("faces", self.faces.corners, len(self.points))
        if (self.faces.sizes < 3).any() or self.faces.sizes.sum() != len(self.faces.corners):
            raise ValueError("faces: one has fewer than three corners, or not as many as its size says")
        for what, data, count in (
            ("vertex", self.vertex_data, len(self.points)), ("face", self.face_data, len(self.faces.sizes)),
        ):  # fmt: skip
            for name, values in data.items():
                if len(values) != count:
                    raise ValueError(f"{what} data {name!r}: {count} rows are needed, not {len(values)}")

    @cached_property
    def own(self) -> IntArray:
        """(t, 3) the faces in triangles, one face after the other, wound as they are."""
        if (self.faces.sizes == 3).all():
            return self.faces.corners.reshape(-1, 3)
        return _core.triangulated(self.points, self.faces.corners, self.faces.sizes)

    @cached_property
    def same(self) -> IntArray:
        """(n,) the first vertex in the same place, where both are on a border: files part vertices along seams."""
        numbers = np.arange(len(self.points), dtype=np.int32)
        edges, uses = edges_with_uses(self.own)
        border = np.unique(edges[uses == 1])
        if len(border):
            _, first, place = np.unique(self.points[border], axis=0, return_index=True, return_inverse=True)
            numbers[border] = border[first[place.ravel()]]
        return numbers

    @cached_property
    def triangles(self) -> IntArray:
        """(t, 3) with one vertex for each place along seams."""
        return np.ascontiguousarray(self.same[self.own])

    @cached_property
    def sound(self) -> npt.NDArray[np.bool_]:
        """(t,) whether a triangle has three vertices, and is none that was there before, wound alike."""
        a, b, c = self.triangles.T
        three: npt.NDArray[np.bool_] = (a != b) & (b != c) & (c != a)
        begin = self.triangles.argmin(axis=1)[:, None]
        rows = np.take_along_axis(self.triangles, (begin + np.arange(3)) % 3, axis=1)
        order = np.lexsort(rows.T)
        three[order[1:][(rows[order[1:]] == rows[order[:-1]]).all(axis=1)]] = False
        return three

    def in_triangles(self) -> Parts:
        """The same with each face in triangles, which all have what is stored for it."""
        data = {name: values[self.faces.face_of] for name, values in self.face_data.items()}
        return Parts(self.points, Polygons.of(self.own), self.vertex_data, data)


def by_vertices(points: FloatArray, faces: Polygons, stores: tuple[Data, Data], at_corners: Data) -> Parts:
    """Parts with a vertex for each value (Σ sizes, c) that a point has at corners; the points keep their order.

    ``stores``: data of points and of faces. What has less than three corners is no face.
    """
    if (faces.sizes < 3).any():
        whole = faces.sizes > 2
        at_corners = {name: values[np.repeat(whole, faces.sizes)] for name, values in at_corners.items()}
        stores = stores[0], {name: values[whole] for name, values in stores[1].items()}
        faces = faces.chosen(whole)
    unused = np.setdiff1d(np.arange(len(points)), faces.corners)
    if not at_corners:
        return Parts(points, faces, *stores)
    rows = np.column_stack([faces.corners, *at_corners.values()]).astype(np.float64)
    every = np.concatenate([rows, np.pad(unused[:, None], ((0, 0), (0, rows.shape[1] - 1)))])
    _, kept, corners = np.unique(every.view(np.int64), axis=0, return_index=True, return_inverse=True)
    order = np.argsort(every[kept, 0], kind="stable")
    made = every[kept[order]]
    places = made[:, 0].astype(np.int32)
    data = {name: values[places] for name, values in stores[0].items()}
    ends = np.cumsum([1, *(values.shape[1] for values in at_corners.values())])
    for (name, values), begin, end in zip(at_corners.items(), ends, ends[1:], strict=False):
        data[name] = made[:, begin:end].astype(values.dtype)
    number = np.argsort(order)[corners.ravel()[: len(rows)]].astype(np.int32)
    return Parts(points[places], Polygons(number, faces.sizes), data | {PLACE: places}, stores[1])


def by_points(parts: Parts) -> tuple[IntArray, IntArray, Data]:
    """(p,) a vertex for each point of a file, in order, (n,) the point of each vertex, and data that all agree on."""
    whole = np.arange(len(parts.points), dtype=np.int32)
    if PLACE not in parts.vertex_data:
        return whole, whole, parts.vertex_data
    places, point = alike(np.column_stack([parts.vertex_data[PLACE], parts.points]))
    others = {name: values for name, values in parts.vertex_data.items() if name != PLACE}
    kept = {name: values[places] for name, values in others.items() if np.array_equal(values[places][point], values)}
    return places, point, kept
