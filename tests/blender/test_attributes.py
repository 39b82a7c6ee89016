"""Attributes of every type on every domain survive, keep their values outside, and get sensible ones inside."""

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
import own_process
from attribute_table import CUT, apply, field, outside, places, read, subject, write

TABLE = """
import attribute_table
found = attribute_table.complaints({act!r}, {mode!r})
assert not found, found
print("done")
"""


ACTS, MODES = ("fill", "fair", "remesh"), ("edit", "object")


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("act", ACTS)
def test_every_type_on_every_domain(act: str, mode: str, tmp_path: Path) -> None:
    """In a process of its own: what is not set aside may end Blender."""
    ended = own_process.run(TABLE.format(act=act, mode=mode), tmp_path, timeout=600.0)
    assert ended.stdout.rstrip().endswith("done")


def ball(act: str, size: int = 48) -> bpy.types.Object:
    """Add a smooth sphere, open above CUT for a fill, blown up there for all else."""
    obj = subject(act, size)
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), dtype=bool))
    if act != "fill":
        points = meshes.positions(obj)
        free = meshes.free_vertices(obj, high(obj))
        points[free] *= 1.15
        meshes.move(obj, points)
    return obj


def high(obj: bpy.types.Object) -> meshes.Mask:
    return meshes.faces_where(obj, lambda centre: centre.z > CUT)


def degrees_off_the_ball(obj: bpy.types.Object, domain: str) -> Any:
    """Return the angles between the free normals and the directions from the middle."""
    normals = read(obj.data.attributes["custom_normal"])
    outward = places(obj.data, domain)
    cosines = (normals * outward).sum(axis=1) / np.linalg.norm(outward, axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))


@pytest.mark.parametrize("domain", ["POINT", "FACE", "CORNER"])
@pytest.mark.parametrize(("act", "mode"), [(act, mode) for act in ACTS for mode in MODES])
def test_free_normals_are_the_new_surfaces_own(act: str, mode: str, domain: str) -> None:
    obj = ball(act)
    outward = np.array([0.6, 0.0, 0.8]) + 0.0 * places(obj.data, domain)
    obj.data.attributes.new("custom_normal", "FLOAT_VECTOR", domain)
    write(obj.data.attributes["custom_normal"], outward)
    stays = outside(obj.data, domain) if act != "fill" else np.ones(len(outward), dtype=bool)
    kept = read(obj.data.attributes["custom_normal"])[stays]
    apply(obj, act, mode)
    values = read(obj.data.attributes["custom_normal"])
    # Fairing keeps the numbers of elements; else those outside come first.
    still = stays if act == "fair" else np.arange(len(values)) < len(kept)
    assert values[still].tobytes() == kept.tobytes()
    np.testing.assert_allclose(np.linalg.norm(values[~still], axis=1), 1.0, atol=1e-5)
    off = degrees_off_the_ball(obj, domain)[~still]
    assert off.max() < 3.0  # 48 edges around: a face's corners are up to 7.5° apart
    assert np.median(off) < 1.0


def test_before_and_after_bring_free_normals_back() -> None:
    obj = ball("fair")
    obj.data.attributes.new("custom_normal", "FLOAT_VECTOR", "CORNER")
    write(obj.data.attributes["custom_normal"], places(obj.data, "CORNER") * [1.0, 0.5, 1.0])
    before = meshes.in_edit_mode_once(obj, high(obj))
    apply(obj, "fair", "edit")
    after = meshes.contents(obj)
    assert before["CORNER custom_normal"] != after["CORNER custom_normal"]
    for expected in (before, after):
        meshes.edit(obj)
        assert bpy.ops.mesh.fair_compare() == {"FINISHED"}
        meshes.leave()
        found = meshes.contents(obj)
        assert [key for key in expected if found[key] != expected[key]] == []


def weighted(groups: int) -> bpy.types.Object:
    """Add an open sphere of which each vertex is in two neighbouring vertex groups, with a sum of 1."""
    obj = ball("fill", 24)
    made = [obj.vertex_groups.new(name=f"Bone{k}") for k in range(groups)]
    for vertex in obj.data.vertices:
        along = (np.arctan2(vertex.co.y, vertex.co.x) / (2.0 * np.pi) + 0.5) * groups
        first, part = int(along) % groups, along - int(along)
        made[first].add([vertex.index], 1.0 - part, "REPLACE")
        made[(first + 1) % groups].add([vertex.index], max(part, 0.01), "REPLACE")
    for vertex in obj.data.vertices:
        total = sum(entry.weight for entry in vertex.groups)
        for entry in vertex.groups:
            entry.weight /= total
    return obj


def memberships(obj: bpy.types.Object, begin: int, groups: set[int]) -> list[list[float]]:
    """Return the weights of the vertices from number `begin` on."""
    return [[e.weight for e in v.groups if e.group in groups] for v in list(obj.data.vertices)[begin:]]


