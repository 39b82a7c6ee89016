"""Fair Denoise in Blender: roughness goes, the shape, borders and sharp edges stay, and nothing else moves."""

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module


def rough_ball(noise: float = 0.01, cut: bool = False) -> bpy.types.Object:
    """A unit ball of 2,562 vertices with noise along the normals; `cut`: without its lower half."""
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=5, radius=1.0)
    if cut:
        bmesh.ops.delete(bm, geom=[v for v in bm.verts if v.co.z < 0.0], context="VERTS")
    rng = np.random.default_rng(4)
    for vertex in bm.verts:
        vertex.co *= 1.0 + noise * float(rng.normal())
    mesh = bpy.data.meshes.new("Ball")
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new("Ball", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    return obj


def run(obj: bpy.types.Object, chosen: Any, **properties: Any) -> set[str]:
    """Run it from and to object mode with these faces selected."""
    meshes.enter(obj, chosen)
    try:
        status: set[str] = bpy.ops.mesh.fair_denoise("EXEC_DEFAULT", True, **properties)
        return status
    finally:
        meshes.leave()


def every(obj: bpy.types.Object) -> Any:
    return np.ones(len(obj.data.polygons), dtype=bool)


def test_an_open_border_and_sharp_edges_keep_their_bits() -> None:
    obj = rough_ball(cut=True)
    meridian = [edge for edge in obj.data.edges if all(abs(obj.data.vertices[v].co.x) < 0.03 for v in edge.vertices)]
    for edge in meridian:
        edge.use_edge_sharp = True
    held = sorted({v for edge in meridian for v in edge.vertices})
    uses = np.bincount([key for polygon in obj.data.polygons for key in _edges(obj, polygon)])
    border = sorted({v for edge, count in zip(obj.data.edges, uses, strict=True) if count == 1 for v in edge.vertices})
    before = meshes.positions(obj)
    assert held and border
    assert run(obj, every(obj)) == {"FINISHED"}
    after = meshes.positions(obj)
    assert np.array_equal(after[held], before[held])
    assert np.array_equal(after[border], before[border])
    assert not np.array_equal(after, before)


def _edges(obj: bpy.types.Object, polygon: Any) -> list[int]:
    return [obj.data.loops[k].edge_index for k in polygon.loop_indices]


def test_size_is_a_length_in_the_world_and_amount_a_share() -> None:
    """Twice the object with twice the size is the same; half the amount moves half as far."""
    small, large, half = (rough_ball() for _ in range(3))
    large.scale = (2.0, 2.0, 2.0)
    before = meshes.positions(small)
    run(small, every(small), size=0.5)
    run(large, every(large), size=1.0)
    run(half, every(half), size=0.5, amount=0.5)
    assert meshes.positions(large) == pytest.approx(meshes.positions(small), abs=1e-6)
    assert meshes.positions(half) == pytest.approx((meshes.positions(small) + before) / 2, abs=1e-6)


def test_scripts_take_a_mesh_and_its_faces() -> None:
    obj = rough_ball()
    before = meshes.positions(obj)
    moved = module("").denoise_mesh(obj.data, size=1.0)
    assert moved == pytest.approx(np.linalg.norm(meshes.positions(obj) - before, axis=1), abs=1e-6)
    with pytest.raises(TypeError, match="sise"):
        module("").denoise_mesh(obj.data, sise=1.0)
    with pytest.raises(ValueError, match="amount"):
        module("").denoise_mesh(obj.data, amount=2.0)
