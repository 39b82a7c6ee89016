"""Nothing bad is written silently; what helps is a button; a run that was undone is not shown as the last."""

from dataclasses import replace
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
    assert bpy.ops.mesh.fair_again(way="WRITE") == {"FINISHED"}
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


def thorn(height: float = 0.06) -> tuple[bpy.types.Object, Any]:
    """Return a plain with one vertex of the boundary standing up: a kink is left there."""
    obj = meshes.grid(24)
    points = meshes.positions(obj)
    points[np.linalg.norm(points[:, :2] - [-0.5, 0.0], axis=1).argmin(), 2] = height
    meshes.move(obj, points)
    return obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.5)


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


@pytest.fixture
def takes_any_texture(monkeypatch: pytest.MonkeyPatch) -> None:
    """Automatic looks at no spike beforehand: a fold may come of other shapes, too."""
    monkeypatch.setattr(module("mesh.mesh_io"), "is_spoilt", lambda _mesh: False)


@pytest.mark.usefixtures("takes_any_texture")
@pytest.mark.parametrize("aside", [0.01, 0.25])
def test_automatic_keeps_no_texture_that_folds(aside: float) -> None:
    results = {}
    for choice in ("UNIFORM", "AUTOMATIC"):
        obj = pulled_pin(aside)
        meshes.run(pin_group="Pin", inner_fairness=choice)
        was_fair = choice == "AUTOMATIC" and aside < 0.1  # its texture is that of the surface as it lies
        assert meshes.report().verdict == ("LOOK" if was_fair else "GOOD")
        assert meshes.report().reason.startswith("Nothing changed") == was_fair
        meshes.leave()
        results[choice] = meshes.positions(obj).tobytes()
    folds = aside > 0.1
    assert ("Uniform was used instead" in meshes.report().warnings) == folds
    assert (results["AUTOMATIC"] == results["UNIFORM"]) == folds


@pytest.mark.usefixtures("takes_any_texture")
def test_automatic_refuses_where_even_vertices_are_not_usable_either(monkeypatch: pytest.MonkeyPatch) -> None:
    pulled_pin()
    home, tried = module("fair.fair_arrays"), []

    def unusable(mesh: Any, matrix: Any, options: Any, solved: Any, progress: Any) -> Any:
        tried.append(options.inner_fairness)
        found = module("verdict.outcome").outcome(mesh, matrix, options, solved, progress)
        return replace(found, verdict=replace(found.verdict, grade="UNUSABLE"))

    monkeypatch.setattr(home, "outcome", unusable)
    with pytest.raises(RuntimeError, match="folded over, at 1 pinned vertex"):
        meshes.run(pin_group="Pin")
    assert tried == ["AUTOMATIC", "UNIFORM"]
    assert "Uniform was used instead" not in meshes.report().warnings


def test_a_pin_pulled_aside_offers_to_spread_vertices_evenly() -> None:
    """The old mesh folds at the pin, and so does what keeps its texture; evenly spread vertices don't."""
    pulled_pin()
    with pytest.raises(RuntimeError, match="folded over, at 1 pinned vertex"):
        meshes.run(pin_group="Pin", inner_fairness="CONFORMAL")
    assert "EVEN_SPREAD" in meshes.report().remedies.split(",")
    assert bpy.ops.mesh.fair_again(way="EVEN_SPREAD") == {"FINISHED"}
    assert meshes.report().verdict == "GOOD"


def test_another_way_that_is_no_better_is_not_written() -> None:
    """A good result is as good as it gets: the mesh, the report and the selection stay, the button goes."""
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
    before = meshes.contents_in_edit_mode(obj.name)
    for way, left in (("ALL_KEYS", "EVEN_SPREAD"), ("EVEN_SPREAD", "")):
        assert bpy.ops.mesh.fair_again(way=way) == {"CANCELLED"}
        assert (report.remedies, report.free_vertices) == (left, free)
        assert meshes.contents_in_edit_mode(obj.name) == before
        assert selected_faces(bpy.data.objects[obj.name]) == np.flatnonzero(faces).tolist()


