"""Fair copies: the original keeps its bits, the copy follows modifiers, shape keys and animation, renders included."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module
from test_restoration import spoil, upper_half


def growing_sphere() -> bpy.types.Object:
    """A sphere whose upper half is spoilt and a vertex group; a shape key doubles its size from frame 1 to 11."""
    obj = meshes.sphere(48)
    upper = upper_half(obj)
    spoil(obj, upper)
    inside = sorted({v for face in np.flatnonzero(upper) for v in obj.data.polygons[face].vertices})
    obj.vertex_groups.new(name="Cap").add(inside, 1.0, "REPLACE")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Large")
    key.data.foreach_set("co", 2.0 * meshes.positions(obj).ravel())
    for value, frame in ((0.0, 1), (1.0, 11)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(1)
    return obj


def copy_of(obj: bpy.types.Object) -> bpy.types.Object:
    bpy.context.view_layer.objects.active = obj
    assert bpy.ops.object.fair_copy() == {"FINISHED"}
    copy = bpy.context.view_layer.objects.active
    assert copy != obj
    return copy


def radii(obj: bpy.types.Object) -> Any:
    return np.linalg.norm(meshes.positions(obj), axis=1)


def test_a_copy_follows_and_the_original_keeps_its_bits() -> None:
    obj = growing_sphere()
    before = meshes.contents(obj)
    copy = copy_of(obj)
    for frame, radius in ((1, 1.0), (11, 2.0), (6, None), (1, 1.0)):
        bpy.context.scene.frame_set(frame)
        expected = radius or np.median(radii(copy))
        assert 1.0 <= expected <= 2.0
        np.testing.assert_allclose(radii(copy), expected, atol=2e-4)
    assert meshes.contents(obj) == before
    assert obj.hide_render


def test_a_copy_has_what_modifiers_make() -> None:
    obj = growing_sphere()
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 1
    copy = copy_of(obj)
    assert len(copy.data.polygons) == 4 * len(obj.data.polygons)
    assert np.ptp(radii(copy)) < 0.01
    obj.data.shape_keys.key_blocks["Basis"].data[0].co.z -= 0.1
    obj.modifiers["Subdivision"].levels = 0
    assert bpy.ops.object.fair_copies_update() == {"FINISHED"}
    assert len(copy.data.polygons) == len(obj.data.polygons)


def test_renders_show_the_copy_of_their_frame(tmp_path: Path) -> None:
    """The original is hidden there: without the tie Blender would not evaluate it."""
    obj = growing_sphere()
    obj.modifiers.new("Subdivision", "SUBSURF").render_levels = 1
    copy = copy_of(obj)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.frame_start, scene.frame_end, scene.frame_step = 1, 11, 10
    scene.render.filepath = str(tmp_path / "frame")
    seen: list[tuple[int, float]] = []

    def look(*_arguments: Any) -> None:
        seen.append((len(copy.data.polygons), float(np.median(radii(copy)))))

    bpy.app.handlers.render_post.append(look)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.render_post.remove(look)
    assert [faces for faces, _ in seen] == 2 * [4 * len(obj.data.polygons)]
    np.testing.assert_allclose([radius for _, radius in seen], [1.0, 2.0], rtol=1e-2)


def test_without_its_modifier_a_copy_stays() -> None:
    copy = copy_of(growing_sphere())
    copy.modifiers.clear()
    before = meshes.contents(copy)
    bpy.context.scene.frame_set(11)
    assert meshes.contents(copy) == before
    assert not bpy.ops.object.fair_copies_update.poll()


def test_what_has_no_usable_surface_is_refused() -> None:
    obj = growing_sphere()
    last = bpy.context.window_manager.operator_properties_last("mesh.fair_region")
    last.equation, last.bulge = "CONSTANT", 0.3
    count = len(bpy.data.objects)
    try:
        with pytest.raises(RuntimeError, match="of its bulge"):
            bpy.ops.object.fair_copy()
    finally:
        last.property_unset("equation")
        last.property_unset("bulge")
    assert len(bpy.data.objects) == count
    assert not obj.hide_render
    copy = copy_of(obj)
    options = copy[module("follow.copies").OPTIONS]
    options = options.replace('"equation": "AUTOMATIC"', '"equation": "CONSTANT"').replace(
        '"bulge": 0.0', '"bulge": 0.3'
    )
    copy[module("follow.copies").OPTIONS] = options
    bpy.ops.object.fair_copies_update()
    np.testing.assert_allclose(meshes.positions(copy), meshes.positions(obj), atol=1e-6)  # shows the original


def test_options_of_another_version_do_not_stop_the_frame() -> None:
    obj = growing_sphere()
    copy = copy_of(obj)
    name = module("follow.copies").OPTIONS
    copy[name] = '{"load": 1.0, ' + copy[name][1:]
    bpy.context.scene.frame_set(11)
    np.testing.assert_allclose(radii(copy), 2.0, atol=4e-4)
    copy[name] = "[]"
    bpy.context.scene.frame_set(1)
    np.testing.assert_allclose(meshes.positions(copy), meshes.positions(obj), atol=1e-6)  # shows the original
