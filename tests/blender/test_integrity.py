"""What fairing leaves alone, bit for bit; what it refuses; undo."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import meshes
import numpy as np
import pytest


def domed_grid() -> tuple[bpy.types.Object, meshes.Mask]:
    """Add a grid with a bumpy surface; return it and a selection away from the border."""
    obj = meshes.grid()
    points = meshes.positions(obj)
    points[:, 2] = 0.2 * np.cos(2.0 * points[:, 0]) + 0.1 * np.sin(9.0 * points[:, 1])
    meshes.move(obj, points)
    return obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)


def decorate(obj: bpy.types.Object) -> None:
    """Give the mesh every kind of layer that an artist may have on it."""
    mesh = obj.data
    random = np.random.default_rng(3)
    uv = mesh.uv_layers.new(name="UVMap")
    uv.data.foreach_set("uv", random.random(2 * len(mesh.loops)).tolist())
    for kind, domain in (
        ("FLOAT", "POINT"),
        ("FLOAT_COLOR", "CORNER"),
        ("INT", "FACE"),
        ("FLOAT_VECTOR", "POINT"),
        ("BOOLEAN", "EDGE"),
        ("FLOAT2", "CORNER"),
    ):
        layer = mesh.attributes.new(f"layer {kind}", kind, domain)
        name, width, dtype = meshes.LAYOUT[kind]
        values = (random.random(width * len(layer.data)) * 9.0).astype(dtype)
        layer.data.foreach_set(name, values.tolist())
    mesh.color_attributes.new("Paint", "BYTE_COLOR", "CORNER")
    obj.vertex_groups.new(name="Weights").add(range(20), 0.25, "REPLACE")
    mesh.edges[3].use_seam = mesh.edges[5].use_edge_sharp = True
    mesh.materials.append(bpy.data.materials.new("Skin"))
    mesh.polygons[7].use_smooth = False
    mesh.normals_split_custom_set_from_vertices([(0.0, 0.6, 0.8)] * len(mesh.vertices))


def in_edit_mode_once(obj: bpy.types.Object, faces: meshes.Mask) -> dict[str, bytes]:
    """Return the contents after selecting and a visit to edit mode, which may add layers."""
    meshes.select(obj, faces)
    meshes.edit(obj)
    meshes.leave()
    return meshes.contents(obj)


def moved(before: dict[str, bytes], after: dict[str, bytes], name: str = "POINT position") -> Any:
    """Return which vertices changed a bit, asserting that no other layer did."""
    assert before.keys() == after.keys()
    assert [key for key in before if key != name and before[key] != after[key]] == []
    old, new = (np.frombuffer(c[name], np.uint32).reshape(-1, 3) for c in (before, after))
    return (old != new).any(axis=1)


def test_all_but_free_positions_keep_their_bits() -> None:
    obj, faces = domed_grid()
    decorate(obj)
    before = in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    changed = moved(before, meshes.contents(obj))
    np.testing.assert_array_equal(changed, meshes.free_vertices(obj, faces))


def test_factor() -> None:
    results = {}
    for factor in (0.0, 0.5, 1.0):
        obj, faces = domed_grid()
        before = in_edit_mode_once(obj, faces)
        original = meshes.positions(obj)
        meshes.fair(obj, faces, factor=factor)
        if factor == 0.0:
            assert not moved(before, meshes.contents(obj)).any()
        results[factor] = meshes.positions(obj)
    assert np.abs(results[1.0] - original).max() > 0.05
    np.testing.assert_allclose(results[0.5], 0.5 * (original + results[1.0]), atol=1e-7)


def test_undo_and_redo_restore_exactly() -> None:
    obj, faces = domed_grid()
    before = in_edit_mode_once(obj, faces)
    meshes.edit(obj)
    bpy.ops.ed.undo_push(message="before")
    assert meshes.run() == {"FINISHED"}
    fair = contents_in_edit_mode()
    assert moved(before, fair).any()
    bpy.ops.ed.undo()
    assert contents_in_edit_mode() == before
    bpy.ops.ed.redo()
    assert contents_in_edit_mode() == fair


def contents_in_edit_mode() -> dict[str, bytes]:
    """Undo replaces objects: look the grid up again, and visit object mode to read it."""
    assert bpy.context.mode == "EDIT_MESH"
    meshes.leave()
    found = meshes.contents(bpy.data.objects["Grid"])
    bpy.ops.object.mode_set(mode="EDIT")
    return found


def add_nan(obj: bpy.types.Object) -> None:
    points = meshes.positions(obj)
    points[np.abs(points[:, :2]).max(axis=1).argmin()] = np.nan
    meshes.move(obj, points)


def add_tent(obj: bpy.types.Object) -> None:
    """Raise a closed tent on an edge in the middle of the selection: four faces meet there."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    edge = min(bm.edges, key=lambda e: sum(v.co.xy.length for v in e.verts))
    a, b = edge.verts
    tips = [bm.verts.new((0.0, y, 1.0)) for y in (-0.1, 0.1)]
    for face in ((a, b, tips[0]), (b, a, tips[1]), (a, tips[0], tips[1]), (b, tips[1], tips[0])):
        bm.faces.new(face)
    bm.to_mesh(obj.data)
    bm.free()


