"""Fair Fill over many holes: what is wrong with one stops no other, and what stays open is selected and named."""

import json
from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module
from test_fill import border_edges

AXES = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]) / np.sqrt(3.0)


def ball(change: Callable[[Any], None] = lambda bm: None) -> bpy.types.Object:
    """A unit sphere of quads with a hole around each of the AXES, and what `change` makes of its bmesh."""
    obj = meshes.remove(meshes.sphere(48), lambda centre: (AXES @ centre.normalized()).max() > 0.98)
    with meshes.rebuilt(obj) as bm:
        change(bm)
    return obj


def pinch(bm: Any) -> None:
    """Take two faces away that touch in a vertex only, far from all holes."""
    bm.verts.ensure_lookup_table()
    top = max(bm.verts, key=lambda vertex: vertex.co.z)
    first = top.link_faces[0]
    other = next(f for f in top.link_faces if len({*f.verts} & {*first.verts}) == 1)
    bmesh.ops.delete(bm, geom=[first, other], context="FACES_ONLY")


def blade(bm: Any) -> None:
    """A lone triangle that pierces the surface over the first hole."""
    axis = AXES[0]
    bm.faces.new([bm.verts.new(tuple(place)) for place in (0.7 * axis, 1.4 * axis + 0.02, 1.4 * axis - [0.02, 0, 0])])


def spoil(bm: Any) -> None:
    """Give the second hole an edge without length."""
    rim = [v for v in bm.verts if v.is_boundary and v.co.normalized().dot(AXES[1].tolist()) > 0.9]
    edge = next(e for e in rim[0].link_edges if e.is_boundary)
    edge.verts[0].co = edge.verts[1].co


def fill(obj: bpy.types.Object, **properties: Any) -> set[str]:
    """Fair Fill with all faces selected; leaves the object in edit mode."""
    meshes.edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    status: set[str] = bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True, **properties)
    return status


def open_borders(obj: bpy.types.Object) -> list[list[int]]:
    """The border loops as sorted vertices; the mesh must be a manifold with border, wound consistently."""
    border_edges(obj)
    with meshes.rebuilt(obj, write=False) as bm:
        assert all(vertex.is_manifold for vertex in bm.verts)
        rim = [vertex for vertex in bm.verts if vertex.is_boundary]
        edges = {v.index: [e.other_vert(v).index for e in v.link_edges if e.is_boundary] for v in rim}
    loops = []
    while edges:
        loop, ahead = [], [next(iter(edges))]
        while ahead:
            vertex = ahead.pop()
            if vertex in edges:
                loop.append(vertex)
                ahead += edges.pop(vertex)
        loops.append(sorted(loop))
    return loops


def selected(obj: bpy.types.Object) -> set[int]:
    return {vertex.index for vertex in obj.data.vertices if vertex.select}


def test_all_holes_are_filled_and_those_that_touch_welded() -> None:
    obj = ball(pinch)
    before = meshes.contents(obj)
    count = len(obj.data.vertices)
    assert fill(obj) == {"FINISHED"}
    meshes.leave()
    assert open_borders(obj) == []
    assert len(obj.data.vertices) - len(obj.data.edges) + len(obj.data.polygons) == 2
    points = meshes.positions(obj)
    assert len(np.unique(points.round(6), axis=0)) == len(points)
    assert np.abs(np.linalg.norm(points, axis=1) - 1.0).max() < 2e-3
    assert len(points) > count
    after = meshes.contents(obj)
    for name in before:
        if "select" not in name and name != "weights":
            assert after[name].startswith(before[name]), name
    assert bpy.context.window_manager.fairing_report.verdict == "GOOD"


def test_what_stays_open_is_selected_with_its_reason() -> None:
    def change(bm: Any) -> None:
        blade(bm)
        spoil(bm)

    obj = ball(change)
    assert fill(obj) == {"FINISHED"}
    report = bpy.context.window_manager.fairing_report
    meshes.leave()
    loops = open_borders(obj)
    assert len(loops) == 3  # the blade is an outer border
    points = meshes.positions(obj)
    left = [loop for loop in loops if len(loop) > 3]
    assert {vertex for loop in left for vertex in loop} == selected(obj)
    for loop, axis in zip(
        sorted(left, key=lambda one: (points[one] @ AXES[0]).mean()), (AXES[1], AXES[0]), strict=True
    ):
        assert (points[loop] @ axis).min() > 0.9
    assert report.verdict == "LOOK"
    assert "2 of 8 holes stay open, and are selected" in report.reason
    assert "without length" in report.reason + report.warnings
    assert "through others" in report.warnings
    assert "1 border runs around the outside" in report.warnings


def test_scripts_and_the_command_line_list_what_is_left(tmp_path: Any, capsys: pytest.CaptureFixture[str]) -> None:
    obj = ball(spoil)
    fills = module().fill_mesh(obj.data)
    assert (len(fills), len(fills.left)) == (7, 1)
    (loop,) = open_borders(obj)
    assert fills.left[0].vertices.tolist() == loop
    assert "without length" in fills.left[0].reason
    other = ball(spoil)
    given = ["--object", other.name, "--fill", "--report", "json", "--output", str(tmp_path / "filled.blend")]
    assert module("run.cli").execute(given) == 0
    (line,) = [text for text in capsys.readouterr().out.splitlines() if text.startswith("{")]
    reported = json.loads(line)
    (left,) = reported["left_open"]
    assert left["vertices"] == open_borders(other)[0]
    assert "without length" in left["reason"]


