"""After a run in the window: good, worth a look, not usable; what the buttons do, and marks before a run."""

from contextlib import suppress
from typing import Any

import bpy
import numpy as np

import scenes
import spoilt_scenes
from driver import Story, in_view, leave_popup, middle, press, screenshot, tell
from panel import module, open_tab, report, run_operator, run_with, set_options, wait_until


def reported() -> bool:
    return bool(report().free_vertices)


def run_and_wait(**options: Any) -> Story:
    """Run the operator with its defaults, apart from these.

    What is not usable is said in the report; where that took but a moment, Python is told so as well.
    """
    set_options(**options)
    report().free_vertices = 0
    with suppress(RuntimeError):
        run_operator()
    yield from wait_until(reported, 60.0)
    yield 1.0


def _look() -> Story:
    """Wait until the panel has looked at the selection."""
    watch = module("selection.watch").watch
    open_tab()

    def looked() -> bool:
        return bool(not watch.stale and watch.found)

    yield from wait_until(looked, 10.0)
    yield 0.7


def framed(make: Any) -> Story:
    """Make a scene and look at what is selected."""
    tell(f"{make.__name__}: {make()} faces selected of {len(bpy.context.object.data.polygons)}")
    with in_view():
        bpy.ops.view3d.view_selected()
    open_tab()
    yield 0.7


def marks_before_a_run() -> Story:
    """A spoilt rim: its vertices are marked, and the buttons below mend it."""
    set_options()
    yield from framed(spoilt_scenes.spoilt_rim)
    yield from _look()
    (found,) = module("selection.watch").watch.found
    assert len(found.bad) > 3, found
    tell(f"bad boundary vertices: {len(found.bad)}")
    screenshot("marks")
    with in_view():
        bpy.ops.mesh.fair_select("EXEC_DEFAULT", True, what="BAD")
    yield from _look()
    screenshot("marks_bad")


def not_usable() -> Story:
    """Half a sphere with a bulge that it hasn't got: nothing changes, the reason and the buttons are there."""
    yield from framed(spoilt_scenes.dome)
    before = scenes.positions()
    yield from run_and_wait(shape="HARMONIC", bulge=0.3)
    assert (report().verdict, report().written) == ("UNUSABLE", False), report().reason
    assert scenes.positions().tobytes() == before.tobytes()
    tell(f"not usable: {report().reason}")
    yield 3.0  # panels glide to their places
    screenshot("not_usable")
    yield from leave_popup()
    run_with("fair_again", remedy="WRITE")

    def written() -> bool:
        return bool(report().written)

    yield from wait_until(written, 20.0)
    yield 1.0
    assert scenes.positions().tobytes() != before.tobytes()
    screenshot("not_usable_written")
    press("Z", *middle(), ctrl=True)
    yield 1.0
    screenshot("not_usable_undone")
    np.testing.assert_array_equal(scenes.positions(), before)
