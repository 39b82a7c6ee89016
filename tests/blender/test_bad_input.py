"""Nothing breaks the operator: the rows of tests/package/test_robustness.py that apply in Blender, in its order.

Refused: the mesh keeps every bit, no undo step is added, the elements in question are selected. Solved: finite, all but
the free vertices keep every bit, what is odd is reported.
"""

from typing import Any

import bpy
import numpy as np

import meshes


def solved(obj: bpy.types.Object, faces: Any, free: Any = None, **properties: Any) -> str:
    """Run what is solved, see that nothing but the free vertices moved and all is finite; return the warnings."""
    before = meshes.in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces, **properties) == {"FINISHED"}
    moved = meshes.moved(before, meshes.contents(obj))
    assert not (moved & ~(meshes.free_vertices(obj, faces) if free is None else free)).any()
    assert moved.any()
    assert np.isfinite(meshes.positions(obj)[moved]).all()
    return str(meshes.report().warnings)


def test_a_closed_component_beside_others_is_left_alone() -> None:
    clean, faces = meshes.domed_grid()
    meshes.fair(clean, faces)
    obj, sphere = meshes.domed_grid()[0], meshes.sphere(16)
    for each in bpy.context.view_layer.objects:
        each.select_set(each in (obj, sphere))
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.join()
    count = len(clean.data.vertices)
    everything = np.ones(len(obj.data.polygons), dtype=bool)
    everything[: len(faces)] = faces
    free = np.zeros(len(obj.data.vertices), dtype=bool)
    free[:count] = meshes.free_vertices(clean, faces)
    assert "A closed part of the selection has nothing to hold it" in solved(obj, everything, free)
    np.testing.assert_allclose(meshes.positions(obj)[:count], meshes.positions(clean), atol=1e-6)


def test_infinity_elsewhere() -> None:
    clean, obj = meshes.domed_grid()[0], meshes.domed_grid()[0]
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.5)
    points = meshes.positions(obj)
    points[0] = np.inf, np.nan, 0.0
    meshes.move(obj, points)
    meshes.fair(clean, faces, boundary_normals="AVERAGE")  # of the faces at the outline, which are all finite
    solved(obj, faces, boundary_normals="AVERAGE")
    np.testing.assert_allclose(meshes.positions(obj)[1:], meshes.positions(clean)[1:], atol=1e-6)
    solved(obj, faces)


def test_offset_is_reported() -> None:
    """At a million float32 lie 1/16 apart, which is a quarter of an edge here."""
    obj, faces = meshes.domed_grid()
    points = meshes.positions(obj)
    meshes.move(obj, points + 2.0**20)
    assert "move the origin nearer" in solved(obj, faces)
