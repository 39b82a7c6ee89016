"""Subdivide Boundary: long edges of a boundary are parted, with all that belongs to them, and nothing moves."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module


def box(open_top: bool) -> bpy.types.Object:
    """A cube with a UV map and weights that grow with x; the edges around its top are sharp, seams and creased."""
    bpy.ops.mesh.primitive_cube_add(size=2.0, calc_uvs=True)
    obj = bpy.context.object
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    crease = bm.edges.layers.float.new("crease_edge")
    weights = bm.verts.layers.deform.verify()
    for edge in bm.edges:
        if all(vertex.co.z > 0 for vertex in edge.verts):
            edge.smooth, edge.seam, edge[crease] = False, True, 0.5
    for vertex in bm.verts:
        vertex[weights][0] = 0.5 + 0.25 * vertex.co.x
    if open_top:
        top = [face for face in bm.faces if face.normal.z > 0.5]
        bmesh.ops.delete(bm, geom=top, context="FACES_ONLY")
    obj.vertex_groups.new(name="Group")
    bm.to_mesh(obj.data)
    bm.free()
    return obj


def check(obj: bpy.types.Object, pieces: int) -> None:
    """The four sides have more corners; what lies on the top's edges is what Blender's subdivision makes of them."""
    mesh = obj.data
    assert not mesh.validate()
    sides = [polygon for polygon in mesh.polygons if len(polygon.vertices) == 4 + pieces - 1]
    assert len(sides) == 4
    uv = mesh.uv_layers.active.data
    for polygon in sides:
        corners = [(mesh.vertices[mesh.loops[k].vertex_index].co.copy(), uv[k].uv.copy()) for k in polygon.loop_indices]
        flat = np.array([[*co] for co, _ in corners])
        places = np.array([[*at] for _, at in corners])
        basis = np.column_stack([flat, np.ones(len(flat))])
        fit, *_ = np.linalg.lstsq(basis, places, rcond=None)
        assert np.abs(basis @ fit - places).max() < 1e-5  # UVs are linear over each side
    around = [edge for edge in mesh.edges if edge.use_edge_sharp]
    assert len(around) == 4 * pieces
    assert all(edge.use_seam for edge in around)
    creases = np.empty(len(mesh.edges), dtype=np.float32)
    mesh.attributes["crease_edge"].data.foreach_get("value", creases)
    assert creases[[edge.index for edge in around]].tolist() == [0.5] * len(around)
    for vertex in mesh.vertices:
        (entry,) = vertex.groups
        assert entry.weight == pytest.approx(0.5 + 0.25 * vertex.co.x, abs=1e-5)


def old_places(obj: bpy.types.Object) -> Any:
    return meshes.positions(obj)[:8].copy()


@pytest.mark.parametrize("quads", [False, True])
def test_a_coarse_hole(quads: bool) -> None:
    obj = box(open_top=True)
    before = old_places(obj)
    meshes.edit(obj)
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_non_manifold()
    options = {"equation": "SOAP_FILM", "spacing": 0.2, "quads": quads}
    assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True, subdivide_boundary=True, **options) == {"FINISHED"}
    meshes.leave()
    assert meshes.positions(obj)[:8].tobytes() == before.tobytes()
    check(obj, 5)
    new = [polygon for polygon in obj.data.polygons if polygon.select]
    assert len(new) > 20
    assert all(abs(obj.data.vertices[v].co.z - 1.0) < 1e-5 for polygon in new for v in polygon.vertices)
    lengths = [
        (obj.data.vertices[a].co - obj.data.vertices[b].co).length for a, b in (e.vertices for e in edges_of(obj, new))
    ]
    assert max(lengths) < 0.9


def edges_of(obj: bpy.types.Object, polygons: list[Any]) -> list[Any]:
    keys = {key for polygon in polygons for key in polygon.edge_keys}
    return [edge for edge in obj.data.edges if edge.key in keys]


def test_a_coarse_patch_with_a_mesh_of_its_own() -> None:
    obj = box(open_top=False)
    before = old_places(obj)
    top = meshes.faces_where(obj, lambda c: c.z > 0.9)
    meshes.fair(obj, top, mesh="NEW", spacing=0.2, subdivide_boundary=True)
    assert meshes.positions(obj)[:8].tobytes() == before.tobytes()
    check(obj, 5)
    assert len(obj.data.polygons) > 25


def test_a_script_gets_it_without_edit_mode_and_one_undo_takes_it_back() -> None:
    obj = box(open_top=True)
    (result,) = module().fill_mesh(obj.data, equation="SOAP_FILM", spacing=0.5, subdivide_boundary=True)
    assert result.converged
    check(obj, 2)
    other = box(open_top=True)
    meshes.edit(other)
    bpy.ops.mesh.select_mode(type="EDGE")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_non_manifold()
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True, subdivide_boundary=True, equation="SOAP_FILM", spacing=0.5)
    bpy.ops.ed.undo()
    meshes.leave()
    assert len(bpy.context.object.data.vertices) == 8


def test_edges_are_whole_again_after_an_error() -> None:
    """What is refused while it is written leaves a mesh as it was."""
    obj = box(open_top=True)
    before = meshes.contents(obj)
    core, writer = module("core.subdivided"), module("mesh.parted_edges")
    arrays = module("mesh.mesh_io").read_mesh(obj.data, np.arange(4), module("core.options").FairOptions())
    parted = core.with_subdivided_patch(arrays, arrays.positions, 0.3)
    assert len(parted.ends) == 8
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    with pytest.raises(RuntimeError, match="refused"), writer.parted_edges(bm, parted) as vertices:
        assert len(vertices) == len(bm.verts) == 8 + len(parted.ends)
        raise RuntimeError("refused")
    assert (len(bm.verts), len(bm.edges), len(bm.faces)) == (8, 12, 5)
    bm.to_mesh(obj.data)
    bm.free()
    after = meshes.contents(obj)
    assert after["POINT position"] == before["POINT position"]
    assert after["CORNER UVMap"] == before["CORNER UVMap"]
