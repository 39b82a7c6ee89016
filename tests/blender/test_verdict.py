"""Nothing bad is written silently; what helps is a button; a run that was undone is not shown as the last."""

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module
from test_panel import drawn


def kinked() -> tuple[bpy.types.Object, Any]:
    """Return half a sphere, for which no bulge of 0.3 exists."""
    obj = meshes.sphere(48)
    return obj, meshes.faces_where(obj, lambda centre: centre.z > 0.0)


NONE = {"bulge": 0.3}


def selected_vertices(obj: bpy.types.Object) -> list[int]:
    return [v.index for v in bmesh.from_edit_mesh(obj.data).verts if v.select]


def selected_faces(obj: bpy.types.Object) -> list[int]:
    return [f.index for f in bmesh.from_edit_mesh(obj.data).faces if f.select]


def test_what_is_not_usable_leaves_every_bit_and_the_selection() -> None:
    obj, faces = kinked()
    before = meshes.in_edit_mode_once(obj, faces)
    meshes.edit(obj)
    selected = selected_faces(obj)
    with pytest.raises(RuntimeError, match=r"Not usable: A part .* Nothing was changed"):
        meshes.run(**NONE)
    report = meshes.report()
    assert (report.verdict, report.written, report.converged) == ("UNUSABLE", False, False)
    assert "of its bulge" in report.reason
    assert selected_faces(obj) == selected
    assert bpy.ops.mesh.fair_select(what="SPOTS") == {"FINISHED"}
    rim = np.flatnonzero(np.abs(meshes.positions(bpy.data.objects[obj.name])[:, 2]) < 1e-6)
    assert set(selected_vertices(obj)) <= set(rim.tolist())
    assert selected_vertices(obj)
    text = drawn("VIEW3D_PT_fairing_report")
    assert "Not usable" in text
    assert report.reason.split()[-1] in text
    assert "Nothing was changed" in text
    assert "Apply Anyway" in text
    meshes.leave()
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    after = meshes.in_edit_mode_once(obj, faces)
    assert after["POINT position"] == before["POINT position"]


def test_write_it_all_the_same() -> None:
    obj, faces = kinked()
    before = meshes.positions(obj)
    meshes.enter(obj, faces)
    with pytest.raises(RuntimeError, match="Not usable"):
        meshes.run(**NONE)
    bpy.ops.mesh.select_all(action="DESELECT")
    assert bpy.ops.mesh.fair_again(remedy="WRITE") == {"FINISHED"}
    assert selected_faces(obj) == np.flatnonzero(faces).tolist()
    assert (meshes.report().verdict, meshes.report().written) == ("UNUSABLE", True)
    meshes.leave()
    moved = (meshes.positions(obj) != before).any(axis=1)
    assert moved.any()
    # Accepting is for this once: the next run asks again.
    meshes.edit(obj)
    with pytest.raises(RuntimeError, match="Not usable"):
        meshes.run(**NONE)
    assert module("selection.inspection").last_options(bpy.context).allow_folds is False


def pulled_pin(aside: float = 0.25) -> bpy.types.Object:
    """A plain with a texture, in edit mode: the mesh folds at a pin that was pulled aside, and is selected there."""
    obj = meshes.grid(24)
    points = meshes.positions(obj)
    layer = obj.data.uv_layers.new()
    for corner, place in zip(obj.data.loops, layer.uv, strict=True):
        place.vector = points[corner.vertex_index, :2]
    pin = np.linalg.norm(points[:, :2], axis=1).argmin()
    points[pin] += [aside, 0.24 * aside, 0.0]
    meshes.move(obj, points)
    obj.vertex_groups.new(name="Pin").add([int(pin)], 1.0, "REPLACE")
    meshes.enter(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7))
    return obj


def test_a_pin_pulled_aside_offers_to_spread_vertices_evenly() -> None:
    """The old mesh folds at the pin, and so does what keeps its texture; evenly spread vertices don't."""
    pulled_pin()
    with pytest.raises(RuntimeError, match="folded over, at 1 pinned vertex"):
        meshes.run(pin_group="Pin", inner_fairness="CONFORMAL")
    assert "EVEN_SPREAD" in meshes.report().remedies.split(",")
    assert bpy.ops.mesh.fair_again(remedy="EVEN_SPREAD") == {"FINISHED"}
    assert meshes.report().verdict == "GOOD"


