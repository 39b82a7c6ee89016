"""Long runs in a real window: cancelled, finished, and redone from their redo panel."""

import bpy

import scenes
from driver import Story, in_view, middle, press, screenshot, tell
from panel import open_tab, report, run_operator, set_options, wait_until


def in_background() -> Story:
    """Call the operator and wait until it runs in the background."""
    progress = bpy.context.window_manager.fairing_progress
    run_operator()

    def running() -> bool:
        return bool(progress.running)

    yield from wait_until(running, 20.0)


def stopped_by_escape() -> Story:
    """Press Esc and wait until nothing runs any more."""
    progress = bpy.context.window_manager.fairing_progress
    press("ESC", *middle())

    def stopped() -> bool:
        return not progress.running

    yield from wait_until(stopped, 5.0)


def cancel_a_long_run() -> Story:
    faces = scenes.large()
    set_options()
    with in_view():
        bpy.ops.view3d.view_all()
    open_tab()
    yield 1.0
    tell(f"large: {faces} faces")
    before = scenes.contents()
    progress = bpy.context.window_manager.fairing_progress
    yield from in_background()
    yield 0.3
    assert progress.running, "the run was too short to be cancelled"
    yield from stopped_by_escape()
    yield 2.0
    assert scenes.contents() == before, "the cancelled run left a trace"
    assert not progress.running


def finish_a_long_run() -> Story:
    report().free_vertices = 0
    ticks = 0
    run_operator()

    def reported() -> bool:
        nonlocal ticks
        ticks += 1
        if ticks == 1:
            screenshot("progress")
        return bool(report().free_vertices)

    yield from wait_until(reported, 120.0)
    tell(f"large: {report().free_vertices} vertices, looked at {ticks} times meanwhile")
    assert ticks > 1, "Blender did not stay responsive"
    assert report().converged
    yield 0.5
