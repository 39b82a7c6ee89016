"""Which border is selected in edit mode, and new faces over it with what belongs to them.

What has a mean is carried over from the boundary; all else is copied from the nearest vertex or face there.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Floats, Mask
from ..fill.pieces import Filled, Piece
from ..fill.report import Added
from ..mirror.reflected import Whole
from ..remesh.unwrapping import SAME, RimUVs, Surface, unwrapped
from .columns import elements_of
from .free_normals import renew
from .layers import OF_CORNERS, MeanLayers, Shapes
from .new_faces import FaceData, VertexData, kinds, make_faces, make_vertices, refuse_doubles
from .selecting import select_new_faces
from .target import Target, in_edit_mode, in_object_mode


def border_seeds(mesh: bpy.types.Mesh) -> Mask:
    """Return the (n,) mask of the border vertices that the selection of a mesh in edit mode names.

    In vertex mode selected vertices do, else the ends of selected edges.
    """
    bm = bmesh.from_edit_mesh(mesh)
    if "VERT" in bm.select_mode:
        return np.array([vertex.select and vertex.is_boundary for vertex in bm.verts], dtype=bool)
    seeds = np.zeros(len(bm.verts), dtype=bool)
    bm.verts.index_update()
    for edge in bm.edges:
        if edge.select and edge.is_boundary:
            seeds[[vertex.index for vertex in edge.verts]] = True
    return seeds


def add_to_edit_mesh(obj: bpy.types.Object, filled: Filled) -> Added:
    """Add the surfaces to a mesh in edit mode and select them alone; nothing else about the mesh changes."""
    with in_edit_mode(obj, filled.whole) as target:
        return _add(target, filled)


def add_to_mesh(mesh: bpy.types.Mesh, filled: Filled) -> Added:
    """Add the surfaces to a mesh in object mode, to its Basis where it has shape keys."""
    with in_object_mode(mesh, filled.whole) as target:
        return _add(target, filled)


def _add(target: Target, filled: Filled) -> Added:
    rims, new = _read(target, filled.pieces)
    if target.open():
        rims, new = _read(target, filled.pieces)
    return _made(target, rims, new, filled.whole)


def _made(target: Target, rims: list[_Rim], new: list[FaceData], whole: Whole | None) -> Added:
    bm = target.bm
    vertices, faces = target.mirror.kept([rim.fill(target, data) for rim, data in zip(rims, new, strict=True)])
    select_new_faces(bm, faces)
    bm.normal_update()
    renew(bm, vertices, faces)
    mixed = np.concatenate([rim.mixed for rim in rims])
    return Added(
        vertices=len(vertices),
        faces=len(faces),
        mixed=len(mixed if whole is None else whole.own(mixed)),
        seams=sum(rim.seams for rim in rims),
        distortion=max((rim.distortion for rim in rims), default=0.0),
        is_symmetric=target.mirror.is_met,
    )


def _read(target: Target, pieces: list[Piece]) -> tuple[list[_Rim], list[FaceData]]:
    """Read all before the first is written, as tables of vertices don't last; raises MeshRefusal."""
    bm = target.bm
    bm.faces.index_update()
    bm.verts.index_update()
    vertices = list(bm.verts)
    rims = [_Rim(bm, piece, vertices) for piece in pieces]
    new = [rim.data(target) for rim in rims]
    for data in new:
        refuse_doubles(bm, data)
    return rims, new


