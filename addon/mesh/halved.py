"""New faces at planes of reflection: the half of what was made over a mesh and its image, or both halves alike."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import bmesh
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree
from mathutils.kdtree import KDTree

from ..arrays.region import Reflection
from ..mirror.reflected import Whole
from ..mirror.symmetry import ACROSS_X, NEAR

SNAPPED = 0.3  # of an edge across the plane: what is nearer goes onto the plane, or there would be slivers

Faces = list[Any]
Made = tuple[list[Any], Faces]  # new vertices, and the faces over these and others


class Mirror:
    """What becomes of new faces of a bmesh at planes of reflection."""

    def __init__(self, bm: Any, whole: Whole | None, across_x: bool) -> None:
        """whole: of which the bmesh has the half; across_x: whether X mirror is on."""
        self._bm, self._whole, self._across_x = bm, whole, across_x
        self._own: set[Any] = set()
        self._images: set[Any] = set()
        self.is_met = True  # False: new faces are not symmetric, though X mirror is on

    @contextmanager
    def images(self) -> Iterator[None]:
        """Let the bmesh have the images of its vertices and faces until `kept`, in the whole's numbers."""
        try:
            if self._whole is not None:
                self._own = set(self._bm.verts)
                _make_images(self._bm, self._whole)
                self._images = set(self._bm.verts) - self._own
            yield
        finally:
            self._drop()

    def _drop(self) -> None:
        gone = [vertex for vertex in self._images if vertex.is_valid]
        bmesh.ops.delete(self._bm, geom=gone, context="VERTS")
        self._images = set()

    def kept(self, made: Sequence[Made]) -> Made:
        """Return what is left of new vertices and faces, surface by surface: the half's, or both halves alike."""
        all_made = _pooled(made)
        old = _vertices(all_made[1]).difference(all_made[0])
        faces = all_made[1]
        if self._whole is not None:
            for plane in map(_Plane, self._whole.planes):
                faces = self._half(plane, (all_made[0], faces))
            self._drop()
        elif self._across_x:
            plane = _Plane(ACROSS_X)
            alone = [(each, self._alike(plane, each)) for each in made]
            faces = [face for _, found in alone for face in found or ()]
            rest = _pooled([each for each, found in alone if found is None])
            together = self._alike(plane, rest) if rest[1] else []
            self.is_met = together is not None
            faces += rest[1] if together is None else together
        return list(_vertices(faces) - old), faces

    def _half(self, plane: _Plane, made: Made) -> Faces:
        inside = sum(plane.height(vertex.co) for vertex in _vertices(made[1]) & self._own)
        faces = _cut(self._bm, plane, made)
        beyond = [face for face in faces if plane.of_face(face) * inside < 0.0]
        self._images |= {vertex for vertex in _vertices(beyond) - self._own if plane.side(vertex.co)}
        return _without(self._bm, faces, beyond)

    def _alike(self, plane: _Plane, made: Made) -> Faces | None:
        """Let the faces x < 0 be the images of the others, with the data that was there; None where they can't be."""
        faces, vertices = made[1], _vertices(made[1])
        near = _Near(vertices)
        if all(near.at(plane.image(vertex.co)) for vertex in vertices):
            return faces
        rim = _rim(faces)
        image = {vertex: near.at(plane.image(vertex.co)) for edge in rim for vertex in edge.verts}
        ends = {frozenset(edge.verts) for edge in rim}
        if {frozenset(map(image.get, pair)) for pair in ends} != ends:
            return None
        faces = _cut(self._bm, plane, made)
        other = [face for face in faces if plane.of_face(face) < 0.0]
        own = [face for face in faces if plane.of_face(face) >= 0.0]
        image |= {vertex: vertex for vertex in _vertices(own) if not plane.side(vertex.co)}
        return [*own, *_images_of(self._bm, plane, own, image, other)]


def _pooled(made: Sequence[Made]) -> Made:
    return [vertex for vertices, _ in made for vertex in vertices], [face for _, faces in made for face in faces]


