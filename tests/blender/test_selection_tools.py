"""What can be done about a selection before a run: loops, left-out faces, bad outlines, the other side."""

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import inspect, module
from test_panel import drawn


def square(obj: bpy.types.Object, half: float = 0.6) -> Any:
    return meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < half)


def bumpy(size: int = 16) -> bpy.types.Object:
    obj = meshes.grid(size)
    points = meshes.positions(obj)
    points[:, 2] = 0.2 * np.cos(2.0 * points[:, 0]) * np.cos(1.5 * points[:, 1])
    meshes.move(obj, points)
    return obj


def chosen_faces(obj: bpy.types.Object) -> list[int]:
    return [face.index for face in bmesh.from_edit_mesh(obj.data).faces if face.select]


def select_loop(obj: bpy.types.Object, faces: Any, kind: str) -> None:
    """Select the outline of the faces in edit mode, by its edges or its vertices."""
    mode = (kind == "VERT", kind == "EDGE", False)
    bpy.context.tool_settings.mesh_select_mode = mode
    bpy.ops.mesh.select_all(action="DESELECT")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.select_mode = {kind}
    inside = {bm.faces[face] for face in np.flatnonzero(faces)} if not bm.faces.ensure_lookup_table() else set()
    for edge in bm.edges:
        if sum(face in inside for face in edge.link_faces) == 1:
            edge.select_set(True)
            for vertex in edge.verts:
                vertex.select_set(True)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("kind", ["EDGE", "VERT"])
def test_a_loop_stands_for_the_faces_inside(kind: str) -> None:
    obj, control = bumpy(), bumpy()
    faces = square(obj)
    meshes.fair(control, faces)
    meshes.edit(obj)
    select_loop(obj, faces, kind)
    assert obj.data.total_face_sel == 0 or kind == "VERT"
    found = module("selection.inspection").inspect(obj, module("options.options").FairOptions())
    assert (found.faces, found.refusal) == (faces.sum(), "")
    assert meshes.run() == {"FINISHED"}
    meshes.leave()
    assert meshes.positions(obj).tobytes() == meshes.positions(control).tobytes()


def test_left_out_faces_are_offered_and_added() -> None:
    obj = bumpy()
    faces = square(obj)
    hole = faces & meshes.faces_where(obj, lambda c: 0.0 < c.x < 0.12 and 0.0 < c.y < 0.12)
    assert hole.sum() == 1
    assert inspect(obj, faces & ~hole).left_out == 1
    assert inspect(obj, faces).left_out == 0
    meshes.enter(obj, faces & ~hole)
    watch = module("selection.watch").watch
    watch.look(bpy.context)
    assert "Add Left-Out Faces" in drawn("VIEW3D_PT_fairing_selection")
    assert bpy.ops.mesh.fair_select(what="LEFT_OUT") == {"FINISHED"}
    assert chosen_faces(obj) == np.flatnonzero(faces).tolist()
    assert bpy.ops.mesh.fair_select(what="LEFT_OUT") == {"CANCELLED"}


def folded() -> tuple[bpy.types.Object, Any]:
    """Add a fine bumpy grid with a fold pressed into one place of a selection's outline."""
    obj = bumpy(24)
    faces = square(obj, 0.5)
    points = meshes.positions(obj)
    near = np.linalg.norm(points[:, :2] - np.array([0.55, 0.0]), axis=1) < 0.12
    points[near] += 0.12 * np.random.default_rng(4).normal(size=(np.count_nonzero(near), 3))
    meshes.move(obj, points)
    return obj, faces


def test_bad_outline_vertices_are_marked_and_selected() -> None:
    obj, faces = folded()
    points = meshes.positions(obj)
    obj.location = (0.0, 0.0, 5.0)
    meshes.enter(obj, faces)
    watch = module("selection.watch").watch
    marks = module("show.marks")
    bpy.context.view_layer.update()
    watch.look(bpy.context)
    ((places, colour),) = marks.shown(bpy.context)
    assert colour == marks.BAD
    text = drawn("VIEW3D_PT_fairing_selection")
    assert {"Bad Vertices", "Select Bad Boundary"} <= set(text.split("\n"))
    assert bpy.ops.mesh.fair_select(what="BAD") == {"FINISHED"}
    bad = [vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select]
    np.testing.assert_allclose(sorted(map(tuple, places)), sorted(map(tuple, points[bad] + [0.0, 0.0, 5.0])), atol=1e-5)
    assert np.abs(points[bad, :2] - [0.5, 0.0]).max() < 0.3
    meshes.leave()
    meshes.enter(obj, faces)
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.context.view_layer.update()
    assert marks.shown(bpy.context) == []  # of another selection


def test_with_x_mirror_one_side_stands_for_both() -> None:
    obj = bumpy(24)
    obj.data.use_mirror_x = True
    right = meshes.faces_where(obj, lambda c: 0.2 < c.x < 0.7 and abs(c.y) < 0.5)
    left = meshes.faces_where(obj, lambda c: -0.7 < c.x < -0.2 and abs(c.y) < 0.5)
    points = meshes.positions(obj)
    points[meshes.free_vertices(obj, right), 2] += 0.1
    meshes.move(obj, points)
    meshes.fair(obj, right)
    after = meshes.positions(obj)
    assert (after[meshes.free_vertices(obj, left)] != points[meshes.free_vertices(obj, left)]).any()
    places = {tuple(p) for p in after.tolist()}
    faired = after[meshes.free_vertices(obj, right | left)]
    assert all((-x, y, z) in places for x, y, z in faired.tolist())
    assert "not symmetric" not in meshes.report().warnings
