"""Long runs in a real window: cancelled, finished, and redone from their redo panel."""

from __future__ import annotations

import time
from collections.abc import Generator

import bpy
import numpy as np
import scenes
from driver import Story, in_view, leave_popup, middle, press, screenshot, tell, view
from panel import (
    WM_OT_story_redo,
    change_with,
    module,
    open_redo_panel,
    open_tab,
    redo_with,
    report,
    run_operator,
    set_options,
    wait_until,
)


def seconds_of_redraw() -> Generator[float, None, float]:
    """Software OpenGL may need long for a picture, in which Blender hears of nothing."""
    worst = 0.0
    for _ in range(3):
        view()[1].tag_redraw()
        begin = time.perf_counter()
        yield 0.0
        yield 0.0
        worst = max(worst, time.perf_counter() - begin)
    return worst


def seconds_to_background() -> Generator[float, None, float]:
    """Call the operator and wait until it runs in the background."""
    progress = bpy.context.window_manager.fairing_progress
    begin = time.perf_counter()
    run_operator()

    def running() -> bool:
        return bool(progress.running)

    yield from wait_until(running, 20.0)
    return time.perf_counter() - begin


def seconds_to_stop() -> Generator[float, None, float]:
    """Press Esc and wait until nothing runs any more."""
    progress = bpy.context.window_manager.fairing_progress
    begin = time.perf_counter()
    press("ESC", *middle())

    def stopped() -> bool:
        return not progress.running

    yield from wait_until(stopped, 5.0)
    return time.perf_counter() - begin


def cancel_a_long_run() -> Story:
    faces = scenes.large()
    set_options()
    with in_view():
        bpy.ops.view3d.view_all()
    open_tab()
    yield 1.0
    redraw = yield from seconds_of_redraw()
    tell(f"large: {faces} faces; a redraw takes {redraw:.2f} s here")
    before = scenes.contents()
    progress = bpy.context.window_manager.fairing_progress
    waited = yield from seconds_to_background()
    tell(f"background run began after {waited:.2f} s")
    yield 0.3
    assert progress.running, "the run was too short to be cancelled"
    seconds = yield from seconds_to_stop()
    tell(f"Esc: Blender was free again after {seconds:.2f} s")
    assert seconds < 0.3 + 3 * redraw  # the first surface is shown, and taken back
    yield 2.0
    assert scenes.contents() == before, "the cancelled run left a trace"
    assert not progress.running


def cancel_a_hopeless_run() -> Story:
    """Few vertices that take long: Blender waits a moment, then goes on in the background."""
    scenes.hopeless()
    set_options(shape="HARMONIC", tolerance=1e-14)  # Automatic has a surface at once
    open_tab()
    yield 1.0
    before = scenes.contents()
    waited = yield from seconds_to_background()
    tell(f"hopeless: in the background after {waited:.2f} s")
    yield 0.1
    yield from seconds_to_stop()
    yield 1.0
    assert scenes.contents() == before, "the cancelled run left a trace"


def finish_a_long_run() -> Story:
    report().free_vertices = 0
    redraw = yield from seconds_of_redraw()
    begin = time.perf_counter()
    ticks = 0
    run_operator()

    def reported() -> bool:
        nonlocal ticks
        ticks += 1
        if ticks == 2:
            screenshot("progress")
        return bool(report().free_vertices)

    yield from wait_until(reported, 120.0)
    seconds = time.perf_counter() - begin
    tell(f"large: {report().free_vertices} vertices in {seconds:.2f} s, looked at {ticks} times meanwhile")
    assert seconds / ticks < 0.3 + 2 * redraw, "Blender did not stay responsive"
    assert report().converged
    yield 0.5


