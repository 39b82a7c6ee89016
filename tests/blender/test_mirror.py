"""X mirror: a symmetric selection gives an exactly symmetric result."""

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix

import meshes


def symmetric_dome() -> tuple[bpy.types.Object, meshes.Mask]:
    """A grid whose outside is symmetric to the bit and whose inside is not."""
    obj = meshes.grid(12)
    points = meshes.positions(obj)
    x, y = points[:, 0].copy(), points[:, 1].copy()
    points[:, 2] = 0.3 * np.cos(2.0 * np.abs(x)) + 0.1 * np.sin(4.0 * y) + 0.05 * y**2
    points[:, 0] = np.sign(x) * np.abs(x)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    free = meshes.free_vertices(obj, faces)
    points[free] += np.random.default_rng(5).normal(0.0, 0.05, (int(free.sum()), 3))
    meshes.move(obj, _even(points, free))
    return obj, faces


def _even(points: Any, free: Any) -> Any:
    """Make the fixed vertices exactly symmetric; rows of the grid run along x."""
    rows = points.astype(np.float32).astype(np.float64).reshape(13, 13, 3)
    mirrored = rows[:, ::-1] * (-1.0, 1.0, 1.0)
    columns = np.arange(13)
    even = np.where((columns > 6)[None, :, None], mirrored, rows)
    even[:, 6, 0] = 0.0
    return np.where(free[:, None], points, even.reshape(-1, 3))


def asymmetry(obj: bpy.types.Object) -> float:
    rows = meshes.positions(obj).reshape(13, 13, 3)
    return float(np.abs(rows - rows[:, ::-1] * (-1.0, 1.0, 1.0)).max())


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (2.0, 0.5, 1.0), (-1.0, 1.0, 1.0)])
def test_result_is_symmetric_to_the_bit(scale: tuple[float, float, float]) -> None:
    obj, faces = symmetric_dome()
    obj.matrix_world = Matrix.LocRotScale((1.0, 2.0, 3.0), Euler((0.3, 0.4, 0.5)), scale)
    bpy.context.view_layer.update()
    obj.data.use_mirror_x = True
    assert asymmetry(obj) > 0.05
    assert meshes.fair(obj, faces) == {"FINISHED"}
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
    meshes.edit(obj)
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    bm = bmesh.from_edit_mesh(obj.data)
    for edge in bm.edges:
        edge.select_set(all(vertex.co.x > 0.0 and vertex.co.z > 0.0 for vertex in edge.verts))
    bm.select_flush_mode()
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
    assert ("new faces are not symmetric" in "".join(capfd.readouterr())) != both
