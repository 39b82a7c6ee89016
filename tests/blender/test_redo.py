"""Changes in the redo panel: Blender goes on with the surface before, and the one asked for follows."""

import gc
import threading
import time
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from changes import STUCK, Panel, edited, in_view
from extension import module
from operators import KINDS

REFUSED = [name for name, kind in KINDS.items() if kind.refused]
WRITERS = {
    "fill": ("mesh.filled", "add_to_edit_mesh"),
    "fillet": ("mesh.remeshed", "write_edit_mesh"),
    "curves": ("mesh.spanned", "add_to_edit_mesh"),
    "new mesh": ("mesh.remeshed", "write_edit_mesh"),
}


@pytest.fixture(params=KINDS)
def panel(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[Panel]:
    made = Panel(monkeypatch, KINDS[request.param])
    yield made
    made.end()


@pytest.fixture
def region(monkeypatch: pytest.MonkeyPatch) -> Iterator[Panel]:
    """Of Fair Region alone, for what is the same code for all."""
    made = Panel(monkeypatch, KINDS["region"])
    yield made
    made.end()


def expected(panel: Panel, **options: Any) -> bytes:
    """What a script gets, in a file of its own; with all keys what a change comes to that is waited for.

    A script's other keys differ from those in a last bit.
    """
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    panel.kind.enter()
    bpy.ops.ed.undo_push(message="Begin")
    changed = panel.kind is KINDS["all keys"]
    assert panel.kind.run(**({} if changed else options)) == {"FINISHED"}
    if changed:
        panel.redo.has_events = lambda _context: False
        panel.leave_panel(**options)
    assert not panel.follows
    return edited(bpy.context.object.name)


def check_one_step(panel: Panel, **options: Any) -> None:
    """The answer is that of a run that waits, and one step of undo takes it and what was shown away."""
    panel.complete()
    found = panel.now
    assert found != panel.first
    assert panel.kind is not KINDS["region"] or panel.report.verdict == "GOOD"
    assert "kept" not in panel.report.reason
    assert "meanwhile" not in panel.report.reason
    bpy.ops.ed.undo()
    assert panel.now == panel.original
    bpy.ops.ed.redo()
    assert panel.now == found
    assert found == expected(panel, **options)


def test_the_result_before_at_once_and_the_answer_in_the_same_step_of_undo(panel: Panel) -> None:
    panel.leave_panel(**panel.kind.second)
    assert not panel.waits
    assert panel.follows
    assert panel.now == panel.first
    assert "the last result shows" in panel.report.reason
    panel.change()
    assert panel.now == panel.first
    check_one_step(panel, **panel.kind.second)


def test_of_several_changes_the_last_one_counts(panel: Panel) -> None:
    panel.change(**panel.kind.second)
    assert panel.now == panel.first
    panel.change(**panel.kind.third)
    assert panel.now == panel.first
    check_one_step(panel, **{**panel.kind.second, **panel.kind.third})


def test_a_change_after_an_answer_shows_that_answer(panel: Panel) -> None:
    panel.change(**panel.kind.second)
    panel.complete()
    second = panel.now
    panel.change(**panel.kind.third)
    assert panel.now == second
    check_one_step(panel, **{**panel.kind.second, **panel.kind.third})


@pytest.mark.parametrize("prompt", [10.0, 0.0])
def test_a_small_one_is_answered_at_once_or_else_followed(
    panel: Panel, prompt: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(panel.redo, "PROMPT", prompt)
    monkeypatch.setattr(panel.redo.background, "LARGE", 1_000_000)
    panel.change(**panel.kind.second)
    assert panel.follows == (prompt == 0.0)
    check_one_step(panel, **panel.kind.second)


def test_scripts_wait_in_a_window_too(panel: Panel) -> None:
    bpy.ops.ed.undo()
    assert panel.kind.run() == {"FINISHED"}
    assert not panel.follows
    assert not panel.threads()
    assert panel.now == panel.first


@pytest.mark.parametrize("what", ["move", "mode", "delete", "cancel", "extrude", "script"])
def test_what_changes_the_mesh_meanwhile_keeps_what_is_shown(panel: Panel, what: str) -> None:
    panel.change(**panel.kind.second)
    if what == "move":
        bpy.ops.transform.translate("EXEC_DEFAULT", True, value=(0.0, 0.0, 0.1))
    elif what == "mode":
        bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="OBJECT")
    elif what == "delete":
        bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="OBJECT")
        bpy.data.objects.remove(bpy.data.objects[panel.name])
    elif what == "extrude":
        bpy.ops.mesh.extrude_region("EXEC_DEFAULT", True)
    elif what == "script":  # without an operator: it is not the last one that tells
        mesh = bpy.data.objects[panel.name].data
        next(iter(bmesh.from_edit_mesh(mesh).verts)).co.z += 1.0
        bmesh.update_edit_mesh(mesh)
    else:
        assert bpy.ops.mesh.fair_cancel() == {"FINISHED"}
    there = panel.now if what in ("move", "cancel", "extrude", "script") else None
    panel.complete()
    assert panel.report.verdict == "LOOK"
    assert "The last result stays" in panel.report.reason
    if there is not None:
        assert panel.now == there
    if what == "mode":
        bpy.ops.object.mode_set(mode="EDIT")
        assert panel.now == panel.first
    if what == "cancel":
        panel.change(**panel.kind.third)
        check_one_step(panel, **{**panel.kind.second, **panel.kind.third})


