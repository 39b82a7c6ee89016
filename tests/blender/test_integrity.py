"""What fairing leaves alone, bit for bit; undo."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

import meshes


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


def test_all_but_free_positions_keep_their_bits() -> None:
    obj, faces = meshes.domed_grid()
    decorate(obj)
    before = meshes.in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    changed = meshes.moved(before, meshes.contents(obj))
    np.testing.assert_array_equal(changed, meshes.free_vertices(obj, faces))


@pytest.mark.parametrize("active", [0, 1])
def test_shape_keys(active: int) -> None:
    obj, faces = meshes.domed_grid()
    for name in ("Basis", "Smile", "Frown"):
        obj.shape_key_add(name=name)
    points = meshes.positions(obj)
    keys = obj.data.shape_keys.key_blocks
    keys["Smile"].data.foreach_set("co", (points + np.array([0.0, 0.0, 0.25])).astype(np.float32).ravel())
    obj.active_shape_key_index = active
    before = meshes.in_edit_mode_once(obj, faces)
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


def test_linked_duplicates_and_several_objects() -> None:
    first, faces = meshes.domed_grid()
    second, _ = meshes.domed_grid()
    twin = bpy.data.objects.new("Twin", first.data)
    bpy.context.collection.objects.link(twin)
    for obj in (first, second):
        meshes.select(obj, faces)
    meshes.edit(first, second, twin)
    assert meshes.run() == {"FINISHED"}
    assert meshes.report().free_vertices == 2 * int(meshes.free_vertices(first, faces).sum())
    meshes.leave()
    assert meshes.positions(first).tobytes() == meshes.positions(second).tobytes()


def test_loose_parts_are_left_alone() -> None:
    obj, faces = meshes.domed_grid()
    with meshes.rebuilt(obj) as bm:
        first = bm.verts[0]
        bm.edges.new((bm.verts.new((5.0, 5.0, 5.0)), first))
        bm.verts.new((6.0, 6.0, np.inf))
    before = meshes.in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    changed = meshes.moved(before, meshes.contents(obj))
    np.testing.assert_array_equal(changed, meshes.free_vertices(obj, faces))
