"""A patch on a new mesh in Blender: new faces come, the old ones go, and what belonged to these is carried over."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bmesh
import bpy
import numpy as np

from ..core.arrays import Ints
from ..core.remeshing import Remeshed
from ..core.rounding import Rounded
from .columns import elements_of
from .free_normals import renew
from .new_faces import FaceData, VertexData, kinds, make_faces, make_vertices, refuse_doubles
from .selecting import select_new_faces
from .target import Target, in_edit_mode, in_object_mode


@dataclass(frozen=True)
class Written:
    """What a mesh has after a run: numbers of its faces and vertices as they are now."""

    face_count: int
    faces: Ints  # that are new
    spots: Ints  # vertices of the verdict that are still there


def write_edit_mesh(obj: bpy.types.Object, outcome: Remeshed | Rounded) -> Written:
    """Replace the patch of an object in edit mode and select what is new."""
    with in_edit_mode(obj) as target:
        return _replace(target, outcome)


def write_mesh(mesh: bpy.types.Mesh, outcome: Remeshed | Rounded) -> None:
    """Replace the patch of a mesh in object mode: that of its Basis, which the keys relative to it follow."""
    with in_object_mode(mesh) as target:
        bm, shapes = target.bm, target.shapes
        bm.verts.ensure_lookup_table()
        moved = elements_of(bm.verts, outcome.vertices)
        offsets = shapes.offsets(moved)
        _replace(target, outcome)
        if shapes.follow:
            shapes.write(moved, offsets, np.array([vertex.co[:] for vertex in moved]).reshape(-1, 3))


@dataclass(frozen=True)
class _Old:
    """Elements of the mesh as it was, and what the new faces are made of."""

    spots: list[Any]
    gone: list[Any]  # faces
    edges: set[Any]  # of these
    lost: list[Any]  # vertices
    stay: list[Any]  # vertices
    new: FaceData


def _read(target: Target, outcome: Remeshed | Rounded) -> _Old:
    """Look all of them up; raises MeshRefusal."""
    bm, part = target.bm, outcome.part
    for table in (bm.verts, bm.faces):
        table.ensure_lookup_table()
        table.index_update()
    gone, stay = elements_of(bm.faces, part.gone_faces), elements_of(bm.verts, part.stay)
    new = _face_data(target, outcome, stay)
    refuse_doubles(bm, new)
    return _Old(
        spots=elements_of(bm.verts, np.setdiff1d(outcome.verdict.spots, part.gone_vertices)),
        gone=gone,
        edges={edge for face in gone for edge in face.edges},
        lost=elements_of(bm.verts, part.gone_vertices),
        stay=stay,
        new=new,
    )


def _replace(target: Target, outcome: Remeshed | Rounded) -> Written:
    bm, old = target.bm, _read(target, outcome)
    if target.open():
        old = _read(target, outcome)
    on_lines = old.stay[outcome.part.fixed_count :]
    vertices = make_vertices(target, _vertex_data(bm, outcome))
    for vertex, place in zip(on_lines, outcome.positions.tolist(), strict=True):
        vertex.co = place
    faces = make_faces(target, vertices, old.new)
    _delete(bm, old)
    select_new_faces(bm, faces[outcome.unselected :])
    bm.normal_update()
    renew(bm, [*vertices, *on_lines], faces)
    bm.verts.index_update()
    bm.faces.index_update()
    numbers = np.array([face.index for face in faces], dtype=np.int64)
    return Written(len(bm.faces), numbers, np.array([vertex.index for vertex in old.spots], dtype=np.int64))


def _delete(bm: Any, old: _Old) -> None:
    bmesh.ops.delete(bm, geom=old.gone, context="FACES_ONLY")
    bmesh.ops.delete(bm, geom=old.lost, context="VERTS")
    bare = [edge for edge in old.edges if edge.is_valid and not edge.link_faces]
    bmesh.ops.delete(bm, geom=bare, context="EDGES")


def _vertex_data(bm: Any, outcome: Remeshed | Rounded) -> VertexData:
    """Return what the new vertices are made of: the vertices of the triangles that they lie on."""
    part = outcome.part
    used, local = np.unique(part.vertices.sources, return_inverse=True)
    stencil = type(part.vertices)(local.reshape(part.vertices.sources.shape), part.vertices.weights)
    sources = elements_of(bm.verts, used)
    before = stencil.mean(np.array([vertex.co[:] for vertex in sources]).reshape(-1, 3))
    examples = elements_of(bm.verts, part.vertices.heaviest)
    return VertexData(outcome.new_positions, sources, stencil.mean, examples, before, limit=outcome.limit_total)


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
