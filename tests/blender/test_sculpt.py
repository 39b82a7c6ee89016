"""Selections before a run, and masks, face sets, groups and the brush outside edit mode."""

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import inspect, module
from test_panel import drawn
from test_restoration import spoil, upper_half


def half_sphere() -> tuple[bpy.types.Object, Any]:
    """Return a sphere whose upper half is spoilt."""
    obj = meshes.sphere(48)
    upper = upper_half(obj)
    spoil(obj, upper)
    return obj, upper


def paint_mask(obj: bpy.types.Object, faces: Any) -> None:
    values = np.zeros(len(obj.data.vertices), dtype=np.float32)
    for face in np.flatnonzero(faces):
        values[list(obj.data.polygons[face].vertices)] = 1.0
    layer = obj.data.attributes.new(".sculpt_mask", "FLOAT", "POINT")
    layer.data.foreach_set("value", values)


def paint_face_sets(obj: bpy.types.Object, faces: Any) -> None:
    layer = obj.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    layer.data.foreach_set("value", np.where(faces, 7, 3).astype(np.int32))


def assert_round(obj: bpy.types.Object) -> None:
    np.testing.assert_allclose(np.linalg.norm(meshes.positions(obj), axis=1), 1.0, atol=1e-5)


@pytest.fixture
def sculpted() -> Any:
    yield
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize("source", ["MASK", "FACE_SET"])
def test_what_is_painted_is_faired_with_undo(sculpted: Any, source: str) -> None:
    obj, upper = half_sphere()
    paint_mask(obj, upper)
    paint_face_sets(obj, upper)
    spoilt = meshes.positions(obj)
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.ed.undo_push(message="start")
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", True, source=source, face_set=7) == {"FINISHED"}
    assert bpy.context.mode == "SCULPT"
    assert_round(obj)
    assert (meshes.report().verdict, meshes.report().written) == ("GOOD", True)
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Sphere"]
    assert bpy.context.mode == "SCULPT"
    assert meshes.positions(obj).tobytes() == spoilt.tobytes()
    assert meshes.report().undone
    bpy.ops.ed.redo()
    assert_round(bpy.data.objects["Sphere"])
    assert not meshes.report().undone
    assert bpy.context.mode == "SCULPT"


def test_the_only_visible_face_set_needs_no_number(sculpted: Any) -> None:
    obj, upper = half_sphere()
    paint_face_sets(obj, upper)
    bpy.ops.object.mode_set(mode="SCULPT")
    with pytest.raises(RuntimeError, match="Several face sets are in sight"):
        bpy.ops.mesh.fair_masked(source="FACE_SET")
    with pytest.raises(RuntimeError, match="No face is in the face set 99"):
        bpy.ops.mesh.fair_masked(source="FACE_SET", face_set=99)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.attributes.remove(obj.data.attributes[".sculpt_face_set"])
    paint_face_sets(obj, np.ones_like(upper))
    painted = __import__("extension").module("mesh.painted")
    assert painted.only_visible_face_set(obj.data) == 7
    assert painted.face_set_at(obj.data, 0) == 7


def test_a_vertex_group_and_the_live_region_in_object_mode() -> None:
    obj, upper = half_sphere()
    inside = sorted({v for face in np.flatnonzero(upper) for v in obj.data.polygons[face].vertices})
    obj.vertex_groups.new(name="Cap").add(inside, 1.0, "REPLACE")
    assert bpy.ops.mesh.fair_masked(source="VERTEX_GROUP", group="Cap") == {"FINISHED"}
    assert_round(obj)
    spoil(obj, upper)
    assert bpy.ops.mesh.fair_masked(source="VERTEX_GROUP") == {"FINISHED"}  # the active one
    assert_round(obj)
    spoil(obj, upper)
    layer = obj.data.attributes.new("fair_live", "INT", "FACE")
    layer.data.foreach_set("value", upper.astype(np.int32))
    assert bpy.ops.mesh.fair_masked(source="LIVE") == {"FINISHED"}
    assert_round(obj)


def multires(obj: bpy.types.Object) -> None:
    obj.modifiers.new("Multires", "MULTIRES")
    with bpy.context.temp_override(object=obj):
        bpy.ops.object.multires_subdivide(modifier="Multires", mode="CATMULL_CLARK")


def shape_key(obj: bpy.types.Object) -> None:
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Smile")
    obj.active_shape_key_index = 1


REASONS = {"multires": multires, "shape_key": shape_key}


