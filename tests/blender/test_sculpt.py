"""Outside edit mode: masks and face sets in sculpt mode with undo, vertex groups and the live region in object mode."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module
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


def test_half_a_mask_is_no_mask() -> None:
    obj, upper = half_sphere()
    paint_mask(obj, upper)
    values = np.full(len(obj.data.vertices), 0.49, dtype=np.float32)
    obj.data.attributes[".sculpt_mask"].data.foreach_set("value", values)
    before = meshes.contents(obj)
    with pytest.raises(RuntimeError, match="Nothing is masked by half"):
        bpy.ops.mesh.fair_masked(source="MASK")
    assert meshes.contents(obj) == before


def multires(obj: bpy.types.Object) -> None:
    obj.modifiers.new("Multires", "MULTIRES")
    with bpy.context.temp_override(object=obj):
        bpy.ops.object.multires_subdivide(modifier="Multires", mode="CATMULL_CLARK")


def shape_key(obj: bpy.types.Object) -> None:
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Smile")
    obj.active_shape_key_index = 1


REASONS = {"multires": multires, "shape_key": shape_key}


@pytest.mark.parametrize(("spoiler", "says"), [("multires", "no mask of a"), ("shape_key", "'Smile' is active")])
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
