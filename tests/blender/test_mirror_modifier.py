"""X mirror, and half an object with a Mirror modifier: both sides are faired as one."""

from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix

import meshes


def half_dome() -> tuple[bpy.types.Object, meshes.Mask]:
    """The half x ≤ 0 of a dome on a grid, crumpled where it is selected, with a Mirror modifier."""
    steps = np.linspace(-1.0, 1.0, 13)
    points = np.array([(x, y, 0.0) for y in steps for x in steps[:7]])
    x, y = points[:, 0].copy(), points[:, 1].copy()
    points[:, 2] = np.sqrt(4.0 - x**2 - y**2)
    faces = [(k, k + 1, k + 8, k + 7) for k in range(12 * 7) if k % 7 < 6]
    obj = meshes.add(points, faces)
    chosen = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    inside = np.maximum(np.abs(x), np.abs(y)) < 0.6
    points[inside] += np.random.default_rng(5).normal(0.0, 0.03, (int(inside.sum()), 3))
    points[x == 0.0, 0] = 0.0
    meshes.move(obj, points)
    modifier = obj.modifiers.new("Mirror", "MIRROR")
    modifier.use_axis = (True, False, False)
    return obj, chosen


def off_sphere(obj: bpy.types.Object) -> float:
    return float(np.abs(np.linalg.norm(meshes.positions(obj), axis=1) - 2.0).max())


def on_plane(obj: bpy.types.Object) -> Any:
    return meshes.positions(obj).reshape(13, 7, 3)[:, 6]


def test_the_dome_comes_back_over_the_seam() -> None:
    obj, faces = half_dome()
    seam = on_plane(obj)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert off_sphere(obj) < 1e-4
    np.testing.assert_array_equal(on_plane(obj)[:, 0], 0.0)
    np.testing.assert_array_equal(on_plane(obj)[[0, 1, 11, 12]], seam[[0, 1, 11, 12]])
    assert (meshes.report().verdict, meshes.report().free_vertices) == ("GOOD", 4 * 7)


@pytest.mark.parametrize("setting", ["show_viewport", "use_mirror_merge", "use_axis"])
def test_without_a_modifier_that_joins_the_halves_the_seam_stays(setting: str) -> None:
    obj, faces = half_dome()
    setattr(obj.modifiers[0], setting, (False, True, False) if setting == "use_axis" else False)
    seam = on_plane(obj)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    np.testing.assert_array_equal(on_plane(obj), seam)


def test_the_plane_may_be_another_objects() -> None:
    obj, faces = half_dome()
    other = bpy.data.objects.new("Plane", None)
    bpy.context.collection.objects.link(other)
    other.matrix_world = obj.matrix_world = Matrix.LocRotScale((1.0, 2.0, 3.0), Euler((0.3, 0.4, 0.5)), (1.0, 1.0, 1.0))
    obj.modifiers[0].mirror_object = other
    bpy.context.view_layer.update()
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert off_sphere(obj) < 1e-4
    np.testing.assert_allclose(on_plane(obj)[:, 0], 0.0, atol=1e-6)


def seen(obj: bpy.types.Object) -> Any:
    """The mesh as the modifier shows it, as a bmesh."""
    bm = bmesh.new()
    bpy.context.view_layer.update()
    bm.from_object(obj, bpy.context.evaluated_depsgraph_get())
    bm.normal_update()
    return bm


def bends(bm: Any) -> Any:
    """Degrees by which the edges bend, and how far these are from the plane."""
    edges = [edge for edge in bm.edges if len(edge.link_faces) == 2]
    angles = np.degrees([edge.calc_face_angle() for edge in edges])
    return angles, np.array([abs(0.5 * (edge.verts[0].co.x + edge.verts[1].co.x)) for edge in edges])


@pytest.mark.parametrize("quads", [False, True])
def test_a_new_mesh_is_half_of_the_whole_ones(quads: bool) -> None:
    obj, faces = half_dome()
    before = meshes.positions(obj)
    assert meshes.fair(obj, faces, remesh=True, quads=quads, spacing=0.7) == {"FINISHED"}
    points = meshes.positions(obj)
    assert (points[:, 0] <= 0.0).all()
    assert off_sphere(obj) < 2e-3
    outside = ~((before[:, 0] > -0.6) & (np.abs(before[:, 1]) < 0.6))
    there = {tuple(row) for row in points.tolist()}
    assert all(tuple(row) in there for row in before[outside].tolist())
    bm = seen(obj)
    assert all(len(edge.link_faces) == 2 or abs(edge.verts[0].co.y) == 1.0 or abs(edge.verts[0].co.x) == 1.0
               for edge in bm.edges)  # fmt: skip
    angles, away = bends(bm)
    assert angles[away < 0.05].max() < 1.5 * angles[away > 0.1].max()
    bm.free()