class _Rim:
    """The boundary of one surface, in a mesh that it will be part of."""

    def __init__(self, bm: Any, piece: Piece, vertices: list[Any]) -> None:
        self._piece = piece
        self._vertices = elements_of(vertices, piece.boundary)
        self._drawn = elements_of(vertices, piece.across.drawn)
        self._around = elements_of(vertices, piece.around.vertices)
        following, before = piece.following.tolist(), np.argsort(piece.following).tolist()
        self._faces = [_border_face(self._vertices[i], self._vertices[j]) for i, j in enumerate(following)]
        self._after = [_corner(self._faces[i], vertex) for i, vertex in enumerate(self._vertices)]
        self._before = [_corner(self._faces[before[i]], vertex) for i, vertex in enumerate(self._vertices)]
        layers = MeanLayers(bm.loops.layers, OF_CORNERS)
        after, other = (np.nan_to_num(layers.read(side)) for side in (self._after, self._before))
        names = layers.uv_names
        self._own = 2 * len(names)  # columns from which on values are carried
        self.mixed = piece.boundary[(np.abs(after - other)[:, self._own :] > SAME).any(axis=1)]
        self._rims = [
            RimUVs(after[:, 2 * k : 2 * k + 2], other[:, 2 * k : 2 * k + 2], self._mirrored(bm.loops.layers.uv[name]))
            for k, name in enumerate(names)
        ]
        surface = Surface(piece.points, piece.triangles, piece.rims)
        self._maps = [unwrapped(surface, rim) for rim in self._rims]
        self.seams = max((len(flat.seams) for flat in self._maps), default=0)
        active = bm.loops.layers.uv.active
        self.distortion = 0.0 if active is None else self._maps[layers.uv_names.index(active.name)].distortion

    def fill(self, target: Target, data: FaceData) -> tuple[list[Any], list[Any]]:
        """Make vertices, then faces; return both."""
        piece = self._piece
        near, _ = piece.examples()
        there = len(self._drawn)
        examples = [self._vertices[number] for number in near[there:].tolist()]
        new = VertexData(
            piece.positions[there:], self._vertices, lambda values: piece.carried(values)[there:], examples, None,
            self._keyed,
        )  # fmt: skip
        vertices = make_vertices(target, new)
        made = make_faces(target, vertices, data)
        table = [*data.stay, *vertices]
        for a, b in piece.across.sharp.tolist():
            edge = target.bm.edges.get((table[a], table[b]))
            edge.smooth = False
        for rim, flat in zip(self._rims, self._maps, strict=True):
            if self._is_marked(rim):
                for a, b in flat.seams.tolist():
                    target.bm.edges.get((table[a], table[b])).seam = True
        return vertices, made

    def data(self, target: Target) -> FaceData:
        """Return what the new faces are made of."""
        piece = self._piece
        _, of_face = piece.examples()
        seams = np.concatenate([np.empty((0, 2), dtype=np.int64), *(flat.seams for flat in self._maps)])
        faces = piece.faces(kinds(target, self._faces, self._after)[of_face], seams)
        return FaceData(
            stay=[*self._vertices, *self._drawn],
            polygons=faces.polygons,
            sources=self._after + self._before,
            carry=self._corner_values,
            numbers=faces.corners.tolist(),
            corner_examples=[self._after[number] for number in of_face[faces.corners // 3].tolist()],
            examples=[self._faces[number] for number in of_face[faces.triangles].tolist()],
        )

    def _keyed(self, shapes: Shapes, starts: Floats, offsets: Floats) -> Floats:
        """Return (k, 3 keys): offsets of the keys' own surfaces from the starts (k, 3) of the new vertices."""
        if not shapes.width or len(self._piece.across.edges):
            return offsets
        here = np.array([vertex.co[:] for vertex in self._around])
        keys = [slice(3 * k, 3 * k + 3) for k in range(shapes.width // 3)]
        there = shapes.offsets(self._around)
        found = self._piece.keyed([here + there[:, key] for key in keys], [starts + offsets[:, key] for key in keys])
        moved = offsets.copy()
        for key, places in zip(keys, found, strict=True):
            if places is not None:
                moved[:, key] = places - starts
        return moved

    def _mirrored(self, layer: Any) -> Mask:
        """Return the (r,) mask of border faces that are turned over in a UV map."""
        return np.array([_flat_area([corner[layer].uv for corner in face.loops]) < 0.0 for face in self._faces])

    def _is_marked(self, rim: RimUVs) -> bool:
        """Return whether seams of UVs that reach the boundary are marked as such."""
        ends = [self._vertices[number] for number in np.flatnonzero(rim.broken).tolist()]
        return any(edge.seam for vertex in ends for edge in vertex.link_edges if not edge.is_boundary)

    def _corner_values(self, values: Floats) -> Floats:
        """Return (3 m, w): the values at the corners of new triangles."""
        after, before = np.split(values[:, self._own :], 2)
        mean = np.where(after == before, after, 0.5 * (after + before))
        carried = np.concatenate([mean, self._piece.carried(mean)])[self._piece.triangles.ravel()]
        return np.concatenate([*(flat.corners for flat in self._maps), carried], axis=1)


def _flat_area(places: Sequence[Any]) -> float:
    """Return twice the area of a polygon in the plane, positive counter-clockwise."""
    area: float = sum(a.cross(b) for a, b in zip(places, [*places[1:], places[0]], strict=True))
    return area


def _border_face(tail: Any, head: Any) -> Any:
    (edge,) = (edge for edge in tail.link_edges if edge.other_vert(tail) == head and edge.is_boundary)
    return edge.link_faces[0]


def _corner(face: Any, vertex: Any) -> Any:
    return next(corner for corner in face.loops if corner.vert == vertex)
