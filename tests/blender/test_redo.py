"""Changes in the redo panel: Blender goes on with the first surface, and the fair one follows.

Blender's own operator takes the last run back and repeats it, as the panel does; timers are called from here.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from typing import Any

import bpy
import clocks
import meshes
import numpy as np
import pytest
from extension import module

WORSE = {"shape": "HARMONIC", "max_iterations": 1}  # of which nothing comes


class Panel:
    """The redo panel of one run, whose answers wait for `go_on`."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.redo, job = module("run.redo"), module("run.job")
        self.go_on = threading.Event()
        self.given = threading.Event()
        solve = job.solve
        import fairing

        def slow(tasks: Any, options: Any, progress: Any, ahead: bool = False, give: Any = None) -> Any:
            found = solve(tasks, options, progress, ahead, give)
            self.given.set()
            while not self.go_on.wait(0.01):
                if not progress(0.5, ""):
                    raise fairing.Cancelled
            return found

        self.obj, self.faces = meshes.domed_grid()
        self.before = meshes.positions(self.obj)
        self.name = self.obj.name
        meshes.enter(self.obj, self.faces)
        bpy.ops.ed.undo_push(message="Begin")
        assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
        self.first_run = self.positions()
        monkeypatch.setattr(self.redo, "has_events", lambda _context: True)
        monkeypatch.setattr(self.redo, "PROMPT", 0.0)
        monkeypatch.setattr(self.redo, "IS_ON", True)
        monkeypatch.setattr(job, "solve", slow)
        job.memory.clear()

    @property
    def report(self) -> Any:
        return bpy.context.window_manager.fairing_report

    @property
    def follows(self) -> bool:
        return bool(bpy.context.window_manager.fairing_progress.following)

    def positions(self) -> Any:
        """Of the mesh in edit mode, float32 as Blender has them: undo replaces the object."""
        mesh = bpy.data.objects[self.name].data
        return module("mesh.mesh_io").edit_positions(mesh).astype(np.float32)

    def change(self, **options: Any) -> None:
        """Change options in the panel, and see the first surface."""
        self.given.clear()
        operator = bpy.context.window_manager.operators[-1]
        operator = operator.macros[0] if len(operator.macros) else operator
        for name, value in options.items():
            setattr(operator.properties, name, value)
        area = next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")
        region = next(region for region in area.regions if region.type == "WINDOW")
        with bpy.context.temp_override(area=area, region=region):
            assert bpy.ops.ed.undo_redo("EXEC_DEFAULT", True) == {"FINISHED"}
        assert self.given.wait(10.0)
        self.redo._look()

    def settle(self) -> None:
        """Let the answers come, and the timer look until none is awaited."""
        self.go_on.set()
        end = time.perf_counter() + clocks.STUCK
        while self.redo._look() is not None:
            assert time.perf_counter() < end
            time.sleep(0.01)
        assert not self.follows


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
    made.go_on.set()
    module("run.background").stop_all()


def test_the_first_surface_at_once_and_the_fair_one_in_the_same_step_of_undo(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    first = panel.positions()
    assert panel.follows
    assert "a smooth one is shown meanwhile" in panel.report.reason
    assert np.abs(first - panel.before).max() > 1e-3
    panel.settle()
    found = panel.positions()
    assert (panel.report.verdict, panel.report.reason) == ("GOOD", "")
    assert np.abs(found - first).max() > 1e-6
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    bpy.ops.ed.redo()
    np.testing.assert_array_equal(panel.positions(), found)
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def test_of_two_changes_the_last_one_counts(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    panel.change(shape="MINIMAL_ENERGY")
    panel.settle()
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="MINIMAL_ENERGY"))


def test_an_answer_that_comes_at_once_needs_no_first_surface(panel: Panel, monkeypatch: pytest.MonkeyPatch) -> None:
    panel.go_on.set()
    monkeypatch.setattr(panel.redo, "PROMPT", 10.0)
    panel.change(shape="LEAST_VARIATION")
    assert not panel.follows
    assert panel.report.verdict == "GOOD"


