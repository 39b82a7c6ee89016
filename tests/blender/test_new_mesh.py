"""Mesh: New in Blender: other faces for the same surface, what they carry over, and what is left as it was."""

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import extension
import meshes

sys.path.insert(0, str(Path(__file__).parents[2] / "scripts"))

from test_fill import with_a_wide_key

UPPER = 0.45  # faces of the sphere above are selected


def dented() -> tuple[bpy.types.Object, Any]:
    """A unit sphere of 48 segments with a shape key, and the mask of its upper faces."""
    obj = meshes.sphere(48)
    with_a_wide_key(obj)
    heights = np.array([polygon.center.normalized().z for polygon in obj.data.polygons])
    return obj, heights > UPPER


def fair_new(obj: bpy.types.Object, chosen: Any, **properties: Any) -> set[str]:
    """Run it from and to object mode."""
    meshes.enter(obj, chosen)
    try:
        status: set[str] = bpy.ops.mesh.fair_region("EXEC_DEFAULT", True, remesh=True, **properties)
        return status
    finally:
        meshes.leave()


def new_polygons(obj: bpy.types.Object) -> list[Any]:
    return [polygon for polygon in obj.data.polygons if polygon.select]


def inner_vertices(obj: bpy.types.Object) -> Any:
    """Those of new faces only."""
    outside = {v for polygon in obj.data.polygons if not polygon.select for v in polygon.vertices}
    return np.array(sorted({v for polygon in new_polygons(obj) for v in polygon.vertices} - outside))


def test_marks_and_borders_of_materials_stay() -> None:
    obj, chosen = dented()
    mesh = obj.data
    for number in range(2):
        mesh.materials.append(bpy.data.materials.new(f"Material {number}"))
    for polygon in mesh.polygons:
        polygon.material_index = int(polygon.center.x > 0.0)
    for edge in mesh.edges:
        a, b = (mesh.vertices[v].co for v in edge.vertices)
        edge.use_edge_sharp = abs(a.y) < 1e-5 and abs(b.y) < 1e-5
    sharp = sum(edge.use_edge_sharp for edge in mesh.edges)
    assert fair_new(obj, chosen) == {"FINISHED"}
    assert sum(edge.use_edge_sharp for edge in mesh.edges) == sharp
    for polygon in new_polygons(obj):
        assert polygon.material_index == int(polygon.center.x > 0.0)


def test_another_key_than_the_basis_changes_alone() -> None:
    """New vertices of the Basis lie where the old surface was."""
    obj, chosen = dented()
    obj.active_shape_key_index = 1
    obj.data.shape_keys.key_blocks["Wide"].value = 1.0
    assert fair_new(obj, chosen) == {"FINISHED"}
    inner = inner_vertices(obj)
    basis = np.array([point.co[:] for point in obj.data.shape_keys.key_blocks["Basis"].data])
    assert np.abs(np.linalg.norm(basis[inner], axis=1) - 1.0).max() < 0.02


@pytest.mark.parametrize(("uvs", "wave"), [(True, 0.0), (False, 0.1)])
def test_corners_of_the_selection_and_seams_leave_no_loose_ends(uvs: bool, wave: float) -> None:
    """Faces without a vertex inside stay; a new triangle that was there already, along a seam, does not come twice."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, calc_uvs=uvs)
    obj = bpy.context.object
    border = 0.3 if wave == 0.0 else 0.05
    chosen = np.array(
        [polygon.center.z > border + wave * np.sin(7.0 * polygon.center.x) for polygon in obj.data.polygons]
    )
    assert fair_new(obj, chosen) == {"FINISHED"}
    used = {vertex for polygon in obj.data.polygons for vertex in polygon.vertices}
    assert used == set(range(len(obj.data.vertices)))
    triples = [tuple(sorted(polygon.vertices)) for polygon in obj.data.polygons]
    assert len(set(triples)) == len(triples)
    assert np.abs(np.linalg.norm(meshes.positions(obj), axis=1) - 1.0).max() < 2e-3


def test_new_faces_that_come_twice_are_refused_before_any_is_made() -> None:
    """Blender takes no face twice: it would stop halfway."""
    bm = bmesh.new()
    stay = [bm.verts.new((float(x), float(y), 0.0)) for x, y in ((0, 0), (1, 0), (0, 1))]
    new_faces = extension.module("mesh.new_faces")
    once = SimpleNamespace(stay=stay, polygons=[(0, 1, 2), (0, 1, 3), (1, 2, 3)])
    new_faces.refuse_doubles(bm, once)
    twice = SimpleNamespace(stay=stay, polygons=[(0, 1, 3), (1, 2, 3), (3, 1, 0)])
    with pytest.raises(ValueError, match="New faces would lie on"):
        new_faces.refuse_doubles(bm, twice)
    bm.free()
