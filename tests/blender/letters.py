"""A letter on a bent plate, joined by a boolean: triangles without area, edges of no length, faces of many corners."""

from typing import Any

import bmesh
import bpy
import numpy as np

RADIUS = 1.5  # of the plate's upper side, whose top is at z = 0
THICK = 0.2
HEIGHT = 0.15  # of the letter over the plate's top


def on_plate(letter: str) -> bpy.types.Object:
    """Make it, of size 1."""
    plate = _linked("Plate", _plate(columns=24, rows=2))
    boss = _linked("Boss", _solid(letter))
    joined = plate.modifiers.new("Joined", "BOOLEAN")
    joined.operation, joined.object, joined.solver = "UNION", boss, "EXACT"
    made = bpy.data.meshes.new_from_object(plate.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    plate.modifiers.clear()
    plate.data = made
    bpy.data.objects.remove(boss)
    return plate


def foot(obj: bpy.types.Object) -> Any:
    """(e,) mask of the edges in which the letter meets the plate."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    found = np.array([at_foot(edge) for edge in bm.edges])
    bm.free()
    return found


def at_foot(edge: Any) -> bool:
    """Tell whether the letter meets the plate in this edge of a bmesh."""
    meets = len(edge.link_faces) == 2 and edge.calc_face_angle_signed() < -0.5
    return meets and all(abs(np.hypot(v.co.x, v.co.z + RADIUS) - RADIUS) < 0.01 for v in edge.verts)


def _linked(name: str, mesh: bpy.types.Mesh) -> bpy.types.Object:
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


def _plate(columns: int, rows: int) -> bpy.types.Mesh:
    bm = bmesh.new()
    sides = [
        [
            [bm.verts.new((r * np.sin(t), y, r * np.cos(t) - RADIUS)) for y in np.linspace(-0.9, 0.9, rows + 1)]
            for t in np.linspace(-0.8, 0.8, columns + 1)
        ]
        for r in (RADIUS, RADIUS - THICK)
    ]
    top = [bm.faces.new(_quad(sides[0], k, j)) for k in range(columns) for j in range(rows)]
    below = [bm.faces.new(_quad(sides[1], k, j)[::-1]) for k in range(columns) for j in range(rows)]
    rims = [[edge for edge in bm.edges if edge.is_boundary and edge.link_faces[0] in part] for part in (top, below)]
    bmesh.ops.bridge_loops(bm, edges=rims[0] + rims[1])
    bmesh.ops.recalc_face_normals(bm, faces=bm.faces)
    mesh = bpy.data.meshes.new("Plate")
    bm.to_mesh(mesh)
    bm.free()
    return mesh


def _quad(lines: Any, k: int, j: int) -> list[Any]:
    return [lines[k][j], lines[k + 1][j], lines[k + 1][j + 1], lines[k][j + 1]]


def _solid(letter: str) -> bpy.types.Mesh:
    text = bpy.data.curves.new("Letter", "FONT")
    text.body, text.extrude, text.align_x, text.align_y, text.resolution_u = letter, HEIGHT, "CENTER", "CENTER", 3
    curve = bpy.data.objects.new("Letter", text)
    bpy.context.collection.objects.link(curve)
    mesh = bpy.data.meshes.new_from_object(curve.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    bpy.data.objects.remove(curve)
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bmesh.ops.remove_doubles(bm, verts=bm.verts, dist=1e-6)
    bm.to_mesh(mesh)
    bm.free()
    return mesh
