"""Closed forms through the operator: half a sphere, given only what lies around it, comes back.

A cubic fitted to the surroundings is of third order in slopes: with 48 and 96 edges on the rim its
normals are 0.27° and 0.037° off (measured), 4.7e-3 and 6.4e-4 rad. Normals that all lean by δ
make another cap through the same rim, off by less than δ times the radius: those are the bounds.
"""

import bpy
import numpy as np
import pytest

import meshes

UPPER = 1e-3  # centres above this height are in the upper half
BOUND = {48: 4.7e-3, 96: 6.4e-4}


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


@pytest.mark.parametrize("rim", [48, 96])
def test_hemisphere_from_its_surroundings(rim: int) -> None:
    obj = meshes.sphere(rim)
    upper = upper_half(obj)
    spoil(obj, upper)
    assert off_sphere(meshes.positions(obj)) > 0.5
    assert meshes.fair(obj, upper) == {"FINISHED"}
    assert off_sphere(meshes.positions(obj)) < BOUND[rim]
    assert meshes.report().converged
    assert meshes.report().boundary_angle < 1.0


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
