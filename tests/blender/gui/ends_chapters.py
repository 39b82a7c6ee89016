"""Runs and searches in a real window that something else ends: another file, undo, the extension's end, Blender's."""

from __future__ import annotations

import itertools
import sys
import threading
from collections.abc import Callable, Generator
from typing import Any

import addon_utils
import bmesh
import bpy

import scenes
import spoilt_scenes
from driver import OUT, Story, in_view, leave_popup, middle, press, tell
from panel import ID, change_with, module, run_operator, set_options, solve_to, wait_until

_radii = itertools.count(5.5, 0.125)


def _threads() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name == "fairing"]


def _is_running() -> bool:
    return bool(bpy.context.window_manager.fairing_progress.running)


def _begin_run() -> Story:
    """Have a run of seconds under way."""
    scenes.hopeless(next(_radii))  # what is found for one is at hand for the next run
    set_options(shape="HARMONIC")
    solve_to(1e-14)
    yield 1.0
    bpy.context.window_manager.fairing_report.free_vertices = 0  # of a chapter before
    run_operator()
    yield from wait_until(_is_running, 20.0)
    yield 0.3
    assert len(_threads()) == 1, "the run was too short to be ended"


class _Held:
    """Whether searches go on, one after the other, until something ends them: one may be over within a redraw."""

    on = False


def _hold_searches() -> None:
    home = module("live.session")
    seek = home.sought

    def sought(*arguments: Any) -> Any:
        found = seek(*arguments)
        while _Held.on and arguments[-1](0.0, "") is not False:
            found = seek(*arguments)
        return found

    _Held.on, home.sought = True, sought


def _begin_search() -> Story:
    """Have Live search for the surface of a large region."""
    home = module("live.live")
    _hold_searches()
    scenes.large()
    set_options()
    yield 1.0
    run_operator("mesh.fair_live_region")

    def is_on() -> bool:
        return bool(bpy.context.window_manager.fairing_live.on)

    yield from wait_until(is_on, 60.0)
    yield 1.0
    home.PATIENCE = -1.0  # nothing is found at once
    mesh = bpy.context.object.data
    for vertex in bmesh.from_edit_mesh(mesh).verts:
        vertex.co.z *= 1.5
    bmesh.update_edit_mesh(mesh)
    yield from wait_until(_is_searching, 20.0)


def _begin_change() -> Story:
    """Have a search under way that a change in the redo panel waits for."""
    scenes.large()
    set_options()
    yield 1.0
    report = bpy.context.window_manager.fairing_report
    report.free_vertices = 0
    run_operator()

    def reported() -> bool:
        return bool(report.free_vertices)

    yield from wait_until(reported, 60.0)
    yield 1.0
    yield from change_with(shape="LEAST_VARIATION")
    yield from wait_until(_is_searching, 20.0)


def _begin_fill() -> Story:
    """The same of a run that makes faces."""
    spoilt_scenes.large_hole()
    yield 1.0
    with in_view():
        assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True) == {"FINISHED"}
    yield 1.0
    yield from change_with(spacing=0.9)
    yield from wait_until(_is_searching, 20.0)


def _is_searching() -> bool:
    return len(_threads()) == 1


def _act(name: str, act: Callable[[], object]) -> Generator[float, None, None]:
    """Do it during a run; nothing of the run is left, in less time than is noticed as an end of Blender."""
    act()
    _Held.on = False
    tell(f"{name}: Blender went on")
    assert not _threads()
    yield 1.0


def _disable() -> None:
    addon_utils.disable(ID)


def _finish_run() -> Story:
    """Have a run written that *Before / After* and *Fair Again* are about."""
    scenes.ear()
    set_options()
    yield 1.0
    report = bpy.context.window_manager.fairing_report
    report.free_vertices = 0  # of a chapter before: what is compared may be its run, and this one's key still waits
    run_operator()

    def is_compared() -> bool:
        with in_view():
            return bool(report.free_vertices and bpy.ops.mesh.fair_compare.poll() and bpy.ops.mesh.fair_again.poll())

    yield from wait_until(is_compared, 20.0)