def test_groups_of_no_bone_count_for_nothing() -> None:
    obj = weighted(8)
    obj.vertex_groups.new(name="Mask").add([v.index for v in obj.data.vertices if v.co.x > 0.0], 1e-3, "REPLACE")
    old = len(obj.data.vertices)
    armature = bpy.data.armatures.new("Rig")
    rig = bpy.data.objects.new("Rig", armature)
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for k in range(8):
        armature.edit_bones.new(f"Bone{k}").tail = (0.0, 0.0, 1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    apply(obj, "fill", "edit")
    assert max(map(len, memberships(obj, old, set(range(8))))) == 2
    assert max(map(len, memberships(obj, old, {8}))) == 1


def hung(*vertices: int) -> bpy.types.Object:
    """Add a blown-up sphere with an edge without faces at each of these vertices."""
    obj = ball("remesh", 24)
    with meshes.rebuilt(obj) as bm:
        for vertex in [bm.verts[number] for number in vertices]:
            bm.edges.new((vertex, bm.verts.new(vertex.co * 2.0)))
    return obj


def inner(obj: bpy.types.Object) -> list[int]:
    return np.flatnonzero(meshes.free_vertices(obj, high(obj))).tolist()


@pytest.mark.parametrize(("mode", "every"), [("edit", 20), ("object", 20), ("edit", 1)])
def test_a_new_mesh_keeps_edges_without_faces(mode: str, every: int) -> None:
    chosen = inner(ball("remesh", 24))[::every]
    obj = hung(*chosen)
    apply(obj, "remesh", mode)
    loose = [edge for edge in obj.data.edges if edge.is_loose]
    assert len(loose) == len(chosen) > 1
    used = {v for polygon in obj.data.polygons for v in polygon.vertices}
    assert all(len(used & set(edge.vertices)) == 1 for edge in loose)  # on the surface still
    on_ball = [np.linalg.norm(obj.data.vertices[v].co) for edge in loose for v in edge.vertices if v in used]
    np.testing.assert_allclose(on_ball, 1.0, atol=0.01)


def dressed(act: str, turns: bool) -> bpy.types.Object:
    """Add a sphere with weights, a shape key on a shape key and UVs, with turns on points and corners or without.

    No matrices: where they are not set aside Blender ends, and all other tests with it.
    """
    obj = ball(act, 24)
    obj.vertex_groups.new(name="Half").add([v.index for v in obj.data.vertices if v.co.x > 0.0], 0.5, "REPLACE")
    obj.data.uv_layers.new(name="UV").uv.foreach_set(
        "vector", places(obj.data, "CORNER")[:, :2].astype(np.float32).ravel()
    )
    obj.shape_key_add(name="Basis")
    wide = obj.shape_key_add(name="Wide")
    for point in wide.data:
        point.co.x *= 1.5
    obj.shape_key_add(name="Wider").relative_key = wide
    if turns:
        for domain in ("POINT", "CORNER"):
            obj.data.attributes.new(domain.lower(), "QUATERNION", domain)
            write(obj.data.attributes[domain.lower()], field("QUATERNION", places(obj.data, domain), stepped=False))
    return obj


@pytest.mark.parametrize("key", [0, 1])
@pytest.mark.parametrize(("act", "mode"), [(act, mode) for act in ("fill", "remesh") for mode in MODES])
def test_all_else_is_as_without_what_is_set_aside(act: str, mode: str, key: int) -> None:
    """Turns are taken out and put back, in edit mode by loading the mesh anew: nothing else may tell."""
    found = []
    for turns in (False, True):
        bpy.ops.wm.read_homefile(use_empty=True)
        obj = dressed(act, turns)
        obj.active_shape_key_index = key if mode == "edit" else 0
        apply(obj, act, mode)
        meshes.edit(obj)  # leaving moves keys that are relative to what was edited
        meshes.leave()
        found.append(meshes.contents(obj))
        assert [block.relative_key.name for block in obj.data.shape_keys.key_blocks] == ["Basis", "Basis", "Wide"]
    plain, put_back = found
    assert put_back.keys() - plain.keys() == {"POINT point", "CORNER corner"}
    assert [name for name in plain if plain[name] != put_back[name]] == []


@pytest.mark.parametrize("act", ["fill", "remesh"])
def test_one_step_of_undo_takes_a_reloaded_mesh_back(act: str) -> None:
    obj = dressed(act, turns=True)
    bpy.context.preferences.edit.use_global_undo = True
    before = meshes.in_edit_mode_once(obj, high(obj))
    apply(obj, act, "edit", after=lambda: bpy.ops.ed.undo(), before=lambda: bpy.ops.ed.undo_push())
    found = meshes.contents(bpy.data.objects["Sphere"])
    assert [name for name in before if before[name] != found[name] and "select" not in name] == []
