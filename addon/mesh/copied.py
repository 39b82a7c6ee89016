"""A mesh that is filled again and again with what another object shows."""

from __future__ import annotations

import bmesh
import bpy


def refill(mesh: bpy.types.Mesh, source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> None:
    """Give a mesh in object mode the shape that the source has with its modifiers, shape keys and animation."""
    evaluated = source.evaluated_get(depsgraph)
    bm = bmesh.new()
    try:
        bm.from_mesh(evaluated.to_mesh())
        bm.to_mesh(mesh)
    finally:
        bm.free()
        evaluated.to_mesh_clear()
    mesh.update()