def test_a_selection_meanwhile_stays(panel: Panel) -> None:
    """New faces stay as they were; where vertices move alone, the answer comes as a step of its own."""
    panel.change(**panel.kind.second)
    bpy.ops.mesh.select_all("EXEC_DEFAULT", True, action="DESELECT")
    panel.complete()
    moves = panel.kind in (KINDS["region"], KINDS["denoise"])
    assert bpy.data.objects[panel.name].data.count_selected_items()[0] == 0
    assert (panel.now == panel.first) != moves
    assert ("The last result stays" in panel.report.reason) != moves
    if moves:
        bpy.ops.ed.undo()
        assert panel.now == panel.first
        bpy.ops.ed.redo()
        assert panel.now == expected(panel, **panel.kind.second)


def test_undo_meanwhile_ends_it(panel: Panel) -> None:
    panel.change(**panel.kind.second)
    bpy.ops.ed.undo()
    assert not panel.follows
    panel.complete()
    assert panel.now == panel.original
    assert not panel.report.written
    bpy.ops.ed.redo()
    assert panel.now == panel.first


def test_undo_before_the_first_look_ends_it(panel: Panel) -> None:
    panel.leave_panel(**panel.kind.second)
    bpy.ops.ed.undo()
    assert not panel.follows
    bpy.ops.ed.redo()
    panel.complete()
    assert panel.now == panel.first


def test_another_file_ends_it(panel: Panel) -> None:
    panel.change(**panel.kind.second)
    panel.open()
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not panel.follows
    assert not panel.look()
    assert not panel.threads()
    assert not panel.report.reason


def test_another_run_ends_it(panel: Panel) -> None:
    panel.change(**panel.kind.second)
    bpy.ops.ed.undo()
    assert panel.kind.run(**panel.kind.third) == {"FINISHED"}
    assert not panel.follows
    panel.complete()
    assert panel.now == expected(panel, **panel.kind.third)


