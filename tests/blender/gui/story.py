"""What an artist does, in a real window: look, fair, adjust, cancel, judge. Makes the guide's pictures."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import bpy
import numpy as np

import scenes
from driver import Story, in_view, middle, play, press, screenshot, tell
from ends_chapters import quits_after_a_cancel, quits_during_a_run, quits_during_a_search
from fillet_chapters import fillet_is_dragged
from live_chapters import live_follows_a_drag, live_follows_a_pin
from long_run_chapters import cancel_a_long_run, finish_a_long_run
from panel import extension, module, open_redo_panel, open_tab, redo_with, report, run_operator, wait_until
from redo_chapters import a_field_of_the_redo_panel_is_pulled
from screen_chapters import SCREENS
from sculpt_chapters import brush_in_sculpt_mode, face_set_by_a_click
from verdict_chapters import marks_before_a_run, not_usable


def look_before_running() -> Story:
    faces = scenes.ear()
    with in_view():
        bpy.ops.view3d.view_selected()
    open_tab()
    watch = module("selection.watch").watch

    def looked() -> bool:
        return bool(not watch.stale and watch.found)

    yield from wait_until(looked, 10.0)
    yield 0.5
    (found,) = watch.found
    assert (found.faces, found.refusal, found.loops, found.islands) == (faces, "", 1, 1), found
    tell(f"selection: {found.faces} faces, {found.free_vertices} free vertices")
    for _ in range(4):  # the panel must not keep looking for ever
        yield 0.3
        assert not watch.stale
    screenshot("selection")


def reported_before_running() -> Story:
    """The panel says why nothing would happen, and running says the same and changes nothing."""
    scenes.single_face()
    open_tab()
    watch = module("selection.watch").watch

    def has_said() -> bool:
        return bool(not watch.stale and watch.found and "No vertex is free" in watch.found[0].refusal)

    yield from wait_until(has_said, 10.0)
    yield 0.5
    screenshot("refusal")
    before = scenes.contents()
    run_operator()
    yield 1.0
    assert scenes.contents() == before
    scenes.ear()
    with in_view():
        bpy.ops.view3d.view_selected()
    open_tab()
    yield 0.5


def fair_it() -> Story:
    before = scenes.positions()
    run_operator()

    def reported() -> bool:
        return bool(report().free_vertices)

    yield from wait_until(reported, 20.0)
    yield 1.0
    assert report().converged
    assert np.abs(scenes.positions() - before).max() > 0.1
    tell(f"ear: {report().free_vertices} vertices in {report().seconds:.2f} s, {report().boundary_angle:.2g}°")
    screenshot("result")


def adjust_in_redo_panel() -> Story:
    """Set Factor to 0.5 where the panel at the lower left has it."""
    fair = scenes.positions()
    yield from open_redo_panel()
    screenshot("redo_open")
    yield from redo_with(factor=0.5)
    yield 1.0
    operator = bpy.context.window_manager.operators[-1]
    assert abs(operator.properties.factor - 0.5) < 1e-6, operator.properties.factor
    half = scenes.positions()
    expected = 0.5 * (scenes.original() + fair)
    assert np.abs(half - expected).max() < 1e-6, np.abs(half - expected).max()
    tell(f"redo: factor 0.5 answered in {report().seconds:.3f} s")
    screenshot("redo")


CHAPTERS = (
    look_before_running,
    reported_before_running,
    fair_it,
    adjust_in_redo_panel,
    cancel_a_long_run,
    finish_a_long_run,
    a_field_of_the_redo_panel_is_pulled,
    marks_before_a_run,
    not_usable,
    fillet_is_dragged,
    face_set_by_a_click,
    brush_in_sculpt_mode,
    live_follows_a_drag,
    live_follows_a_pin,
    *SCREENS,
)
# Each ends Blender, so that it has one of its own; they are played only where they are named.
ENDINGS = (quits_during_a_run, quits_after_a_cancel, quits_during_a_search)


def story() -> Story:
    """Play every chapter, or those that FAIRING_CHAPTERS names."""
    chosen = os.environ.get("FAIRING_CHAPTERS", "").split()
    unknown = set(chosen) - {chapter.__name__ for chapter in (*CHAPTERS, *ENDINGS)}
    assert not unknown, f"there is no chapter {', '.join(sorted(unknown))}"
    extension()
    yield 1.0
    bpy.ops.wm.save_userpref()  # the command line finds the extension enabled
    press("ESC", *middle())  # the splash screen of a first start
    yield 0.5
    for chapter in (*CHAPTERS, *ENDINGS):
        if chapter.__name__ not in (chosen or [kept.__name__ for kept in CHAPTERS]):
            continue
        tell(f"== {chapter.__name__}")
        yield from chapter()


play(story)