def test_seams_and_keys_of_half_a_mesh_stay() -> None:
    """A seam inside moves with the surface, and a key that follows the Basis goes along."""
    obj, faces = half_dome()
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Up")
    for point in key.data:
        point.co.z += 1.0
    obj.active_shape_key_index = 0
    for edge in obj.data.edges:
        edge.use_seam = all(v // 7 == 6 for v in edge.vertices)  # the middle row
    from bl_ext.user_default.intrinsic_fairing import fair_mesh

    fair_mesh(obj.data, np.flatnonzero(faces).tolist(), remesh=True)
    points = meshes.positions(obj)
    assert (points[:, 0] <= 0.0).all()
    assert sum(edge.use_seam for edge in obj.data.edges) >= 6
    up = np.array([point.co[:] for point in obj.data.shape_keys.key_blocks["Up"].data])
    np.testing.assert_allclose(up - points, np.tile([0.0, 0.0, 1.0], (len(points), 1)), atol=1e-4)


def half_box() -> bpy.types.Object:
    """The half x ≥ 0 of a box, open at x = 0, with a Mirror modifier."""
    corners = [(x, y, z) for x in (0.0, 1.0) for y in (-1.0, 1.0) for z in (-0.5, 0.5)]
    faces = [(4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    obj = meshes.add(np.array(corners), faces)
    obj.modifiers.new("Mirror", "MIRROR")
    return obj


def select_edges(obj: bpy.types.Object, chosen: Callable[[Any, Any], bool]) -> None:
    meshes.select_edges(obj, lambda edge: chosen(*(vertex.co for vertex in edge.verts)))


@pytest.mark.parametrize("quads", [False, True])
def test_a_fillet_goes_on_through_the_plane(quads: bool) -> None:
    """Report 07: no thorn, and the corner at the plane is gone."""
    obj = half_box()
    select_edges(obj, lambda a, b: a.z > 0.4 and b.z > 0.4 and max(a.x, b.x) > 0.5)
    assert bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", True, width=0.2, quads=quads) == {"FINISHED"}
    meshes.leave()
    points = meshes.positions(obj)
    assert np.linalg.norm(points - [0.0, 1.0, 0.5], axis=1).min() > 0.05
    assert points[:, 0].min() == 0.0
    bm = seen(obj)
    assert all(len(edge.link_faces) == 2 for edge in bm.edges)
    angles, away = bends(bm)
    assert angles[away < 0.12].max() < 1.3 * angles[(away > 0.3) & (away < 0.7)].max()
    bm.free()


def test_roughness_goes_over_the_plane() -> None:
    obj, faces = half_dome()
    meshes.enter(obj, faces)
    assert bpy.ops.mesh.fair_denoise("EXEC_DEFAULT", True) == {"FINISHED"}
    meshes.leave()
    np.testing.assert_array_equal(on_plane(obj)[:, 0], 0.0)
    bm = seen(obj)
    angles, away = bends(bm)
    assert angles[away < 0.02].max() < 1.5 * angles[away > 0.1].max()
    bm.free()


def test_curves_and_their_images_get_one_surface() -> None:
    """Half of three rings: the half of a tube."""
    turns = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 17)
    rings = [np.stack([np.cos(turns), np.sin(turns), np.full(17, z)], axis=1) for z in (-1.0, 0.0, 1.0)]
    points = np.concatenate(rings)
    points[np.abs(points[:, 0]) < 1e-9, 0] = 0.0
    edges = [(17 * r + k, 17 * r + k + 1) for r in range(3) for k in range(16)]
    edges += [(17 * r + k, 17 * r + 17 + k) for r in range(2) for k in (0, 4, 12, 16)]
    mesh = bpy.data.meshes.new("Curves")
    mesh.from_pydata(points.tolist(), edges, [])
    obj = bpy.data.objects.new("Curves", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.modifiers.new("Mirror", "MIRROR")
    select_edges(obj, lambda a, b: True)
    assert bpy.ops.mesh.fair_from_curves("EXEC_DEFAULT", True) == {"FINISHED"}
    meshes.leave()
    assert meshes.positions(obj)[:, 0].min() == 0.0
    assert np.abs(np.hypot(*meshes.positions(obj)[:, :2].T) - 1.0).max() < 5e-3
    bm = seen(obj)
    assert sum(edge.is_boundary for edge in bm.edges) == 64  # the rims
    bm.free()


def test_a_face_in_the_plane_is_refused_by_name() -> None:
    obj = half_box()
    with meshes.rebuilt(obj) as bm:
        bm.faces.new([bm.verts.new((0.0, y, z)) for y, z in ((5.0, 0.0), (6.0, 0.0), (5.0, 1.0))])
    select_edges(obj, lambda a, b: a.z > 0.4 and b.z > 0.4 and min(a.x, b.x) < 0.5 < max(a.x, b.x))
    with pytest.raises(RuntimeError, match="A face lies in the Mirror modifier's plane"):
        bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", True, width=0.2)


# X mirror: a symmetric selection gives an exactly symmetric result.
def symmetric_dome() -> tuple[bpy.types.Object, meshes.Mask]:
    """A grid whose outside is symmetric to the bit and whose inside is not."""
    obj = meshes.grid(12)
    points = meshes.positions(obj)
    x, y = points[:, 0].copy(), points[:, 1].copy()
    points[:, 2] = 0.3 * np.cos(2.0 * np.abs(x)) + 0.1 * np.sin(4.0 * y) + 0.05 * y**2
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    free = meshes.free_vertices(obj, faces)
    points[free] += np.random.default_rng(5).normal(0.0, 0.05, (int(free.sum()), 3))
    meshes.move(obj, np.where(free[:, None], points, points.round(5)))
    return obj, faces


def asymmetry(obj: bpy.types.Object) -> float:
    rows = meshes.positions(obj).reshape(13, 13, 3)
    return float(np.abs(rows - rows[:, ::-1] * (-1.0, 1.0, 1.0)).max())


@pytest.mark.parametrize("run", [bpy.ops.mesh.fair_region, bpy.ops.mesh.fair_denoise], ids=["region", "denoise"])
@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (2.0, 0.5, 1.0), (-1.0, 1.0, 1.0)])
def test_result_is_symmetric_to_the_bit(scale: tuple[float, float, float], run: Any) -> None:
    obj, faces = symmetric_dome()
    obj.matrix_world = Matrix.LocRotScale((1.0, 2.0, 3.0), Euler((0.3, 0.4, 0.5)), scale)
    bpy.context.view_layer.update()
    obj.data.use_mirror_x = True
    assert asymmetry(obj) > 0.05
    meshes.enter(obj, faces)
    assert run("EXEC_DEFAULT", True) == {"FINISHED"}
    meshes.leave()
    assert asymmetry(obj) == 0.0
    assert "mirror" not in meshes.report().warnings


def cube() -> bpy.types.Object:
    """Without a vertex at x = 0."""
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.data.use_mirror_x = True
    return bpy.context.object


def test_one_edge_stands_for_both() -> None:
    """Report 08."""
    obj = cube()
    select_edges(obj, lambda a, b: min(a.x, b.x, a.z, b.z) > 0.0)
    assert bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", True, width=0.3) == {"FINISHED"}
    meshes.leave()
    points = meshes.positions(obj)
    assert np.count_nonzero(points[:, 0] > 0.5) == np.count_nonzero(points[:, 0] < -0.5) > 50
    flipped = points * (-1.0, 1.0, 1.0)
    assert max(np.linalg.norm(points - each, axis=1).min() for each in flipped) < 2e-5


def test_a_new_mesh_is_symmetric_to_the_bit() -> None:
    obj, faces = symmetric_dome()
    obj.data.use_mirror_x = True
    group = obj.vertex_groups.new(name="Left")
    group.add([v.index for v in obj.data.vertices if v.co.x < -0.01], 1.0, "REPLACE")
    assert meshes.fair(obj, faces, remesh=True, spacing=0.8) == {"FINISHED"}
    points = meshes.positions(obj)
    there = {tuple(row + 0.0) for row in points}
    assert {tuple(row * (-1.0, 1.0, 1.0) + 0.0) for row in points} == there
    for vertex in obj.data.vertices:  # each side keeps its own data
        weight = sum(each.weight for each in vertex.groups)
        assert weight == 0.0 if vertex.co.x > 0.2 else weight > 0.9 if vertex.co.x < -0.2 else True


@pytest.mark.parametrize("both", [True, False])
def test_one_hole_stands_for_both(both: bool, capfd: pytest.CaptureFixture[str]) -> None:
    """Where the other side has no hole, a warning says so."""
    obj = meshes.remove(meshes.sphere(48), lambda c: (abs(c.x) if both else c.x) > 0.9)
    obj.data.use_mirror_x = True
    meshes.edit(obj)
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    bm = bmesh.from_edit_mesh(obj.data)
    for vertex in bm.verts:
        vertex.select_set(vertex.is_boundary and vertex.co.x > 0.0)
    assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True) == {"FINISHED"}
    meshes.leave()
    with meshes.rebuilt(obj, write=False) as filled:
        assert not any(edge.is_boundary for edge in filled.edges)
    assert ("faces around are not symmetric" in "".join(capfd.readouterr())) != both