@pytest.mark.parametrize("at_once", [True, False])
@pytest.mark.parametrize("panel", REFUSED, indirect=True)
def test_what_is_refused_leaves_the_result_before(panel: Panel, at_once: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the panel where it is, for another change."""
    monkeypatch.setattr(panel.redo, "PROMPT", 10.0)
    if at_once:
        monkeypatch.setattr(panel.redo.background, "LARGE", 1_000_000_000)
    panel.change(**panel.kind.refused)
    at_once = at_once or panel.kind is KINDS["fill"]  # no border is left: nothing is searched for
    assert panel.follows != at_once
    panel.complete()
    assert panel.report.verdict == "UNUSABLE"
    assert at_once or "The last result stays" in panel.report.reason
    assert panel.now == panel.first
    operator = bpy.context.window_manager.operators[-1]
    for name in panel.kind.refused:
        operator.properties.property_unset(name)
    again = {**panel.kind.first, **panel.kind.third}
    panel.change(**again)
    check_one_step(panel, **again)


@pytest.mark.parametrize("part", ["nothing", "all"])
@pytest.mark.parametrize(("panel", "writer"), WRITERS.items(), indirect=["panel"])
def test_what_blender_can_not_have_leaves_the_result_before(
    panel: Panel, writer: tuple[str, str], part: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Refused with nothing or all of it written."""
    home, name = module(writer[0]), writer[1]
    write = getattr(home, name)

    def refuses(*arguments: Any) -> Any:
        if part == "all":
            write(*arguments)
        raise ValueError("a fault of a test")

    panel.change(**panel.kind.second)
    with monkeypatch.context() as spoilt:
        spoilt.setattr(home, name, refuses)
        panel.complete()
    assert gc.isenabled()
    assert panel.report.reason == "a fault of a test. The last result stays"
    assert panel.now == panel.first
    panel.change(**panel.kind.third)
    check_one_step(panel, **{**panel.kind.second, **panel.kind.third})


class MESH_OT_macro_of_a_test(bpy.types.Macro):
    """As the tools of the toolbar are."""

    bl_idname = "mesh.macro_of_a_test"
    bl_label = "Macro"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for


def test_a_run_that_is_a_step_of_a_macro_is_followed_too(region: Panel) -> None:
    # Registered for good: Blender keeps what was run, and asks its type.
    bpy.utils.register_class(MESH_OT_macro_of_a_test)
    MESH_OT_macro_of_a_test.define("MESH_OT_fair_region")
    bpy.ops.ed.undo()
    assert bpy.ops.mesh.macro_of_a_test("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not region.follows  # it is a script that calls
    region.change(shape="LEAST_VARIATION")
    assert region.follows
    region.complete()
    found = region.positions()
    bpy.ops.ed.undo()
    assert region.now == region.original
    meshes.leave()
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces, shape="LEAST_VARIATION")
    meshes.leave()
    np.testing.assert_array_equal(found, meshes.positions(obj).astype(np.float32))


def test_nothing_happens_while_vertices_are_being_moved(region: Panel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Undo would take the mesh away from the operator that is under way. Its end lets the fair surface in."""
    region.change(shape="LEAST_VARIATION")
    region.open()
    with monkeypatch.context() as moved:
        moved.setattr(region.redo, "is_being_edited", lambda _context: True)
        for _ in range(20):
            assert region.look()
            time.sleep(0.01)
    assert region.now == region.first
    assert not region.redo.is_being_edited(bpy.context)
    check_one_step(region, shape="LEAST_VARIATION")


def test_nothing_is_written_while_a_field_may_be_pulled(region: Panel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Undo would take the field away."""
    operator, down = region.redo.MESH_OT_fair_follow, [True]
    monkeypatch.setattr(region.redo, "is_held", lambda: down[0])
    region.change(shape="LEAST_VARIATION")
    stand = SimpleNamespace(_following=region.redo._following())
    region.open()
    assert region.redo._following().run.wait(STUCK)

    def heard(kind: str) -> set[str]:
        with in_view():
            return set(operator.modal(stand, bpy.context, event(kind, "NOTHING")))

    assert all(heard(kind) == {"PASS_THROUGH"} for kind in ("MOUSEMOVE", "A", "TIMER"))
    assert region.follows
    down[0] = False
    assert heard("A") == {"PASS_THROUGH"}
    assert heard("TIMER") == heard("A") == {"CANCELLED", "PASS_THROUGH"}
    check_one_step(region, shape="LEAST_VARIATION")


@pytest.mark.parametrize(("kind", "value"), [("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE"), ("A", "PRESS")])
def test_the_mouse_button_is_asked_about(region: Panel, kind: str, value: str) -> None:
    stand = SimpleNamespace(asks=True)
    assert region.redo.MESH_OT_fair_follow.invoke(stand, bpy.context, event(kind, value)) == {"CANCELLED"}
    assert region.redo._Hand.is_down == ((kind, value) == ("LEFTMOUSE", "PRESS"))


def event(kind: str, value: str) -> Any:
    return SimpleNamespace(type=kind, value=value)


def test_what_is_refused_after_another_selection_leaves_what_is_shown(region: Panel) -> None:
    region.change(**region.kind.refused)
    bpy.ops.mesh.select_all("EXEC_DEFAULT", True, action="SELECT")
    region.complete()
    assert region.report.verdict == "UNUSABLE"
    assert "The last result stays" in region.report.reason
    assert region.now == region.first


@pytest.mark.parametrize(("mode", "source"), [("SCULPT", "MASK"), ("OBJECT", "VERTEX_GROUP")])
def test_outside_edit_mode_nothing_waits_either(mode: str, source: str, monkeypatch: pytest.MonkeyPatch) -> None:
    redo, outside = module("run.redo"), module("fair.outside")
    scripted, obj = (masked() for _ in range(2))
    before = meshes.positions(obj)
    bpy.context.view_layer.objects.active = scripted
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", source=source, shape="LEAST_VARIATION") == {"FINISHED"}
    wanted, name = meshes.positions(scripted), obj.name
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.ed.undo_push(message="Begin")
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", True, source=source) == {"FINISHED"}

    def now() -> Any:
        obj = bpy.data.objects[name]
        with outside.in_object_mode(obj):
            return meshes.positions(obj)

    last, solve, gate, begun = now(), outside.solve, threading.Event(), threading.Event()

    def slow(*arguments: Any) -> Any:
        begun.set()
        gate.wait()
        return solve(*arguments)

    monkeypatch.setattr(outside, "solve", slow)
    monkeypatch.setattr(redo, "has_events", lambda _context: True)
    monkeypatch.setattr(redo.background, "LARGE", 0)
    monkeypatch.setattr(redo, "watch", lambda: None)
    monkeypatch.setattr(redo, "is_held", lambda: False)
    bpy.context.window_manager.operators[-1].properties.shape = "LEAST_VARIATION"
    with in_view():
        bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
    try:
        assert "the last result shows" in meshes.report().reason
        with in_view():
            assert redo.look(bpy.context)
        assert begun.wait(10.0)  # beyond which it runs no Python
        np.testing.assert_array_equal(now(), last)
        gate.set()
        end = time.perf_counter() + STUCK
        while meshes.report().verdict != "GOOD":
            assert time.perf_counter() < end
            assert redo._following().run.wait(STUCK)
            with in_view():
                assert not redo.look(bpy.context)
        assert bpy.context.mode == mode
        np.testing.assert_array_equal(now(), wanted)
        bpy.ops.ed.undo()
        np.testing.assert_array_equal(now(), before)
        bpy.ops.ed.redo()
        np.testing.assert_array_equal(now(), wanted)
    finally:
        gate.set()
        module("run.background").stop_all()
        bpy.ops.object.mode_set(mode="OBJECT")


def masked() -> bpy.types.Object:
    """A grid whose dome is masked, and in a vertex group."""
    obj, faces = meshes.domed_grid()
    vertices = sorted({v for face in faces.nonzero()[0] for v in obj.data.polygons[face].vertices})
    mask = np.zeros(len(obj.data.vertices), dtype=np.float32)
    mask[vertices] = 1.0
    obj.data.attributes.new(".sculpt_mask", "FLOAT", "POINT").data.foreach_set("value", mask)
    obj.vertex_groups.new(name="Dome").add(vertices, 1.0, "REPLACE")
    return obj