def test_the_region_is_selected_again() -> None:
    """After the spots of a run and after Select Bad Boundary."""
    obj, faces = thorn()
    meshes.enter(obj, faces)
    meshes.run()
    for other in ("SPOTS", "BAD"):
        assert bpy.ops.mesh.fair_select(what=other) == {"FINISHED"}
        assert selected_faces(obj) == []
        module("selection.watch").watch.look(bpy.context)
        assert "Select Region Again" in drawn("VIEW3D_PT_fairing_selection")
        assert bpy.ops.mesh.fair_select(what="REGION") == {"FINISHED"}
        assert selected_faces(obj) == np.flatnonzero(faces).tolist()
        module("selection.watch").watch.look(bpy.context)
        assert "Select Region Again" not in drawn("VIEW3D_PT_fairing_selection")


def test_the_view_goes_to_the_worst_spot() -> None:
    obj, faces = thorn()
    obj.location, obj.scale = (5.0, 0.0, 0.0), (2.0, 2.0, 2.0)
    meshes.enter(obj, faces)
    meshes.run()
    place, normal, size = module("run.last_run").worst_spot(bpy.context)
    assert np.linalg.norm(np.array(place) - [4.0, 0.0, 0.0]) < 0.6
    assert normal[2] > 0.5 * np.linalg.norm(normal)
    assert 2.0 < size < 10.0


def test_a_changed_mesh_is_not_faired_again() -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    meshes.run()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    with pytest.raises(RuntimeError, match="other faces by now"):
        bpy.ops.mesh.fair_again(way="ALL_KEYS")


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
    hole = meshes.faces_where(obj, lambda c: c.length < 0.05)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7) & ~hole
    meshes.enter(obj, faces)
    meshes.run()
    watch = module("selection.watch").watch
    watch.look(bpy.context)
    assert "single face" in meshes.report().warnings  # scripts get all of it
    assert "single face" in drawn("VIEW3D_PT_fairing_selection").replace("\n", " ")
    shown = drawn("VIEW3D_PT_fairing_report").replace("\n", " ")
    assert "single face" not in shown
    assert "Free Vertices" not in shown


def test_text_wraps_at_the_width_that_there_is() -> None:
    wrapped = module("host.text").wrapped
    text = "one two three four five"
    assert list(wrapped(text, len, 9)) == ["one two", "three", "four five"]
    assert list(wrapped(text, len, 100)) == [text]
    assert list(wrapped("incomprehensible word", len, 6)) == ["incomprehensible", "word"]
    assert list(wrapped("iiii MMMM", lambda t: 2 * t.count("M") + t.count("i"), 10)) == ["iiii", "MMMM"]
    assert module("host.text")._width("MMMM") > module("host.text")._width("iiii") > 0.0


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


def test_a_texture_is_kept_without_being_asked() -> None:
    """Automatic is Keep Texture on a patch with a UV map, Even without one, to the bit."""
    results = {}
    for mapped in (False, True):
        for choice in ("AUTOMATIC", "UNIFORM", "CONFORMAL"):
            obj, faces = meshes.domed_grid()
            points = meshes.positions(obj)
            points[:, 2] = 0.2 * np.cos(2.0 * points[:, 0])  # nothing that Automatic could take for crumpled
            meshes.move(obj, points)
            if mapped:
                layer = obj.data.uv_layers.new(name="UVMap")
                for corner, place in zip(obj.data.loops, layer.uv, strict=True):
                    place.vector = obj.data.vertices[corner.vertex_index].co.xy
            meshes.fair(obj, faces, inner_fairness=choice)
            results[mapped, choice] = meshes.positions(obj).tobytes()
    assert results[False, "AUTOMATIC"] == results[False, "UNIFORM"]
    assert results[True, "AUTOMATIC"] == results[True, "CONFORMAL"]
    assert results[True, "UNIFORM"] != results[True, "CONFORMAL"]
