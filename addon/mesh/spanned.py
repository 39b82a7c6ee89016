"""New faces over edges that have none, and which of these are selected."""

from __future__ import annotations

import bmesh
import bpy
import numpy as np

from ..arrays.types import Mask
from ..curves.spanning import Spanned
from ..fill.report import Added
from .columns import elements_of
from .free_normals import renew
from .new_faces import VertexData, make_vertices
from .selecting import select_new_faces
from .target import in_edit_mode


def selected_wires(mesh: bpy.types.Mesh) -> Mask:
    """Return the (e,) mask of the selected edges of a mesh in edit mode that have no face."""
    edges = bmesh.from_edit_mesh(mesh).edges
    return np.array([edge.select and not edge.hide and edge.is_wire for edge in edges], dtype=bool)


def add_to_edit_mesh(obj: bpy.types.Object, spanned: Spanned) -> Added:
    """Add a surface to a mesh in edit mode and select it alone.

    They are smooth but for creases, of the active material; what belongs to vertices is carried over from the curves.
    """
    with in_edit_mode(obj, spanned.whole) as target:
        target.open()
        bm = target.bm
        bm.verts.ensure_lookup_table()
        held = elements_of(bm.verts, spanned.boundary)
        examples = [held[number] for number in spanned.near.tolist()]
        data = VertexData(
            spanned.positions, held, spanned.carried, examples
        )  # fmt: skip
        vertices = make_vertices(target, data)
        table = [*held, *vertices]
        made = []
        for polygon in spanned.faces.polygons:
            face = bm.faces.new([table[corner] for corner in polygon])
            face.smooth, face.material_index = True, max(0, obj.active_material_index)
            made.append(face)
        for a, b in spanned.creases.tolist():
            bm.edges.get((table[a], table[b])).smooth = False
        vertices, made = target.mirror.kept([(vertices, made)])
        select_new_faces(bm, made)
        bm.normal_update()
        renew(bm, vertices, made)
        return Added(len(vertices), len(made), 0, 0, 0.0, is_symmetric=target.mirror.is_met)
