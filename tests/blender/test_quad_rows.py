"""Fair Fill with Quads: rows go on through the hole, one step of undo takes them back, a refusal changes nothing."""

from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np

import meshes


def pipe(columns: int = 32, rows: int = 20) -> bpy.types.Object:
    """An open cylinder of quads around the z-axis, without those of a window 8 wide and 6 high."""
    turn, height = np.meshgrid(2 * np.pi * np.arange(columns) / columns, np.linspace(-1.5, 1.5, rows + 1))
    points = np.stack([np.cos(turn), np.sin(turn), height], axis=-1).reshape(-1, 3)
    faces = [
        [columns * j + i, columns * j + (i + 1) % columns, columns * (j + 1) + (i + 1) % columns, columns * (j + 1) + i]
        for j in range(rows)
        for i in range(columns)
        if not (8 <= i < 16 and 7 <= j < 13)
    ]
    return meshes.add(points, faces, "Pipe")


def select_border(obj: bpy.types.Object, chosen: Callable[[Any], bool]) -> None:
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    meshes.enter(obj, np.zeros(len(obj.data.polygons), dtype=bool))
    bm = bmesh.from_edit_mesh(obj.data)
    for vertex in bm.verts:
        vertex.select = vertex.is_boundary and chosen(vertex.co)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


def test_an_edge_loop_runs_through() -> None:
    """Select Loop on one edge of the fill reaches both ends of the pipe, and its ring goes all around."""
    obj = pipe()
    select_border(obj, lambda place: abs(place.z) < 1.2)
    assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", quads=True) == {"FINISHED"}
    bm = bmesh.from_edit_mesh(obj.data)
    new = [face for face in bm.faces if face.select]
    assert [len(face.verts) for face in new] == [4] * 48
    assert max(abs(vertex.co.xy.length - 1) for face in new for vertex in face.verts) < 5e-3
    inside = [edge for face in new for edge in face.edges if all(other.select for other in edge.link_faces)]
    upright = [e for e in inside if len({round(v.co.z, 2) for v in e.verts}) == 2]
    for edge in (upright[0], upright[-1]):
        assert _loop_length(edge) == 20
        assert _ring_length(edge) == 32


def _loop_length(edge: Any) -> int:
    """Edges straight on in both directions, over vertices of four edges."""
    count = 1
    for vertex in edge.verts:
        here, at = edge, vertex
        while len(at.link_edges) == 4:
            beside = {other for face in here.link_faces for other in face.edges}
            (here,) = (other for other in at.link_edges if other not in beside)
            at = here.other_vert(at)
            count += 1
    return count


def _ring_length(edge: Any) -> int:
    """Edges opposite to each other, face by face, until the first one comes again."""
    count, here, face = 1, edge, edge.link_faces[0]
    while True:
        here = next(other for other in face.edges if not set(other.verts) & set(here.verts))
        if here == edge:
            return count
        face = next(other for other in here.link_faces if other != face)
        count += 1


def test_a_region_is_meshed_anew_in_rows() -> None:
    """Its rows go on from those around, and its corners carry what the old ones did."""
    obj = pipe()
    select_border(obj, lambda place: abs(place.z) < 1.2)
    assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", quads=True) == {"FINISHED"}
    meshes.leave()
    layer = obj.data.uv_layers.new(name="Map")
    for corner in obj.data.loops:
        layer.uv[corner.index].vector = (obj.data.vertices[corner.vertex_index].co.z, 0.5)
    count = len(obj.data.polygons)
    chosen = [abs(polygon.center.z) < 0.5 and polygon.center.x > 0.3 for polygon in obj.data.polygons]
    meshes.enter(obj, np.array(chosen))
    assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", remesh=True, quads=True) == {"FINISHED"}
    meshes.leave()
    assert [len(polygon.vertices) for polygon in obj.data.polygons] == [4] * count
    for corner in obj.data.loops:
        u = obj.data.uv_layers["Map"].uv[corner.index].vector[0]
        assert abs(u - obj.data.vertices[corner.vertex_index].co.z) < 0.01
    assert "no rows" not in bpy.context.window_manager.fairing_report.warnings
