"""Custom normals and pinned edges through the operator, and kinds of mesh that keep the rest."""

import bpy
import numpy as np
import pytest

import meshes
from extension import module

UPPER = 1e-3  # centres above this height are in the upper half


def spoil(obj: bpy.types.Object, faces: meshes.Mask, seed: int = 0) -> None:
    """Squash the free vertices and shake them: the result may not depend on them."""
    points = meshes.positions(obj)
    free = meshes.free_vertices(obj, faces)
    random = np.random.default_rng(seed)
    points[free, 2] *= 0.2
    points[free] += random.normal(0.0, 0.01, (int(free.sum()), 3))
    meshes.move(obj, points)


def upper_half(obj: bpy.types.Object) -> meshes.Mask:
    return meshes.faces_where(obj, lambda centre: centre.z > UPPER)


def off_sphere(points: meshes.Floats) -> float:
    return float(np.abs(np.linalg.norm(points, axis=1) - 1.0).max())


def test_custom_normals() -> None:
    obj = meshes.sphere()
    upper = upper_half(obj)
    exact = meshes.positions(obj)
    spoil(obj, upper)
    obj.data.normals_split_custom_set_from_vertices(exact.tolist())
    meshes.fair(obj, upper, boundary_normals="CUSTOM")
    # Blender keeps custom normals as two 16-bit angles: good to about 2π / 65536.
    assert off_sphere(meshes.positions(obj)) < 2e-4


@pytest.mark.parametrize("kind", ["SHARP", "SEAM", "CREASE"])
def test_pinned_edges(kind: str) -> None:
    obj = meshes.grid()
    inner = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7)
    points = meshes.positions(obj)
    middle = np.abs(points[:, 0]) < 1e-6
    rise = middle & (np.abs(points[:, 1]) < 0.6)
    points[rise, 2] = 0.125  # a float32 too
    meshes.move(obj, points)
    _mark(obj, middle, kind)
    meshes.fair(obj, inner, pin_edges=kind, fair_pinned_edges=False)
    result = meshes.positions(obj)
    assert result[middle].tobytes() == points[middle].tobytes()
    assert (meshes.free_vertices(obj, inner) & ~middle).sum() == meshes.report().free_vertices


def _mark(obj: bpy.types.Object, vertices: meshes.Mask, kind: str) -> None:
    marked = np.array([vertices[list(edge.vertices)].all() for edge in obj.data.edges])
    if kind == "CREASE":
        layer = obj.data.attributes.new("crease_edge", "FLOAT", "EDGE")
        layer.data.foreach_set("value", marked.astype(float).tolist())
    else:
        name = "use_edge_sharp" if kind == "SHARP" else "use_seam"
        obj.data.edges.foreach_set(name, marked.tolist())


# Modifiers, multiresolution, open borders, mixed faces: the base mesh is faired, the rest stays.
def evaluated(obj: bpy.types.Object) -> meshes.Floats:
    """The positions that the modifiers make."""
    bpy.context.view_layer.update()
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    shown.to_mesh_clear()
    return flat.reshape(-1, 3).astype(np.float64)


def test_multiresolution_detail_stays() -> None:
    obj, faces = meshes.domed_grid()
    modifier = obj.modifiers.new("Multires", "MULTIRES")
    for _ in range(2):
        bpy.ops.object.multires_subdivide(modifier=modifier.name)
    before = evaluated(obj)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert (modifier.total_levels, len(evaluated(obj))) == (2, len(before))
    changed = np.abs(evaluated(obj) - before).max(axis=1) > 1e-6
    # the rim's limit surface depends on two rings of the base around it, no more
    far = np.abs(before[:, :2]).max(axis=1) > 0.99
    assert changed.any()
    assert not changed[far].any()


def test_selection_and_modes_stay() -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    bpy.context.tool_settings.mesh_select_mode = (True, False, True)
    meshes.run()
    assert tuple(bpy.context.tool_settings.mesh_select_mode) == (True, False, True)
    assert bpy.context.mode == "EDIT_MESH"
    meshes.leave()
    assert [p.select for p in obj.data.polygons] == faces.tolist()


@pytest.mark.parametrize("triangles", [True, False])
def test_triangles_are_those_that_blender_makes(triangles: bool) -> None:
    """Read without Blender's own list where all faces are triangles."""
    obj = meshes.sphere(16)
    if triangles:
        meshes.edit(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.quads_convert_to_tris()
        meshes.leave()
    mesh = obj.data
    read = module("mesh.mesh_io").read_shown_mesh(obj, module("options.options").FairOptions())
    mesh.calc_loop_triangles()
    assert read.triangles.tolist() == [list(triangle.vertices) for triangle in mesh.loop_triangles]
    assert read.triangle_faces.tolist() == [triangle.polygon_index for triangle in mesh.loop_triangles]


def test_flags_are_read_where_they_are_set_and_where_none_is() -> None:
    """Hidden faces and sharp edges: Blender keeps no attribute for what is true nowhere."""
    obj = meshes.grid(4)
    columns = module("mesh.columns")
    assert not columns.flags(obj.data, ".hide_poly", obj.data.polygons).any()
    assert len(columns.flags(obj.data, "sharp_edge", obj.data.edges)) == len(obj.data.edges)
    obj.data.polygons[3].hide = True
    obj.data.edges[5].use_edge_sharp = True
    assert np.flatnonzero(columns.flags(obj.data, ".hide_poly", obj.data.polygons)).tolist() == [3]
    assert np.flatnonzero(columns.flags(obj.data, "sharp_edge", obj.data.edges)).tolist() == [5]