def _make_images(bm: Any, whole: Whole) -> None:
    mesh, table, faces = whole.mesh, list(bm.verts), list(bm.faces)
    sources, places = whole.sources.tolist(), mesh.positions.tolist()
    for number in range(len(table), len(sources)):
        table.append(bm.verts.new(places[number], table[sources[number]]))
    polygons = np.split(mesh.corner_vertices, np.flatnonzero(np.diff(mesh.corner_faces)) + 1)
    for number in range(len(faces), len(mesh.in_patch)):
        polygon, example = polygons[number].tolist(), faces[number % len(faces)]
        face = bm.faces.new([table[corner] for corner in polygon], example)
        of = {corner.vert: corner for corner in example.loops}
        for corner, vertex in zip(face.loops, polygon, strict=True):
            corner.copy_from(of[table[sources[vertex]]])
    for elements in (bm.verts, bm.edges, bm.faces):
        elements.index_update()
        elements.ensure_lookup_table()


class _Plane:
    """A plane of reflection, in the mesh's own coordinates."""

    def __init__(self, reflection: Reflection) -> None:
        flip = np.eye(3) - reflection.matrix[:3, :3]  # each row leads across the plane
        axis = flip[np.linalg.norm(flip, axis=1).argmax()]
        self._axis = Vector(axis / np.linalg.norm(axis))
        self._height = 0.5 * float(self._axis.dot(reflection.matrix[:3, 3]))
        self._reach = reflection.reach

    def height(self, place: Any) -> float:
        return float(self._axis.dot(place) - self._height)

    def of_face(self, face: Any) -> float:
        return self.height(face.calc_center_median())

    def side(self, place: Any) -> int:
        """Return 1 or -1, and 0 for what lies on the plane."""
        height = self.height(place)
        return 0 if 2.0 * abs(height) <= self._reach else 1 if height > 0.0 else -1

    def on(self, place: Any) -> Any:
        return place - self.height(place) * self._axis

    def image(self, place: Any) -> Any:
        return place - 2.0 * self.height(place) * self._axis

    def foot(self, place: Any, normal: Any) -> Any:
        """Return where the symmetric surface through a place, with this normal, meets the plane."""
        across = normal.dot(self._axis)
        inside = normal - across * self._axis
        return self.on(place) + 0.5 * self.height(place) * across / max(inside.length_squared, 0.25) * inside


class _Near:
    """Finds vertices by where they are."""

    def __init__(self, vertices: set[Any]) -> None:
        self._vertices = list(vertices)
        self._tree = KDTree(len(self._vertices))
        for number, vertex in enumerate(self._vertices):
            self._tree.insert(vertex.co, number)
        self._tree.balance()

    def at(self, place: Any) -> Any:
        """Return the one there; None where there is none."""
        _, number, distance = self._tree.find(place)
        return self._vertices[number] if distance <= NEAR else None


def _vertices(faces: Sequence[Any]) -> set[Any]:
    return {vertex for face in faces for vertex in face.verts}


def _rim(faces: Faces) -> list[Any]:
    """Return the edges around new faces."""
    chosen = set(faces)
    edges = {edge for face in faces for edge in face.edges}
    return [edge for edge in edges if sum(face in chosen for face in edge.link_faces) == 1]


def _move(bm: Any, vertex: Any, place: Any) -> None:
    """Move a vertex in all shape keys."""
    displacement = place - vertex.co
    vertex.co = place
    for layer in bm.verts.layers.shape.values():
        vertex[layer] += displacement


def _cut(bm: Any, plane: _Plane, made: Made) -> Faces:
    """Put edges of new faces where these meet the plane; return the faces, some of them in pieces."""
    new, faces = set(made[0]), made[1]
    most = max(len(face.verts) for face in faces)
    free = new.difference(vertex for edge in _rim(faces) for vertex in edge.verts)
    for face in faces:
        face.normal_update()
    normals = {}
    for vertex in _vertices(faces):
        vertex.normal_update()
        normals[vertex] = vertex.normal.copy()
        if vertex in new and not plane.side(vertex.co):
            _move(bm, vertex, plane.on(vertex.co))
    snapped: set[Any] = set()
    for _, start, share in _crossing(plane, faces):
        near = {other.other_vert(start) for other in start.link_edges}
        if share < SNAPPED and start in free and not snapped & near:
            snapped.add(start)
    for vertex in snapped:
        _move(bm, vertex, plane.foot(vertex.co, normals[vertex]))
        _move(bm, vertex, plane.on(vertex.co))
    done: set[Any] = set()
    for edge, start, share in _crossing(plane, faces):
        if edge not in done:
            done.add(edge)
            place = plane.on(_between(start, edge.other_vert(start), share, normals))
            _, vertex = bmesh.utils.edge_split(edge, start, share)
            _move(bm, vertex, place)
    return [piece for face in faces for piece in _pieces(plane, face, most)]