def test_scripts_wait_in_a_window_too(panel: Panel) -> None:
    panel.go_on.set()
    panel.change(shape="LEAST_VARIATION")
    panel.settle()
    assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not panel.follows


class MESH_OT_macro_of_a_test(bpy.types.Macro):
    """As the tools of the toolbar are."""

    bl_idname = "mesh.macro_of_a_test"
    bl_label = "Macro"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for


def test_a_run_that_is_a_step_of_a_macro_is_followed_too(panel: Panel) -> None:
    panel.go_on.set()
    # Registered for good: Blender keeps what was run, and asks its type.
    bpy.utils.register_class(MESH_OT_macro_of_a_test)
    MESH_OT_macro_of_a_test.define("MESH_OT_fair_region")
    bpy.ops.ed.undo()
    assert bpy.ops.mesh.macro_of_a_test("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not panel.follows  # it is a script that calls
    panel.go_on.clear()
    panel.change(shape="LEAST_VARIATION")
    assert panel.follows
    panel.settle()
    found = panel.positions()
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def test_what_is_selected_meanwhile_stays_selected(panel: Panel) -> None:
    """The fair surface then comes as a step of its own."""
    panel.change(shape="LEAST_VARIATION")
    first = panel.positions()
    bpy.ops.mesh.select_all("EXEC_DEFAULT", True, action="SELECT")
    panel.settle()
    found = panel.positions()
    assert panel.report.verdict == "GOOD"
    mesh = bpy.data.objects[panel.name].data
    assert mesh.count_selected_items()[2] == len(panel.faces)
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(panel.positions(), first)
    bpy.ops.ed.redo()
    np.testing.assert_array_equal(panel.positions(), found)
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


@pytest.mark.parametrize("what", ["move", "mode", "delete", "cancel"])
def test_what_changes_the_mesh_meanwhile_keeps_the_first_surface(panel: Panel, what: str) -> None:
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
    assert "A smooth surface was kept" in panel.report.reason
    if there is not None:
        np.testing.assert_array_equal(panel.positions(), there)


def test_nothing_happens_while_vertices_are_being_moved(panel: Panel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Undo would take the mesh away from the operator that is under way. Its end lets the fair surface in."""
    panel.change(shape="LEAST_VARIATION")
    first = panel.positions()
    panel.go_on.set()
    with monkeypatch.context() as moved:
        moved.setattr(panel.redo, "is_being_edited", lambda _context: True)
        for _ in range(20):
            assert panel.redo._look() is not None
            time.sleep(0.01)
    np.testing.assert_array_equal(panel.positions(), first)
    assert not panel.redo.is_being_edited(bpy.context)
    panel.settle()
    found = panel.positions()
    meshes.leave()
    np.testing.assert_array_equal(found, expected(shape="LEAST_VARIATION"))


def test_undo_meanwhile_ends_it(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    bpy.ops.ed.undo()
    assert not panel.follows
    panel.settle()
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    assert not panel.report.written


def test_another_file_ends_it(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not panel.follows
    assert panel.redo._look() is None
    assert not panel.report.reason


def test_another_run_ends_it(panel: Panel) -> None:
    panel.change(shape="LEAST_VARIATION")
    panel.go_on.set()
    assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
    assert not panel.follows
    assert panel.report.verdict == "GOOD"


@pytest.mark.parametrize("prompt", [0.0, 10.0])
def test_what_is_not_usable_leaves_the_mesh_as_it_was(
    panel: Panel, prompt: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the panel where it is, for another change."""
    monkeypatch.setattr(panel.redo, "PROMPT", prompt)
    panel.go_on.set()
    panel.change(**WORSE)
    panel.settle()
    assert panel.report.verdict == "UNUSABLE"
    np.testing.assert_array_equal(panel.positions(), panel.before.astype(np.float32))
    monkeypatch.setattr(panel.redo, "PROMPT", 0.0)
    panel.change(max_iterations=20)
    panel.settle()
    assert panel.report.verdict == "GOOD"
    np.testing.assert_allclose(panel.positions(), panel.first_run, atol=1e-5)
