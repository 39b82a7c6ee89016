"""Changes in the redo panel: Blender goes on with another surface, and the fair one follows."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

import clocks
import meshes
from changes import Panel, in_view
from extension import module

LONGEST = 0.1  # seconds of the processor that a change may hold Blender up
WORSE = {"shape": "HARMONIC", "max_iterations": 1}  # of which nothing comes


def expected(**options: Any) -> Any:
    """What a script gets."""
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces, **options)
    meshes.leave()
    return meshes.positions(obj).astype(np.float32)


@pytest.fixture
def panel(monkeypatch: pytest.MonkeyPatch) -> Iterator[Panel]:
    made = Panel(monkeypatch)
    yield made
    made.end()


def test_the_last_result_at_once_and_the_fair_one_in_the_same_step_of_undo(panel: Panel) -> None:
    begin = clocks.clocks()
    panel.leave_panel(shape="LEAST_VARIATION")
    spent, passed = (now - then for now, then in zip(clocks.clocks(), begin, strict=True))
    assert spent < LONGEST
    assert passed < clocks.STUCK
    assert panel.follows
    np.testing.assert_array_equal(panel.positions(), panel.first_run)
    panel.change()
    np.testing.assert_array_equal(panel.positions(), panel.first_run)
    assert "another one is shown meanwhile" in panel.report.reason
    panel.settle()
    found = panel.positions()
    assert (panel.report.verdict, panel.report.reason) == ("GOOD", "")
    assert np.abs(found - panel.first_run).max() > 1e-6
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    bpy.ops.ed.redo()
    np.testing.assert_array_equal(panel.positions(), found)
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def check_one_step(panel: Panel) -> None:
    """The answer is that of a run that waits, and one step of undo takes it and what was shown away."""
    panel.settle()
    found = panel.positions()
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def test_of_several_changes_the_last_one_counts(panel: Panel) -> None:
    for shape in ("LEAST_VARIATION", "HARMONIC", "MINIMAL_ENERGY"):
        panel.change(shape=shape)
    panel.settle()
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="MINIMAL_ENERGY"))


@pytest.mark.parametrize("prompt", [10.0, 0.0])
def test_a_small_selection_is_answered_at_once_or_else_followed(
    panel: Panel, prompt: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(panel.redo, "PROMPT", prompt)
    monkeypatch.setattr(panel.redo, "background_from", lambda _context: 1000)
    panel.change(shape="LEAST_VARIATION")
    assert panel.follows == (prompt == 0.0)
    panel.settle()
    assert panel.report.verdict == "GOOD"
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def test_scripts_wait_in_a_window_too(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    panel.settle()
    assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not panel.follows
    assert not panel.threads()


class MESH_OT_macro_of_a_test(bpy.types.Macro):
    """As the tools of the toolbar are."""

    bl_idname = "mesh.macro_of_a_test"
    bl_label = "Macro"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for


def test_a_run_that_is_a_step_of_a_macro_is_followed_too(panel: Panel) -> None:
    # Registered for good: Blender keeps what was run, and asks its type.
    bpy.utils.register_class(MESH_OT_macro_of_a_test)
    MESH_OT_macro_of_a_test.define("MESH_OT_fair_region")
    bpy.ops.ed.undo()
    assert bpy.ops.mesh.macro_of_a_test("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not panel.follows  # it is a script that calls
    panel.change(shape="LEAST_VARIATION")
    assert panel.follows
    check_one_step(panel)


def test_what_is_selected_meanwhile_stays_selected(panel: Panel) -> None:
    """The fair surface then comes as a step of its own."""
    panel.change(shape="LEAST_VARIATION")
    bpy.ops.mesh.select_all("EXEC_DEFAULT", True, action="SELECT")
    panel.settle()
    found = panel.positions()
    assert panel.report.verdict == "GOOD"
    mesh = bpy.data.objects[panel.name].data
    assert mesh.count_selected_items()[2] == module("mesh.selecting").face_count(mesh)
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), panel.first_run)
    bpy.ops.ed.redo()
    np.testing.assert_array_equal(panel.positions(), found)
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


@pytest.mark.parametrize("what", ["move", "mode", "delete", "cancel"])
def test_what_changes_the_mesh_meanwhile_keeps_what_is_shown(panel: Panel, what: str) -> None:
    panel.change(shape="LEAST_VARIATION")
    if what == "move":
        bpy.ops.transform.translate("EXEC_DEFAULT", True, value=(0.0, 0.0, 0.1))
    elif what == "mode":
        bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="OBJECT")
    elif what == "delete":
        bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="OBJECT")
        bpy.data.objects.remove(bpy.data.objects[panel.name])
    else:
        assert bpy.ops.mesh.fair_cancel() == {"FINISHED"}
    there = panel.positions() if what in ("move", "cancel") else None
    panel.settle()
    assert panel.report.verdict == "LOOK"
    assert "Another surface was kept" in panel.report.reason
    if there is not None:
        np.testing.assert_array_equal(panel.positions(), there)


def test_nothing_happens_while_vertices_are_being_moved(panel: Panel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Undo would take the mesh away from the operator that is under way. Its end lets the fair surface in."""
    panel.change(shape="LEAST_VARIATION")
    panel.open()
    with monkeypatch.context() as moved:
        moved.setattr(panel.redo, "is_being_edited", lambda _context: True)
        for _ in range(20):
            assert panel.look()
            time.sleep(0.01)
    np.testing.assert_array_equal(panel.positions(), panel.first_run)
    assert not panel.redo.is_being_edited(bpy.context)
    panel.settle()
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def test_nothing_is_written_while_a_field_may_be_pulled(panel: Panel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Undo would take the field away."""
    operator, down = panel.redo.MESH_OT_fair_follow, [True]
    monkeypatch.setattr(panel.redo, "is_held", lambda: down[0])
    panel.change(shape="LEAST_VARIATION")
    stand = SimpleNamespace(_following=panel.redo._following())
    panel.open()
    assert panel.redo._following().run.wait(clocks.STUCK)

    def heard(kind: str) -> set[str]:
        with in_view():
            return set(operator.modal(stand, bpy.context, event(kind, "NOTHING")))

    assert all(heard(kind) == {"PASS_THROUGH"} for kind in ("MOUSEMOVE", "A", "TIMER"))
    assert panel.follows
    down[0] = False
    assert heard("A") == {"PASS_THROUGH"}
    assert heard("TIMER") == heard("A") == {"CANCELLED", "PASS_THROUGH"}
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


@pytest.mark.parametrize(("kind", "value"), [("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE"), ("A", "PRESS")])
def test_the_mouse_button_is_asked_about(panel: Panel, kind: str, value: str) -> None:
    stand = SimpleNamespace(asks=True)
    assert panel.redo.MESH_OT_fair_follow.invoke(stand, bpy.context, event(kind, value)) == {"CANCELLED"}
    assert panel.redo._Hand.is_down == ((kind, value) == ("LEFTMOUSE", "PRESS"))


def event(kind: str, value: str) -> Any:
    return SimpleNamespace(type=kind, value=value)


def test_the_tools_arrows_wait_until_no_thread_is_left(panel: Panel) -> None:
    """One that searches for a live region, say: Blender crashes where it runs beside an operator of a timer."""
    gizmos, run = module("show.gizmos"), module("core.runner").Run
    panel.change(shape="LEAST_VARIATION")
    leave = threading.Event()
    other = run(lambda _progress: leave.wait())
    gizmos._wanted.append(bpy.context.window)
    bpy.context.window_manager.operators[-1].properties.shape = "MINIMAL_ENERGY"
    try:
        for _ in range(5):
            assert gizmos._run_again() == gizmos.SOON
            panel.open()
            time.sleep(0.01)
        assert other.cancelled
        np.testing.assert_array_equal(panel.positions(), panel.first_run)
    finally:
        leave.set()
    assert other.wait(clocks.STUCK)
    end = time.perf_counter() + clocks.STUCK
    while gizmos._run_again() is not None:
        assert time.perf_counter() < end
        time.sleep(0.01)
    assert not panel.threads()
    panel.is_open = True
    panel.settle()
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="MINIMAL_ENERGY"))


def test_undo_meanwhile_ends_it(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    bpy.ops.ed.undo()
    assert not panel.follows
    panel.settle()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    assert not panel.report.written


def test_another_file_ends_it(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    panel.open()
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not panel.follows
    assert not panel.look()
    assert not panel.report.reason


def test_another_run_ends_it(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not panel.follows
    assert panel.report.verdict == "GOOD"


@pytest.mark.parametrize("at_once", [True, False])
def test_what_is_not_usable_leaves_the_result_before(
    panel: Panel, at_once: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the panel where it is, for another change."""
    monkeypatch.setattr(panel.redo, "PROMPT", 10.0)
    if at_once:
        monkeypatch.setattr(panel.redo, "background_from", lambda _context: 1000)
    panel.change(**WORSE)
    assert panel.follows != at_once
    panel.settle()
    assert panel.report.verdict == "UNUSABLE"
    assert at_once or "The surface before was kept" in panel.report.reason
    np.testing.assert_array_equal(panel.positions(), panel.first_run)
    panel.change(max_iterations=20)
    panel.settle()
    assert panel.report.verdict == "GOOD"
    np.testing.assert_allclose(panel.positions(), panel.first_run, atol=1e-5)
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))


