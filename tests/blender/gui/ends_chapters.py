"""Runs and searches in a real window that something else ends: another file, undo, the extension's end, Blender's."""

import itertools
import sys
import threading
from collections.abc import Callable
from typing import Any

import bmesh
import bpy

import scenes
from driver import Story, in_view, tell
from panel import module, run_operator, set_options, solve_to, wait_until

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
    home = module("live.live")
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


def _is_searching() -> bool:
    return len(_threads()) == 1


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