@pytest.mark.parametrize(("spoiler", "says"), [("multires", "Masks of a"), ("shape_key", "'Smile' is active")])
def test_what_hides_the_mesh_is_refused(sculpted: Any, spoiler: str, says: str) -> None:
    obj, upper = half_sphere()
    paint_mask(obj, upper)
    REASONS[spoiler](obj)
    before = meshes.positions(obj)
    bpy.ops.object.mode_set(mode="SCULPT")
    with pytest.raises(RuntimeError, match=says):
        bpy.ops.mesh.fair_masked(source="MASK")
    assert bpy.context.mode == "SCULPT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert meshes.positions(obj).tobytes() == before.tobytes()


def test_not_in_edit_mode() -> None:
    obj = meshes.grid()
    meshes.edit(obj)
    assert not bpy.ops.mesh.fair_masked.poll()


def dab(place: Any, reach: float) -> dict[str, Any]:
    return {"name": "", "place": tuple(place), "reach": reach}


def test_a_brush_fairs_what_it_went_over_with_its_falloff(sculpted: Any) -> None:
    """As Fair Masked with that mask; the mesh's own mask protects, and is as it was."""
    pole = np.array([0.0, 0.0, 1.0])
    scripted, obj = meshes.sphere(48), meshes.sphere(48)
    for each in (scripted, obj):
        points = meshes.positions(each)
        points += 0.3 * np.exp(-20.0 * np.linalg.norm(points - pole, axis=1)[:, None] ** 2) * points
        meshes.move(each, points)
    before = meshes.positions(obj)
    weights = np.zeros(len(before))
    module("fair.brush").paint(weights, before, pole, 1.2)
    assert 0.0 < np.count_nonzero((weights > 0.0) & (weights < 1.0)) < len(weights)
    scripted.data.attributes.new(".sculpt_mask", "FLOAT", "POINT").data.foreach_set("value", weights.astype(np.float32))
    bpy.context.view_layer.objects.active = scripted
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", True, source="MASK", use_mask=True) == {"FINISHED"}
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.ed.undo_push(message="start")
    assert bpy.ops.mesh.fair_brush("EXEC_DEFAULT", True, dabs=[dab(pole, 1.2)]) == {"FINISHED"}
    assert bpy.context.mode == "SCULPT"
    after = meshes.positions(obj)
    np.testing.assert_allclose(after, meshes.positions(scripted), atol=1e-6)  # dabs are single precision
    assert (after[weights == 0.0] == before[weights == 0.0]).all()
    assert ".sculpt_mask" not in obj.data.attributes
    name = obj.name
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    np.testing.assert_array_equal(meshes.positions(obj), before)
    mask = (before[:, 0] > 0.2).astype(np.float32)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.attributes.new(".sculpt_mask", "FLOAT", "POINT").data.foreach_set("value", mask)
    bpy.ops.object.mode_set(mode="SCULPT")
    assert bpy.ops.mesh.fair_brush("EXEC_DEFAULT", True, dabs=[dab(pole, 1.2)]) == {"FINISHED"}
    assert (meshes.positions(obj)[mask == 1.0] == before[mask == 1.0]).all()
    kept = np.empty_like(mask)
    obj.data.attributes[".sculpt_mask"].data.foreach_get("value", kept)
    np.testing.assert_array_equal(kept, mask)


def test_a_brush_beside_the_mesh_changes_nothing(sculpted: Any) -> None:
    obj, _ = half_sphere()
    before = meshes.positions(obj)
    bpy.ops.object.mode_set(mode="SCULPT")
    with pytest.raises(RuntimeError, match="painted over by half"):
        bpy.ops.mesh.fair_brush("EXEC_DEFAULT", True, dabs=[dab((0.0, 0.0, 5.0), 0.5)])
    np.testing.assert_array_equal(meshes.positions(obj), before)
    assert ".sculpt_mask" not in obj.data.attributes


# What can be done about a selection before a run: loops, left-out faces, bad boundaries, the other side.
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
    """Select the boundary of the faces in edit mode, by its edges or its vertices."""
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
    """Add a fine bumpy grid with a fold pressed into one place of a selection's boundary."""
    obj = bumpy(24)
    faces = square(obj, 0.5)
    points = meshes.positions(obj)
    near = np.linalg.norm(points[:, :2] - np.array([0.55, 0.0]), axis=1) < 0.12
    points[near] += 0.12 * np.random.default_rng(4).normal(size=(np.count_nonzero(near), 3))
    meshes.move(obj, points)
    return obj, faces


def test_bad_boundary_vertices_are_marked_and_selected() -> None:
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