def another_file_ends_a_run() -> Story:
    """The same file once more: names and meshes are those that the run has read."""
    same = str(OUT / "same.blend")
    for begin in (_finish_run, _begin_run, _begin_search, _begin_change, _begin_fill):
        yield from begin()
        with in_view():
            bpy.ops.wm.save_as_mainfile(filepath=same)
        before = scenes.positions()

        def open_it() -> None:
            bpy.ops.wm.open_mainfile(filepath=same, load_ui=False)

        yield from _act(f"another file, {begin.__name__}", open_it)
        yield 1.0
        assert bpy.context.window_manager.windows, "no window is left"
        assert not _is_running()
        with in_view():
            assert bpy.context.mode == "EDIT_MESH", bpy.context.mode
            assert (scenes.positions() == before).all(), "a run of the last file has written into this one"
            assert not bpy.ops.mesh.fair_compare.poll()
            assert not bpy.ops.mesh.fair_again.poll()
            assert bpy.ops.mesh.fair_region.poll()
            assert not bpy.context.window_manager.fairing_report.free_vertices
        bpy.context.window_manager.fairing_live.on = False


def undo_and_removal_end_a_search() -> Story:
    """And what else takes the mesh away from a change in the redo panel."""
    progress, report = bpy.context.window_manager.fairing_progress, bpy.context.window_manager.fairing_report
    for begin, name in itertools.product((_begin_change, _begin_fill), ("undo", "another mode", "removal")):
        yield from begin()
        original, shown = scenes.original(), scenes.positions()
        if name == "undo":
            press("Z", *middle(), ctrl=True)
        elif name == "another mode":
            press("TAB", *middle())
        else:
            with in_view():
                bpy.data.objects.remove(bpy.context.object)

        def rests() -> bool:
            return not progress.following and not _threads()

        yield from wait_until(rests, 60.0)
        yield 0.5
        if name == "undo":
            assert (scenes.positions() == original).all()
            assert not report.written
        else:
            assert "Another surface was kept" in report.reason, report.reason
        if name == "another mode":
            press("TAB", *middle())
            yield 1.0
            assert (scenes.positions() == shown).all()
        tell(f"{name}, {begin.__name__}: the search has ended")


def undo_and_removal_end_a_run() -> Story:
    for name in ("undo", "removal"):
        yield from _begin_run()
        with in_view():
            if name == "undo":
                bpy.ops.ed.undo()
            else:
                bpy.data.objects.remove(bpy.context.object)

        def rests() -> bool:
            return not _is_running()

        yield from wait_until(rests, 60.0)
        yield 0.5
        assert not _threads()
        assert not bpy.context.window_manager.fairing_report.free_vertices, f"{name}: something was written"
        tell(f"{name}: nothing was written")
        yield from leave_popup()


def disabling_ends_a_run() -> Story:
    """The operator under way is taken back without a word to it; then all is as before the first click."""
    for begin in (_begin_run, _begin_search, _begin_change, _begin_fill):
        yield from begin()
        yield from _act(f"disabled, {begin.__name__}", _disable)
        addon_utils.enable(ID)
        yield 1.0
        assert not _is_running()
    yield from _begin_run()

    def reported() -> bool:
        return bool(bpy.context.window_manager.fairing_report.free_vertices)

    yield from wait_until(reported, 120.0)
    tell("enabled again: a run ends as it should")


def _quit(begin: Callable[[], Story], last: Callable[[], object] = lambda: None) -> Story:
    yield from begin()
    last()
    assert len(_threads()) == 1
    tell("quits")
    sys.stdout.flush()
    with in_view():
        bpy.ops.wm.quit_blender()
    yield 60.0
    raise AssertionError("Blender did not quit")


def quits_during_a_run() -> Story:
    yield from _quit(_begin_run)


def quits_after_a_cancel() -> Story:
    """Cancelled, the thread goes on to the engine's next question."""
    yield from _quit(_begin_run, lambda: module("run.runner")._begun[-1][1].set())


def quits_during_a_search() -> Story:
    yield from _quit(_begin_search)
