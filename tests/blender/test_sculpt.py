"""Outside edit mode: masks and face sets in sculpt mode with undo, vertex groups and the live region in object mode."""

from __future__ import annotations

from typing import Any

import bpy
import meshes
import numpy as np
import pytest
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


@pytest.mark.parametrize(("spoiler", "says"), [("multires", "multiresolution"), ("shape_key", "'Smile' is active")])
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
