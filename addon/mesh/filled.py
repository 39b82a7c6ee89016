"""Which border is selected in edit mode, and new faces over it with what belongs to them.

What has a mean is carried over from the outline; all else is copied from the nearest vertex or face there.
"""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np

from ..core.arrays import Floats, Mask
from ..core.filling import Piece
from .live_mesh import LAYER
from .selecting import deselect

_COPIED = ("int", "bool", "string")  # kinds of layers without a mean; BMLoop.copy_from takes Python's handle along
_OWN_NORMALS = "custom_normal"  # directions, which have no mean: new corners have none of their own


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


def check_kept(obj: bpy.types.Object) -> None:
    """Raise ValueError where an object has something that new faces can't be given."""
    if any(modifier.type == "MULTIRES" for modifier in obj.modifiers):
        raise ValueError("A Multiresolution modifier can't be kept: apply or remove it first")


def add_faces(obj: bpy.types.Object, pieces: list[Piece]) -> int:
    """Add the surfaces to a mesh in edit mode and select them alone; nothing else about the mesh changes.

    Returns the number of outline vertices where UVs or other values of the two border faces differ: their mean counts.
    """
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    # All are read before the first is written: tables of vertices don't last.
    writers = [_Writer(bm, obj, piece) for piece in pieces]
    faces = [face for writer in writers for face in writer.write()]
    deselect(bm)
    bm.select_history.clear()
    for face in faces:
        face.select_set(True)
    bm.normal_update()
    bmesh.update_edit_mesh(obj.data)
    return sum(writer.seams for writer in writers)


class _Writer:
    """One surface on its way into a mesh."""

    def __init__(self, bm: Any, obj: bpy.types.Object, piece: Piece) -> None:
        self._bm = bm
        self._piece = piece
        self._rim = [bm.verts[vertex] for vertex in piece.outline.tolist()]
        following = piece.following.tolist()
        self._faces = [_border_face(self._rim[i], self._rim[j]) for i, j in enumerate(following)]
        before = np.argsort(piece.following).tolist()
        self._corners = [
            (_corner(self._faces[i], vertex), _corner(self._faces[before[i]], vertex))
            for i, vertex in enumerate(self._rim)
        ]
        self._shapes = _Shapes(bm, obj)
        self.seams = 0

    def write(self) -> list[Any]:
        """Make vertices, then faces; return the faces."""
        near, of_face = self._piece.examples()
        vertices = self._vertices(near.tolist())
        return self._new_faces(self._rim + vertices, of_face.tolist())

    def _vertices(self, near: list[int]) -> list[Any]:
        layers = _mean_layers(self._bm.verts.layers, ("float", "float_vector", "float_color", "color"))
        groups = self._groups()
        read = [
            np.concatenate([_numbers(vertex, layers), self._weights(vertex, groups), self._shapes.offsets(vertex)])
            for vertex in self._rim
        ]
        values = self._piece.carried(np.array(read))
        widths = _widths(self._rim[0], layers)
        made = []
        for position, example, row in zip(self._piece.positions.tolist(), near, values, strict=True):
            vertex = self._bm.verts.new(position, self._rim[example])
            vertex.hide = False
            _set_numbers(vertex, layers, widths, row)
            at = sum(widths)
            self._set_weights(vertex, groups, row[at : at + len(groups)])
            self._shapes.write(vertex, row[at + len(groups) :])
            made.append(vertex)
        return made

    def _groups(self) -> list[int]:
        layer = self._bm.verts.layers.deform.active
        return [] if layer is None else sorted({group for vertex in self._rim for group in vertex[layer].keys()})  # noqa: SIM118 - not a dictionary

    def _weights(self, vertex: Any, groups: list[int]) -> list[float]:
        layer = self._bm.verts.layers.deform.active
        return [vertex[layer].get(group, 0.0) for group in groups]

    def _set_weights(self, vertex: Any, groups: list[int], weights: Floats) -> None:
        if not groups:
            return
        own = vertex[self._bm.verts.layers.deform.active]
        own.clear()
        for group, weight in zip(groups, weights.tolist(), strict=True):
            if weight > 0.0:
                own[group] = weight

    def _new_faces(self, vertices: list[Any], of_face: list[int]) -> list[Any]:
        corners = self._bm.loops.layers
        layers = _mean_layers(corners, ("uv", "float", "float_vector", "float_color", "color"))
        copied = [layer for kind in _COPIED for layer in getattr(corners, kind, {}).values()]
        widths = _widths(self._corners[0][0], layers)
        values = self._corner_values(layers)
        live = self._bm.faces.layers.int.get(LAYER)
        made = []
        for triangle, example in zip(self._piece.triangles.tolist(), of_face, strict=True):
            face = self._bm.faces.new([vertices[corner] for corner in triangle], self._faces[example])
            face.hide = False
            if live is not None:
                face[live] = 0
            for corner, number in zip(face.loops, triangle, strict=True):
                _copy(self._corners[example][0], corner, copied)
                _set_numbers(corner, layers, widths, values[number])
            made.append(face)
        return made

    def _corner_values(self, layers: list[Any]) -> Floats:
        """Return (r + k, w): the values at the corners of new faces, one for each vertex."""
        after, before = (
            np.array([_numbers(pair[side], layers) for pair in self._corners]).reshape(len(self._rim), -1)
            for side in (0, 1)
        )
        self.seams = int(np.count_nonzero((np.abs(after - before) > 1e-6).any(axis=1)))
        mean = np.where(after == before, after, 0.5 * (after + before))
        return np.concatenate([mean, self._piece.carried(mean)])


