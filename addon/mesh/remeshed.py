"""A patch on a new mesh in Blender: new faces come, the old ones go, and what belonged to these is carried over."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Ints
from ..fillet.rounding import Rounded
from ..remesh.remeshing import Remeshed
from .columns import elements_of
from .free_normals import renew
from .new_faces import FaceData, VertexData, kinds, make_faces, make_vertices, refuse_doubles
from .selecting import select_new_faces
from .target import Target, in_edit_mode, in_object_mode


@dataclass(frozen=True)
class Written:
    """What a mesh has after a run: numbers of its faces and vertices as they are now."""

    face_count: int
    new_vertices: int
    faces: Ints  # that are new
    spots: Ints  # vertices of the verdict that are still there
    is_symmetric: bool  # as X mirror asks for


def write_edit_mesh(obj: bpy.types.Object, outcome: Remeshed | Rounded) -> Written:
    """Replace the patch of an object in edit mode and select what is new."""
    with in_edit_mode(obj, outcome.whole) as target:
        return _replace(target, outcome)


def write_mesh(mesh: bpy.types.Mesh, outcome: Remeshed | Rounded) -> None:
    """Replace the patch of a mesh in object mode: that of its Basis, which the keys relative to it follow."""
    with in_object_mode(mesh, outcome.whole) as target:
        old = _looked_up(target, outcome)
        offsets = target.shapes.offsets(old.moved)
        _written(target, outcome, old)
        if target.shapes.follow:
            left = np.flatnonzero([vertex.is_valid for vertex in old.moved])  # images are gone
            moved = elements_of(old.moved, left)
            places = np.array([vertex.co[:] for vertex in moved]).reshape(-1, 3)
            target.shapes.write(moved, offsets[left], places)


@dataclass(frozen=True)
class _Old:
    """Elements of the mesh as it was, and what the new faces are made of."""

    spots: list[Any]
    gone: list[Any]  # faces
    edges: set[Any]  # of these
    lost: list[Any]  # vertices
    stay: list[Any]  # vertices
    moved: list[Any]  # of these
    sources: list[Any]  # vertices that new ones are made of,
    examples: list[Any]  # and those that each is like
    cut: list[Any]  # edges of which there are pieces
    new: FaceData


def _read(target: Target, outcome: Remeshed | Rounded) -> _Old:
    """Look all of them up; raises MeshRefusal."""
    bm, part = target.bm, outcome.part
    vertices = list(bm.verts)
    bm.verts.index_update()
    bm.faces.ensure_lookup_table()
    bm.faces.index_update()
    gone, stay = elements_of(bm.faces, part.gone_faces), elements_of(vertices, part.stay)
    new = _face_data(target, outcome, stay)
    refuse_doubles(bm, new)
    return _Old(
        spots=elements_of(vertices, np.setdiff1d(outcome.verdict.spots, part.gone_vertices)),
        gone=gone,
        edges={edge for face in gone for edge in face.edges},
        lost=elements_of(vertices, part.gone_vertices),
        stay=stay,
        moved=stay[part.fixed_count :],
        sources=elements_of(vertices, np.unique(part.vertices.sources)),
        examples=elements_of(vertices, part.vertices.heaviest),
        cut=[bm.edges.get(elements_of(vertices, ends)) for ends in part.cut_from],
        new=new,
    )


def _looked_up(target: Target, outcome: Remeshed | Rounded) -> _Old:
    old = _read(target, outcome)
    return _read(target, outcome) if target.open() else old


def _replace(target: Target, outcome: Remeshed | Rounded) -> Written:
    return _written(target, outcome, _looked_up(target, outcome))


def _written(target: Target, outcome: Remeshed | Rounded, old: _Old) -> Written:
    bm = target.bm
    vertices = make_vertices(target, _vertex_data(old, outcome))
    for vertex, place in zip(old.moved, outcome.positions.tolist(), strict=True):
        vertex.co = place
    faces = make_faces(target, vertices, old.new)
    table = [*old.stay, *vertices]
    for (a, b), edge in zip(outcome.part.cut.tolist(), old.cut, strict=True):
        piece = bm.edges.get((table[a], table[b]))
        if piece is not None:  # diagonals of polygons are none
            piece.copy_from(edge)
    _delete(bm, old)
    pieces = set(faces[: outcome.unselected])
    vertices, faces = target.mirror.kept([(vertices, faces)])
    select_new_faces(bm, [face for face in faces if face not in pieces])
    bm.normal_update()
    renew(bm, [*vertices, *(vertex for vertex in old.moved if vertex.is_valid)], faces)
    bm.verts.index_update()
    bm.faces.index_update()
    numbers = np.array([face.index for face in faces], dtype=np.int64)
    spots = np.array([vertex.index for vertex in old.spots], dtype=np.int64)
    return Written(len(bm.faces), len(vertices), numbers, spots, target.mirror.is_met)


def _delete(bm: Any, old: _Old) -> None:
    bmesh.ops.delete(bm, geom=old.gone, context="FACES_ONLY")
    bmesh.ops.delete(bm, geom=old.lost, context="VERTS")
    bare = [edge for edge in old.edges if edge.is_valid and not edge.link_faces]
    bmesh.ops.delete(bm, geom=bare, context="EDGES")


def _vertex_data(old: _Old, outcome: Remeshed | Rounded) -> VertexData:
    """Return what the new vertices are made of: the vertices of the triangles that they lie on."""
    part = outcome.part
    _, local = np.unique(part.vertices.sources, return_inverse=True)
    stencil = type(part.vertices)(local.reshape(part.vertices.sources.shape), part.vertices.weights)
    before = stencil.mean(np.array([vertex.co[:] for vertex in old.sources]).reshape(-1, 3))
    return VertexData(
        outcome.new_positions, old.sources, stencil.mean, old.examples, before
    )  # fmt: skip


def _face_data(target: Target, outcome: Remeshed | Rounded, stay: list[Any]) -> FaceData:
    """Return what the new faces are made of: the corners of the triangles that they lie on."""
    bm, part = target.bm, outcome.part
    used, local = np.unique(part.corners.sources, return_inverse=True)
    corners = _corners(bm, used)
    stencil = type(part.corners)(local.reshape(part.corners.sources.shape), part.corners.weights)
    old, of_old = np.unique(part.faces, return_inverse=True)
    faces = outcome.faces(kinds(target, elements_of(bm.faces, old))[of_old])
    return FaceData(
        stay=stay,
        polygons=faces.polygons,
        sources=[corners[number] for number in used.tolist()],
        carry=stencil.mean,
        numbers=faces.corners.tolist(),
        corner_examples=[corners[number] for number in part.corners.heaviest[faces.corners].tolist()],
        examples=elements_of(bm.faces, part.faces[faces.triangles]),
        in_live=True,
    )


def _corners(bm: Any, numbers: Ints) -> dict[int, Any]:
    """Return these corners by their numbers in the mesh; some are of faces that stay."""
    ends = np.cumsum([len(face.verts) for face in bm.faces])
    faces = np.searchsorted(ends, numbers, side="right")
    places = (numbers - np.concatenate([[0], ends])[faces]).tolist()
    of = elements_of(bm.faces, faces)
    return {number: face.loops[k] for number, face, k in zip(numbers.tolist(), of, places, strict=True)}