def flatten(obj: bpy.types.Object) -> None:
    obj.scale = (1.0, 0.0, 1.0)


def nothing(_obj: bpy.types.Object) -> None:
    pass


REFUSED = [
    (add_nan, {}, "finite"),
    (flatten, {}, "scale"),
    (nothing, {"pin_group": "Missing"}, "Missing"),
    (nothing, {"method": "PAPER"}, "method"),
    (nothing, {"equation": "CONSTANT", "bulge": 1.0}, "equation"),
]


@pytest.mark.parametrize(("spoil", "properties", "says"), REFUSED)
def test_refused_runs_leave_no_trace(spoil: Any, properties: Any, says: str) -> None:
    obj, faces = domed_grid()
    spoil(obj)
    before = in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match=says):
        meshes.fair(obj, faces, **properties)
    after = meshes.contents(obj)
    assert [k for k in before if "select" not in k and before[k] != after[k]] == []


def test_refused_run_adds_no_undo_step() -> None:
    obj, faces = domed_grid()
    original = meshes.positions(obj)
    meshes.select(obj, faces)
    meshes.edit(obj)
    bpy.ops.ed.undo_push(message="first")
    bpy.ops.transform.translate(value=(0.0, 0.0, 1.0))
    bpy.ops.ed.undo_push(message="second")
    with pytest.raises(RuntimeError):
        meshes.run(method="PAPER")
    bpy.ops.ed.undo()
    contents_in_edit_mode()
    np.testing.assert_array_equal(meshes.positions(bpy.data.objects["Grid"]), original)


def test_mesh_error_selects_its_vertices() -> None:
    obj, faces = domed_grid()
    add_nan(obj)
    points = meshes.positions(obj)
    with pytest.raises(RuntimeError):
        meshes.fair(obj, faces)
    selected = [v.index for v in obj.data.vertices if v.select]
    assert selected == np.flatnonzero(np.isnan(points).any(axis=1)).tolist()


def test_edge_with_four_faces() -> None:
    obj, _ = domed_grid()
    add_tent(obj)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    before = in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match="NONMANIFOLD_EDGE"):
        meshes.fair(obj, faces)
    after = meshes.contents(obj)
    assert after["POINT position"] == before["POINT position"]
    selected = [v.index for v in obj.data.vertices if v.select]
    assert len(selected) == 2


def test_nothing_selected_is_an_info() -> None:
    obj, faces = domed_grid()
    before = in_edit_mode_once(obj, np.zeros_like(faces))
    assert meshes.fair(obj, np.zeros_like(faces)) == {"CANCELLED"}
    one = np.zeros_like(faces)
    one[0] = True
    assert meshes.fair(obj, one) == {"CANCELLED"}
    assert meshes.contents(obj)["POINT position"] == before["POINT position"]