class _Shapes:
    """Shape keys: a new vertex is as far from the one that is shown as the outline is."""

    def __init__(self, bm: Any, obj: bpy.types.Object) -> None:
        keys = obj.data.shape_keys
        self._layers = list(bm.verts.layers.shape.values()) if keys is not None else []
        shown = obj.active_shape_key
        # Keys relative to an edited Basis follow it when edit mode ends: till then their layers and its own are old.
        self._old = None
        if shown is not None and keys.use_relative and shown == keys.reference_key:
            self._old = bm.verts.layers.shape.get(shown.name)

    def offsets(self, vertex: Any) -> list[float]:
        start = vertex.co if self._old is None else vertex[self._old]
        return [number for layer in self._layers for number in vertex[layer] - start]

    def write(self, vertex: Any, offsets: Floats) -> None:
        for layer, offset in zip(self._layers, offsets.reshape(-1, 3).tolist(), strict=True):
            vertex[layer] = [a + b for a, b in zip(vertex.co, offset, strict=True)]


def _border_face(tail: Any, head: Any) -> Any:
    (edge,) = (edge for edge in tail.link_edges if edge.other_vert(tail) == head and edge.is_boundary)
    return edge.link_faces[0]


def _corner(face: Any, vertex: Any) -> Any:
    return next(corner for corner in face.loops if corner.vert == vertex)


def _mean_layers(layers: Any, kinds: tuple[str, ...]) -> list[Any]:
    """Return (layer, is it a UV map) for all layers whose values have a mean."""
    return [
        (layer, kind == "uv")
        for kind in kinds
        for layer in getattr(layers, kind).values()
        if layer.name != _OWN_NORMALS
    ]


def _copy(example: Any, element: Any, layers: list[Any]) -> None:
    for layer in layers:
        element[layer] = example[layer]


def _value(element: Any, layer: Any, is_uv: bool) -> Any:
    return element[layer].uv if is_uv else element[layer]


def _numbers(element: Any, layers: list[Any]) -> Floats:
    parts = [np.atleast_1d(np.array(_value(element, *layer), dtype=np.float64)) for layer in layers]
    return np.concatenate([np.empty(0), *parts])


def _widths(element: Any, layers: list[Any]) -> list[int]:
    return [np.size(_value(element, *layer)) for layer in layers]


def _set_numbers(element: Any, layers: list[Any], widths: list[int], row: Floats) -> None:
    at = 0
    for (layer, is_uv), width in zip(layers, widths, strict=True):
        value = row[at : at + width].tolist()
        if is_uv:
            element[layer].uv = value
        else:
            element[layer] = value if width > 1 else value[0]
        at += width
