"""Changes in the redo panel, in a real window: Blender goes on, and the answer follows."""

import bpy
import numpy as np

import scenes
from driver import Story, leave_popup, middle, move_mouse, press, screenshot, view
from panel import (
    change_with,
    open_redo_panel,
    open_tab,
    redo_panel,
    redo_with,
    report,
    run_operator,
    set_options,
    wait_until,
)

FACTOR = 73  # pixels from the panel's top to the field Factor


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

        def settled() -> bool:
            return not progress.following

        yield from change_with(inner_fairness="CONFORMAL")
        yield from change_with(inner_fairness="UNIFORM", shape="LEAST_VARIATION")
        yield 0.1
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
        last = scenes.positions()
        press("Z", *middle(), ctrl=True)
        yield 1.0
        assert (scenes.positions() == scenes.original()).all(), "undo did not take the run back"
        press("Z", *middle(), ctrl=True, shift=True)
        yield 1.0
        assert (scenes.positions() == last).all(), "redo did not bring the answer back"


def a_field_of_the_redo_panel_is_pulled() -> Story:
    """Factor, in small steps, with a rest: no answer takes the field away from the hand."""
    progress = bpy.context.window_manager.fairing_progress
    scenes.large(6)
    set_options()
    open_tab()
    yield 1.0
    report().free_vertices = 0
    run_operator()

    def reported() -> bool:
        return bool(report().free_vertices)

    yield from wait_until(reported, 120.0)
    yield 1.0
    yield from open_redo_panel()
    yield 1.0
    panel, window = redo_panel(), view()[0]
    x, y = panel.x + 200, panel.y + panel.height - FACTOR
    move_mouse(x, y)
    yield 0.3
    window.event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    for rest in (3.0, 0.0):
        for _ in range(20):
            x -= 3
            move_mouse(x, y)
            yield 0.04
        yield rest
    factor = bpy.context.window_manager.operators[-1].factor
    assert 0.1 < factor < 0.5, f"{factor}: the field was taken away, or lies elsewhere"
    assert progress.following, "an answer was written meanwhile"
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y)

    def settled() -> bool:
        return not progress.following

    yield from wait_until(settled, 60.0)
    yield 0.5
    assert bpy.context.window_manager.operators[-1].factor == factor
    assert report().verdict == "GOOD", report().reason
    press("Z", *middle(), ctrl=True)
    yield 1.0
    assert (scenes.positions() == scenes.original()).all(), "undo did not take the run back"