def test_hidden_faces_stay() -> None:
    obj, faces = domed_grid()
    hidden = meshes.faces_where(obj, lambda c: c.x > 0.3)
    before = in_edit_mode_once(obj, faces)
    meshes.select(obj, faces)
    obj.data.polygons.foreach_set("hide", hidden.tolist())
    meshes.edit(obj)
    assert meshes.run() == {"FINISHED"}
    meshes.leave()
    old, new = (
        np.frombuffer(c["POINT position"], np.uint32).reshape(-1, 3)
        for c in (before, meshes.contents(obj))
    )
    changed = (old != new).any(axis=1)
    expected = meshes.free_vertices(obj, faces & ~hidden)
    np.testing.assert_array_equal(changed, expected)
    assert (np.array([p.hide for p in obj.data.polygons]) == hidden).all()


@pytest.mark.parametrize("active", [0, 1])
def test_shape_keys(active: int) -> None:
    obj, faces = domed_grid()
    for name in ("Basis", "Smile", "Frown"):
        obj.shape_key_add(name=name)
    points = meshes.positions(obj)
    keys = obj.data.shape_keys.key_blocks
    keys["Smile"].data.foreach_set(
        "co", (points + np.array([0.0, 0.0, 0.25])).astype(np.float32).ravel()
    )
    obj.active_shape_key_index = active
    before = in_edit_mode_once(obj, faces)
    meshes.fair(obj, faces)
    after = meshes.contents(obj)
    free = meshes.free_vertices(obj, faces)

    def change(name: str) -> meshes.Floats:
        old, new = (np.frombuffer(c[name], np.float32).reshape(-1, 3) for c in (before, after))
        return new.astype(np.float64) - old

    if active == 1:  # only that key moves
        assert after["key Basis"] == before["key Basis"]
        assert after["key Frown"] == before["key Frown"]
        assert after["POINT position"] == before["POINT position"]
        np.testing.assert_array_equal(change("key Smile").any(axis=1), free)
    else:  # the others follow the basis, as with Blender's own tools
        np.testing.assert_array_equal(change("key Basis").any(axis=1), free)
        np.testing.assert_allclose(change("key Smile"), change("key Basis"), atol=1e-6)
        np.testing.assert_allclose(change("key Frown"), change("key Basis"), atol=1e-6)


def test_locked_shape_key_is_refused() -> None:
    obj, faces = domed_grid()
    obj.shape_key_add(name="Basis").lock_shape = True
    with pytest.raises(RuntimeError, match="locked"):
        meshes.fair(obj, faces)


def test_linked_duplicates_and_several_objects() -> None:
    first, faces = domed_grid()
    second, _ = domed_grid()
    twin = bpy.data.objects.new("Twin", first.data)
    bpy.context.collection.objects.link(twin)
    for obj in (first, second):
        meshes.select(obj, faces)
    meshes.edit(first, second, twin)
    assert meshes.run() == {"FINISHED"}
    assert meshes.report().free_vertices == 2 * int(meshes.free_vertices(first, faces).sum())
    meshes.leave()
    assert meshes.positions(first).tobytes() == meshes.positions(second).tobytes()


def test_one_refused_object_leaves_all_alone() -> None:
    first, faces = domed_grid()
    second, _ = domed_grid()
    add_nan(second)
    before = meshes.positions(first)
    for obj in (first, second):
        meshes.select(obj, faces)
    meshes.edit(first, second)
    with pytest.raises(RuntimeError, match=second.name):
        meshes.run()
    meshes.leave()
    assert meshes.positions(first).tobytes() == before.tobytes()


def test_mirror_option_is_warned_about() -> None:
    obj, faces = domed_grid()
    obj.data.use_mirror_x = True
    meshes.fair(obj, faces)
    assert "mirror" in meshes.report().warnings


def test_loose_parts_are_left_alone() -> None:
    obj, faces = domed_grid()
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    lone = bm.verts.new((5.0, 5.0, 5.0))
    bm.verts.ensure_lookup_table()
    bm.edges.new((lone, bm.verts[0]))
    bm.verts.new((6.0, 6.0, np.inf))
    bm.to_mesh(obj.data)
    bm.free()
    before = in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    changed = moved(before, meshes.contents(obj))
    np.testing.assert_array_equal(changed, meshes.free_vertices(obj, faces))
