"""Nothing breaks the operator: the rows of tests/package/test_robustness.py that apply in Blender, in its order.

Refused: the mesh keeps every bit, no undo step is added, the elements in question are selected. Solved: finite, all but
the free vertices keep every bit, what is odd is reported.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
import pytest

import meshes


def without_selection(contents: dict[str, bytes]) -> dict[str, bytes]:
    return {key: value for key, value in contents.items() if "select" not in key}


def chosen(name: str) -> list[int]:
    meshes.leave()
    found = [v.index for v in bpy.data.objects[name].data.vertices if v.select]
    bpy.ops.object.mode_set(mode="EDIT")
    return found


@contextmanager
def no_step_added(obj: bpy.types.Object, moving: Any, faces: Any) -> Iterator[dict[str, bytes]]:
    """Give the contents after a move, `faces` selected; see that an undo afterwards takes back the move."""
    name = obj.name
    meshes.enter(obj, moving)
    bpy.ops.ed.undo_push(message="first")
    first = meshes.contents_in_edit_mode(name)
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.25))
    meshes.leave()
    meshes.enter(obj, faces)
    bpy.ops.ed.undo_push(message="second")
    second = meshes.contents_in_edit_mode(name)
    assert first["POINT position"] != second["POINT position"]
    yield second
    bpy.ops.ed.undo()
    assert meshes.contents_in_edit_mode(name)["POINT position"] == first["POINT position"]
    meshes.leave()


def refusal(obj: bpy.types.Object, faces: Any, **properties: Any) -> tuple[str, list[int]]:
    """Run what is refused, see that it leaves no trace; return the message and the vertices selected by it."""
    name = obj.name
    with no_step_added(obj, faces, faces) as before:
        with pytest.raises(RuntimeError) as caught:
            meshes.run(**properties)
        assert without_selection(meshes.contents_in_edit_mode(name)) == without_selection(before)
        return str(caught.value), chosen(name)


def solved(obj: bpy.types.Object, faces: Any, free: Any = None, **properties: Any) -> str:
    """Run what is solved, see that nothing but the free vertices moved and all is finite; return the warnings."""
    before = meshes.in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces, **properties) == {"FINISHED"}
    moved = meshes.moved(before, meshes.contents(obj))
    assert not (moved & ~(meshes.free_vertices(obj, faces) if free is None else free)).any()
    assert moved.any()
    assert np.isfinite(meshes.positions(obj)[moved]).all()
    return str(meshes.report().warnings)


def test_a_fin_in_the_selection_is_refused() -> None:
    obj, _ = meshes.domed_grid()
    with meshes.rebuilt(obj) as bm:
        a, b = min(bm.edges, key=lambda edge: sum(v.co.xy.length for v in edge.verts)).verts
        bm.faces.new((a, b, bm.verts.new((a.co + b.co) / 2.0 + (b.co - a.co).orthogonal())))
        edge = a.index, b.index
    # Those that stand on the selection are selected, too.
    text, selected = refusal(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7))
    assert "More than two faces meet at the edge" in text
    assert selected == sorted(edge)


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


@pytest.mark.parametrize("count", [0, 1, 2])
def test_nothing_to_move_adds_no_undo_step(count: int) -> None:
    obj, faces = meshes.domed_grid()
    few = np.zeros_like(faces)
    few[:count] = True
    name = obj.name
    with no_step_added(obj, faces, few) as before:
        assert meshes.run() == {"CANCELLED"}
        assert meshes.contents_in_edit_mode(name) == before


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