def test_what_is_refused_after_another_selection_leaves_what_is_shown(panel: Panel) -> None:
    panel.change(**WORSE)
    bpy.ops.mesh.select_all("EXEC_DEFAULT", True, action="SELECT")
    panel.settle()
    assert panel.report.verdict == "UNUSABLE"
    assert "The surface before was kept" in panel.report.reason
    np.testing.assert_array_equal(panel.positions(), panel.first_run)


@pytest.mark.parametrize(("mode", "source"), [("SCULPT", "MASK"), ("OBJECT", "VERTEX_GROUP")])
def test_outside_edit_mode_nothing_waits_either(mode: str, source: str, monkeypatch: pytest.MonkeyPatch) -> None:
    redo, outside = module("run.redo"), module("run.outside")
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
    monkeypatch.setattr(redo, "background_from", lambda _context: 0)
    monkeypatch.setattr(redo, "watch", lambda: None)
    monkeypatch.setattr(redo, "is_held", lambda: False)
    bpy.context.window_manager.operators[-1].properties.shape = "LEAST_VARIATION"
    with in_view():
        bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
    try:
        assert "another one is shown meanwhile" in meshes.report().reason
        with in_view():
            assert redo.look(bpy.context)
        assert begun.wait(10.0)  # beyond which it runs no Python
        np.testing.assert_array_equal(now(), last)
        gate.set()
        end = time.perf_counter() + clocks.STUCK
        while meshes.report().verdict != "GOOD":
            assert time.perf_counter() < end
            assert redo._following().run.wait(clocks.STUCK)
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