def _crossing(plane: _Plane, faces: Faces) -> list[tuple[Any, Any, float]]:
    """Return the edges inside new faces that cross the plane, each from both ends, with the share of it before."""
    found = []
    for edge in {edge for face in faces for edge in face.edges}.difference(_rim(faces)):
        a, b = edge.verts
        if plane.side(a.co) * plane.side(b.co) < 0:
            share = plane.height(a.co) / (plane.height(a.co) - plane.height(b.co))
            found += [(edge, a, share), (edge, b, 1.0 - share)]
    return sorted(found, key=lambda each: each[2])


def _between(a: Any, b: Any, share: float, normals: dict[Any, Any]) -> Any:
    """Return a place on the cubic curve between two vertices that is tangent to the surface at both."""
    chord = b.co - a.co
    out, into = (chord - chord.dot(normals[end]) * normals[end] for end in (a, b))
    t, u = share, 1.0 - share
    return (1.0 + 2.0 * t) * u * u * a.co + t * t * (1.0 + 2.0 * u) * b.co + t * u * (u * out - t * into)


def _pieces(plane: _Plane, face: Any, most: int) -> Faces:
    """Return a face in pieces of so many corners at most, each on one side of the plane."""
    corners = list(face.verts)
    sides = [plane.side(corner.co) for corner in corners]
    ends = [k for k, side in enumerate(sides) if side == 0]
    pairs = [(i, j) for i in ends for j in ends if 1 < j - i < len(corners) - 1]
    if not (pairs and min(sides) < 0 < max(sides)):
        if len(corners) <= most:
            return [face]
        pairs = [(0, 2), (1, 3)]
    i, j = min(pairs, key=lambda pair: (corners[pair[0]].co - corners[pair[1]].co).length)
    other, _ = bmesh.utils.face_split(face, corners[i], corners[j])
    return [*_pieces(plane, face, most), *_pieces(plane, other, most)]


def _without(bm: Any, faces: Faces, gone: Faces) -> Faces:
    """Delete faces, and what only they had; return the others."""
    others = set(gone)
    kept = [face for face in faces if face not in others]
    vertices, edges = _vertices(gone), {edge for face in gone for edge in face.edges}
    bmesh.ops.delete(bm, geom=gone, context="FACES_ONLY")
    bare = [edge for edge in edges if edge.is_valid and not edge.link_faces]
    bmesh.ops.delete(bm, geom=bare, context="EDGES")
    lone = [vertex for vertex in vertices if vertex.is_valid and not vertex.link_edges]
    bmesh.ops.delete(bm, geom=lone, context="VERTS")
    return kept


def _images_of(bm: Any, plane: _Plane, faces: Faces, image: dict[Any, Any], there: Faces) -> Faces:
    """Return images of new faces in the place of those that are `there`, whose data they get.

    image: the vertices across the plane that stay.
    """
    numbers = {vertex: number for number, vertex in enumerate(_vertices(there))}
    polygons = [[numbers[vertex] for vertex in face.verts] for face in there]
    tree = BVHTree.FromPolygons([vertex.co for vertex in numbers], polygons)
    image = dict(image)
    for vertex in _vertices(faces) - image.keys():
        place = plane.image(vertex.co)
        near, _, number, _ = tree.find_nearest(place)
        new = image[vertex] = bm.verts.new(place, vertex)
        new.copy_from_face_interp(there[number])
        for layer in bm.verts.layers.shape.values():
            new[layer] += place - near
    made, stays = [], set()
    for face in faces:
        corners = [image[vertex] for vertex in reversed(face.verts)]
        same = bm.faces.get(corners)
        if same is not None:
            stays.add(same)
            made.append(same)
            continue
        example = there[tree.find_nearest(plane.image(face.calc_center_median()))[2]]
        made.append(bm.faces.new(corners, example))
        for corner in made[-1].loops:
            corner.copy_from_face_interp(example, False)
        for edge in face.edges:
            other = bm.edges.get([image[vertex] for vertex in edge.verts])
            if not other.link_faces[1:]:
                other.smooth, other.seam = edge.smooth, edge.seam
    _without(bm, [], [face for face in there if face not in stays])
    return made
