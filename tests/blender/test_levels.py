"""Fair Masked on levels of a Multiresolution modifier; dynamic topology."""

from collections.abc import Iterator

import bpy
import numpy as np
import pytest

import meshes
from extension import module

LEVELS = 3


@pytest.fixture(autouse=True)
def back_to_object_mode() -> Iterator[None]:
    yield
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def at(obj: bpy.types.Object, level: int) -> meshes.Floats:
    """Positions of a level, by a copy of the object of which nothing else is asked."""
    copy = obj.copy()
    bpy.context.scene.collection.objects.link(copy)
    copy.modifiers[0].levels = level
    shown = copy.evaluated_get(bpy.context.evaluated_depsgraph_get())
    flat = np.empty(3 * len(shown.data.vertices), dtype=np.float32)
    shown.data.vertices.foreach_get("co", flat)
    bpy.data.objects.remove(copy)
    return flat.reshape(-1, 3).astype(np.float64)


def bumpy(finest: int = LEVELS) -> bpy.types.Object:
    """A coarse ball with levels: its upper part is in a face set and a group, and its finest level has a bump there."""
    obj = meshes.sphere(16)
    top = meshes.faces_where(obj, lambda centre: centre.z > 0.3)
    sets = obj.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    sets.data.foreach_set("value", np.where(top, 7, 3).astype(np.int32))
    inside = sorted({v for face in np.flatnonzero(top) for v in obj.data.polygons[face].vertices})
    obj.vertex_groups.new(name="Top").add(inside, 1.0, "REPLACE")
    modifier = obj.modifiers.new("Levels", "MULTIRES")
    for _ in range(finest):
        bpy.ops.object.multires_subdivide(modifier=modifier.name)
    points = at(obj, finest)
    away = np.linalg.norm(points - [0.0, 0.0, 1.0], axis=1)
    bump = np.flatnonzero(away < 0.4)
    points[bump, 2] += 0.2 * (1.0 - (away[bump] / 0.4) ** 2) ** 2
    module("mesh.levels").write(obj, finest, bump, points[bump])
    return obj


def kinks(points: meshes.Floats) -> float:
    """Largest distance from the sphere of the mean radius in the upper half."""
    radii = np.linalg.norm(points[points[:, 2] > 0.0], axis=1)
    return float(np.ptp(radii))


@pytest.mark.parametrize("source", ["FACE_SET", "VERTEX_GROUP"])
@pytest.mark.parametrize("level", [LEVELS, LEVELS - 1])
def test_the_level_that_is_seen_is_faired(source: str, level: int) -> None:
    obj = bumpy()
    obj.modifiers[0].sculpt_levels = level
    before = [at(obj, k) for k in range(LEVELS + 1)]
    cage = meshes.positions(obj)
    assert kinks(before[level]) > 0.15
    if source == "FACE_SET":
        bpy.ops.object.mode_set(mode="SCULPT")
    obj.modifiers[0].levels = level
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", source=source, face_set=7) == {"FINISHED"}
    assert bpy.context.mode == ("SCULPT" if source == "FACE_SET" else "OBJECT")
    assert obj.modifiers[0].levels == level
    bpy.ops.object.mode_set(mode="OBJECT")
    assert meshes.positions(obj).tobytes() == cage.tobytes()
    assert [o.name for o in bpy.data.objects] == [obj.name]
    assert len(bpy.data.meshes) == 1
    after = at(obj, level)
    assert kinks(after) < 0.02
    far = before[level][:, 2] < 0.0
    # Blender smooths what it carries up to finer levels, and its neighbours; a single shot would move these by 1e-4.
    np.testing.assert_allclose(after[far], before[level][far], atol=2e-6 if level == LEVELS else 3e-5)
    report = meshes.report()
    assert report.written
    assert report.verdict == "GOOD"


def test_undo_of_a_level() -> None:
    obj = bumpy()
    before = at(obj, LEVELS)
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.ed.undo_push(message="start")
    name = obj.name
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", True, source="FACE_SET", face_set=7) == {"FINISHED"}
    assert kinks(at(bpy.data.objects[name], LEVELS)) < 0.02
    bpy.ops.ed.undo()
    assert bpy.context.mode == "SCULPT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert at(bpy.data.objects[name], LEVELS).tobytes() == before.tobytes()


def test_a_new_mesh_on_a_level_is_refused() -> None:
    obj = bumpy()
    before = at(obj, LEVELS)
    with pytest.raises(RuntimeError, match="other faces"):
        bpy.ops.mesh.fair_masked(source="VERTEX_GROUP", group="Top", remesh=True)
    assert at(obj, LEVELS).tobytes() == before.tobytes()


def test_levels_that_simplify_hides_are_refused() -> None:
    obj = bumpy()
    before = at(obj, LEVELS)
    render = bpy.context.scene.render
    render.use_simplify, render.simplify_subdivision = True, LEVELS - 1
    try:
        with pytest.raises(RuntimeError, match="Simplify limits"):
            bpy.ops.mesh.fair_masked(source="VERTEX_GROUP", group="Top")
    finally:
        render.use_simplify = False
    assert [o.name for o in bpy.data.objects] == [obj.name]
    assert at(obj, LEVELS).tobytes() == before.tobytes()


def test_dynamic_topology_is_refused() -> None:
    obj = meshes.sphere(24)
    upper = meshes.faces_where(obj, lambda centre: centre.z > 0.3)
    mask = np.zeros(len(obj.data.vertices), dtype=np.float32)
    for face in np.flatnonzero(upper):
        mask[list(obj.data.polygons[face].vertices)] = 1.0
    obj.data.attributes.new(".sculpt_mask", "FLOAT", "POINT").data.foreach_set("value", mask)
    before = np.sort(meshes.positions(obj), axis=0)
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.sculpt.dynamic_topology_toggle()
    with pytest.raises(RuntimeError, match="turn it off first"):
        bpy.ops.mesh.fair_masked("EXEC_DEFAULT", source="MASK")
    assert obj.use_dynamic_topology_sculpting
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.sort(meshes.positions(obj), axis=0).tobytes() == before.tobytes()