def redo_after_a_long_run() -> Story:
    """Another way to spread the vertices, chosen in the redo panel: answered by the solver that the run left."""
    solvers = module("run.job").solvers
    *_, solver = solvers._values.values()
    assert solver is not None
    first, before = report().seconds, scenes.positions()
    yield from open_redo_panel()
    screenshot("redo_long_open")
    yield from redo_with(inner_fairness="INVERSE_DISTANCE")
    yield 0.5
    operator = bpy.context.window_manager.operators[-1]
    assert operator.inner_fairness == "INVERSE_DISTANCE"
    assert report().converged
    assert np.abs(scenes.positions() - before).max() > 1e-4
    assert list(solvers._values.values())[-1] is solver
    tell(f"redo: {operator.inner_fairness} answered in {report().seconds:.2f} s, the run took {first:.2f} s")
    screenshot("redo_long")


class _Looks:
    """How long each look at a search has held Blender up."""

    def __init__(self) -> None:
        self.seconds: list[tuple[float, float]] = []  # of the processor, and by the wall
        self.home = module("run.redo")
        self.look = self.home._look
        self.home._look = self

    def __call__(self) -> float | None:
        begin = time.thread_time(), time.perf_counter()
        again: float | None = self.look()
        self.seconds.append((time.thread_time() - begin[0], time.perf_counter() - begin[1]))
        return again

    def end(self) -> None:
        self.home._look = self.look


def _longest(seconds: list[tuple[float, float]]) -> str:
    spent, passed = (1e3 * max(column) for column in zip(*seconds, strict=True))
    return f"{spent:.0f} ms of the processor, {passed:.0f} by the wall"


def changes_in_the_redo_panel_do_not_wait() -> Story:
    """Two changes one after the other, then one: what is shown does not wait, and undo takes all of it back."""
    progress = bpy.context.window_manager.fairing_progress
    for subdivisions in (6, 7):
        scenes.large(subdivisions)
        set_options()
        open_tab()
        yield 1.0
        report().free_vertices = 0
        run_operator()

        def reported() -> bool:
            return bool(report().free_vertices)

        yield from wait_until(reported, 120.0)
        yield 1.0
        first = scenes.positions()
        yield from open_redo_panel()
        changes, looks = WM_OT_story_redo.seconds, _Looks()
        changes.clear()

        def settled() -> bool:
            return not progress.following

        yield from change_with(inner_fairness="CONFORMAL")
        yield from change_with(inner_fairness="UNIFORM", shape="LEAST_VARIATION")
        yield 0.3
        assert progress.following, "the search was too short to be seen"
        assert np.abs(scenes.positions() - first).max() < 1e-6, "the result before the change is not shown"
        screenshot(f"redo_following_{subdivisions}")
        yield from wait_until(settled, 120.0)
        yield 0.5
        assert report().verdict == "GOOD", (report().verdict, report().reason)
        assert np.abs(scenes.positions() - first).max() > 1e-4
        answer = scenes.positions()
        yield from redo_with(shape="HARMONIC", bulge=0.5)  # of which there is no surface
        assert "The surface before was kept" in report().reason, report().reason
        assert (scenes.positions() == answer).all()
        screenshot(f"redo_refused_{subdivisions}")
        yield from leave_popup()
        yield from redo_with(shape="MINIMAL_ENERGY", bulge=0.0)
        assert report().written and "kept" not in report().reason, report().reason
        looks.end()
        tell(f"redo of {report().free_vertices}: a change holds Blender up for {_longest(changes)}")
        tell(f"redo of {report().free_vertices}: a look, or the answer, for {_longest(looks.seconds)}")
        last = scenes.positions()
        press("Z", *middle(), ctrl=True)
        yield 1.0
        assert (scenes.positions() == scenes.original()).all(), "undo did not take the run back"
        press("Z", *middle(), ctrl=True, shift=True)
        yield 1.0
        assert (scenes.positions() == last).all(), "redo did not bring the answer back"
        assert np.median([spent for spent, _ in changes]) < 0.1  # Python's collector takes .05 s now and then