def test_a_missing_quad_and_a_missing_triangle_are_one_face_each() -> None:
    """Flat ones in a plane: nothing rises."""
    obj = meshes.grid(8)
    with meshes.rebuilt(obj) as bm:
        pair = bmesh.ops.triangulate(bm, faces=[bm.faces[36]])["faces"]
        bmesh.ops.delete(bm, geom=[pair[0]], context="FACES_ONLY")
        bm.faces.ensure_lookup_table()
        bmesh.ops.delete(bm, geom=[bm.faces[9]], context="FACES_ONLY")
    count, points = len(obj.data.polygons), meshes.positions(obj)
    assert fill(obj) == {"FINISHED"}
    meshes.leave()
    new = list(obj.data.polygons)[count:]
    assert sorted(len(polygon.vertices) for polygon in new) == [3, 4]
    np.testing.assert_array_equal(meshes.positions(obj), points)
    assert all(polygon.normal.z == pytest.approx(1.0) for polygon in new)
    assert bpy.context.window_manager.fairing_report.verdict == "GOOD"


def test_holes_of_several_objects_stop_each_other_no_more() -> None:
    good, bad = ball(), ball(spoil)
    bpy.context.view_layer.update()
    meshes.edit(good, bad)
    bpy.ops.mesh.select_all(action="SELECT")
    assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True) == {"FINISHED"}
    report = bpy.context.window_manager.fairing_report
    meshes.leave()
    assert (open_borders(good), len(open_borders(bad))) == ([], 1)
    assert selected(bad) == {*open_borders(bad)[0]}
    assert report.reason.startswith(f"{bad.name}: 1 of 8 holes stays open")


def half_ball(hole: Callable[[Any], bool]) -> bpy.types.Object:
    """The half x ≥ 0 of a unit sphere with a Mirror modifier, without the faces whose centre `hole` accepts."""
    obj = meshes.remove(meshes.sphere(48), lambda centre: centre.x < 0.0 or hole(centre.normalized()))
    obj.modifiers.new("Mirror", "MIRROR")
    return obj


def evaluated(obj: bpy.types.Object) -> bpy.types.Object:
    """What the modifier makes of it, as an object of its own."""
    mesh = bpy.data.meshes.new_from_object(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    other = bpy.data.objects.new("Whole", mesh)
    bpy.context.collection.objects.link(other)
    return other


@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (-2.0, 2.0, 2.0)])
def test_a_hole_at_a_mirror_plane_is_filled_as_the_whole_would_be(scale: tuple[float, float, float]) -> None:
    """Two holes at the plane and one beside it; the border along the plane stays as it is."""
    obj = half_ball(lambda c: c.z > 0.8 or c.y > 0.93 or c.x > 0.93)
    obj.scale = scale
    before = meshes.positions(obj)
    edges = len(open_borders(obj)[0])
    assert fill(obj) == {"FINISHED"}
    meshes.leave()
    points = meshes.positions(obj)
    np.testing.assert_array_equal(points[: len(before)], before)
    assert np.abs(np.linalg.norm(points, axis=1) - 1.0).max() < 1e-4
    (rim,) = open_borders(obj)
    assert np.abs(points[rim, 0]).max() < 1e-6  # all of it lies on the plane
    assert len(rim) != edges
    bpy.context.view_layer.update()
    whole = evaluated(obj)
    assert open_borders(whole) == []
    assert len(whole.data.vertices) - len(whole.data.edges) + len(whole.data.polygons) == 2
    assert bpy.context.window_manager.fairing_report.verdict == "GOOD"


def test_a_plane_without_holes_is_no_border_to_fill() -> None:
    obj = half_ball(lambda c: False)
    with pytest.raises(RuntimeError, match="No border is selected"):
        fill(obj)


def test_with_x_mirror_a_hole_across_the_plane_is_symmetric_to_the_bit() -> None:
    obj = meshes.remove(meshes.sphere(48), lambda centre: centre.z > 0.75)
    points = meshes.positions(obj)
    points[np.abs(points[:, 0]) < 1e-6, 0] = 0.0
    meshes.move(obj, points)
    obj.data.use_mirror_x = True
    count = len(points)
    assert fill(obj) == {"FINISHED"}
    meshes.leave()
    assert open_borders(obj) == []
    new = meshes.positions(obj)[count:]
    assert np.abs(np.linalg.norm(new, axis=1) - 1.0).max() < 2e-3
    assert np.count_nonzero(new[:, 0] == 0.0) > 3
    there = {tuple(row) for row in new.tolist()}
    assert {(-x + 0.0, y, z) for x, y, z in there} == {(x + 0.0, y, z) for x, y, z in there}
    faces = {frozenset(tuple(obj.data.vertices[v].co) for v in p.vertices) for p in obj.data.polygons if p.select}
    assert {frozenset((-x + 0.0, y, z) for x, y, z in face) for face in faces} == {
        frozenset((x + 0.0, y, z) for x, y, z in face) for face in faces
    }
    assert bpy.context.window_manager.fairing_report.verdict == "GOOD"
