"""Changes in the redo panel, in a real window: Blender goes on, and the answer follows."""

import bpy

import scenes
from driver import Story, middle, move_mouse, press, view
from panel import (
    open_redo_panel,
    open_tab,
    redo_panel,
    report,
    run_operator,
    set_options,
    wait_until,
)

FACTOR = 73  # pixels from the panel's top to the field Factor


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

    def completed() -> bool:
        return not progress.following

    yield from wait_until(completed, 60.0)
    yield 0.5
    assert bpy.context.window_manager.operators[-1].factor == factor
    assert report().verdict == "GOOD", report().reason
    press("Z", *middle(), ctrl=True)
    yield 1.0
    assert (scenes.positions() == scenes.original()).all(), "undo did not take the run back"