def test_another_way_that_is_no_better_is_not_written() -> None:
    """A good result is as good as it gets: the mesh, the report and the user's selection stay, the button goes."""
    obj = meshes.grid(16)
    points = meshes.positions(obj)
    points[:, 2] = 0.2 * np.exp(-20 * (points**2).sum(axis=1))
    meshes.move(obj, points)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.8)
    meshes.enter(obj, faces)
    meshes.run()
    report = meshes.report()
    assert report.verdict == "GOOD"
    report.remedies = "EVEN_SPREAD,ALL_KEYS"
    free = report.free_vertices
    bpy.ops.mesh.select_less()
    chosen = selected_faces(obj)
    assert 0 < len(chosen) < np.count_nonzero(faces)
    before = meshes.contents_in_edit_mode(obj.name)
    for remedy, left in (("ALL_KEYS", "EVEN_SPREAD"), ("EVEN_SPREAD", "")):
        assert bpy.ops.mesh.fair_again(remedy=remedy) == {"CANCELLED"}
        assert (report.remedies, report.free_vertices) == (left, free)
        assert meshes.contents_in_edit_mode(obj.name) == before
        assert selected_faces(bpy.data.objects[obj.name]) == chosen


def test_what_is_refused_again_leaves_the_selection_of_the_user() -> None:
    obj, faces = kinked()
    inside = int(np.flatnonzero(meshes.free_vertices(obj, faces))[0])
    meshes.enter(obj, faces)
    with pytest.raises(RuntimeError, match="Not usable"):
        meshes.run(**NONE)
    bpy.ops.mesh.select_less()
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.verts[inside].co.x = float("nan")
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    before = meshes.contents_in_edit_mode(obj.name)
    with pytest.raises(RuntimeError, match=f"Vertex {inside} "):
        bpy.ops.mesh.fair_again(remedy="WRITE")
    assert meshes.contents_in_edit_mode(obj.name) == before
    assert tuple(bpy.context.tool_settings.mesh_select_mode) == (True, False, False)


def test_the_view_goes_to_the_worst_spot() -> None:
    obj = pulled_pin()
    obj.location, obj.scale = (5.0, 0.0, 0.0), (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="folded over, at 1 pinned vertex"):
        meshes.run(pin_group="Pin", inner_fairness="CONFORMAL")
    place, normal, size = module("run.last_run").worst_spot(bpy.context)
    assert np.linalg.norm(np.array(place) - [5.5, 0.12, 0.0]) < 0.6
    assert normal[2] > 0.5 * np.linalg.norm(normal)
    assert 2.0 < size < 10.0


def test_a_changed_mesh_is_not_faired_again() -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    meshes.run()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    with pytest.raises(RuntimeError, match="other faces by now"):
        bpy.ops.mesh.fair_again(remedy="ALL_KEYS")


def test_an_undone_run_is_not_the_last() -> None:
    panel = module("show.ui").VIEW3D_PT_fairing_report
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    bpy.ops.ed.undo_push(message="before")
    meshes.run()
    assert panel.poll(bpy.context)
    bpy.ops.ed.undo()
    assert meshes.report().undone
    assert not panel.poll(bpy.context)
    bpy.ops.ed.redo()
    assert not meshes.report().undone
    assert panel.poll(bpy.context)


def test_nothing_is_said_in_both_panels() -> None:
    obj = meshes.grid(9)
    with meshes.rebuilt(obj) as bm:
        for face in bm.faces:
            if face.calc_center_median().x > 0.7:
                face.normal_flip()
    meshes.enter(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7))
    meshes.run()
    watch = module("selection.watch").watch
    watch.look(bpy.context)
    assert "point opposite ways" in meshes.report().warnings  # scripts get all of it
    assert "point opposite ways" in drawn("VIEW3D_PT_fairing_selection").replace("\n", " ")
    shown = drawn("VIEW3D_PT_fairing_report").replace("\n", " ")
    assert "point opposite ways" not in shown
    assert "Free Vertices" not in shown


def test_scripts_are_reported_by_an_exception() -> None:
    package = module()
    obj, faces = kinked()
    indices = np.flatnonzero(faces).tolist()
    before = meshes.contents(obj)
    with pytest.raises(package.NotUsable, match="of its bulge") as reported:
        package.fair_mesh(obj.data, indices, **NONE)
    assert meshes.contents(obj) == before
    assert not reported.value.result.converged
    assert len(reported.value.elements)
    result = package.fair_mesh(obj.data, indices, allow_folds=True, **NONE)
    assert not result.converged
    assert meshes.contents(obj) != before
