"""Which border is selected in edit mode, and new faces over it with what belongs to them.

What has a mean is carried over from the outline; all else is copied from the nearest vertex or face there.
"""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

from ..core.arrays import Floats, Mask
from ..core.fill_report import Added
from ..core.filling import Piece
from ..core.quality import texture_distortion
from .layers import OF_CORNERS, MeanLayers, Shapes, in_object_mode
from .new_faces import FaceData, VertexData, kinds, make_faces, make_vertices, refuse_doubles
from .selecting import select_new_faces


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


def add_to_edit_mesh(obj: bpy.types.Object, pieces: list[Piece]) -> Added:
    """Add the surfaces to a mesh in edit mode and select them alone; nothing else about the mesh changes."""
    bm = bmesh.from_edit_mesh(obj.data)
    added = _add(bm, Shapes(bm, obj.data.shape_keys, obj.active_shape_key), pieces)
    bmesh.update_edit_mesh(obj.data)
    return added


def add_to_mesh(mesh: bpy.types.Mesh, pieces: list[Piece]) -> Added:
    """Add the surfaces to a mesh in object mode, to its Basis where it has shape keys."""
    with in_object_mode(mesh) as (bm, shapes):
        return _add(bm, shapes, pieces)


def _add(bm: Any, shapes: Shapes, pieces: list[Piece]) -> Added:
    bm.verts.ensure_lookup_table()
    # All are read before the first is written: tables of vertices don't last.
    rims = [_Rim(bm, piece) for piece in pieces]
    new = [rim.data(bm) for rim in rims]
    for data in new:
        refuse_doubles(bm, data)
    faces = [face for rim, data in zip(rims, new, strict=True) for face in rim.fill(bm, shapes, data)]
    select_new_faces(bm, faces)
    bm.normal_update()
    areas = [rim.distortion for rim in rims]
    return Added(len(faces), sum(rim.seams for rim in rims), max(areas, default=0.0))


class _Rim:
    """The outline of one surface, in a mesh that it is on its way into."""

    def __init__(self, bm: Any, piece: Piece) -> None:
        self._piece = piece
        self._vertices = [bm.verts[vertex] for vertex in piece.outline.tolist()]
        following = piece.following.tolist()
        self._faces = [_border_face(self._vertices[i], self._vertices[j]) for i, j in enumerate(following)]
        before = np.argsort(piece.following).tolist()
        self._after = [_corner(self._faces[i], vertex) for i, vertex in enumerate(self._vertices)]
        self._before = [_corner(self._faces[before[i]], vertex) for i, vertex in enumerate(self._vertices)]
        after, other = (MeanLayers(bm.loops.layers, OF_CORNERS).read(side) for side in (self._after, self._before))
        self.seams = int(np.count_nonzero((np.abs(after - other) > 1e-6).any(axis=1)))
        self.distortion = 0.0

    def fill(self, bm: Any, shapes: Shapes, data: FaceData) -> list[Any]:
        """Make vertices, then faces; return the faces."""
        piece = self._piece
        near, _ = piece.examples()
        examples = [self._vertices[number] for number in near.tolist()]
        vertices = make_vertices(bm, shapes, VertexData(piece.positions, self._vertices, piece.carried, examples))
        made = make_faces(bm, vertices, data)
        self.distortion = self._distortion(bm, made, data.numbers)
        return made

    def data(self, bm: Any) -> FaceData:
        """Tell what the new faces are made of."""
        piece = self._piece
        _, of_face = piece.examples()
        faces = piece.faces(kinds(bm, self._faces, self._after)[of_face])
        return FaceData(
            stay=self._vertices,
            polygons=faces.polygons,
            sources=self._after + self._before,
            carry=self._corner_values,
            numbers=piece.triangles.ravel()[faces.corners].tolist(),
            corner_examples=[self._after[number] for number in of_face[faces.corners // 3].tolist()],
            examples=[self._faces[number] for number in of_face[faces.triangles].tolist()],
        )

    def _distortion(self, bm: Any, faces: list[Any], numbers: list[int]) -> float:
        layer = bm.loops.layers.uv.active
        if layer is None:
            return 0.0
        places = np.array([corner[layer].uv[:] for face in faces for corner in face.loops]).reshape(-1, 2)
        flat = np.zeros((len(self._piece.points), 3))
        flat[numbers, :2] = places
        return texture_distortion(self._piece.points, flat, self._piece.triangles)

    def _corner_values(self, values: Floats) -> Floats:
        """Return (r + k, w): the values at the corners of new faces, one for each vertex."""
        after, before = np.split(values, 2)
        mean = np.where(after == before, after, 0.5 * (after + before))
        return np.concatenate([mean, self._piece.carried(mean)])


def _border_face(tail: Any, head: Any) -> Any:
    (edge,) = (edge for edge in tail.link_edges if edge.other_vert(tail) == head and edge.is_boundary)
    return edge.link_faces[0]


def _corner(face: Any, vertex: Any) -> Any:
    return next(corner for corner in face.loops if corner.vert == vertex)
