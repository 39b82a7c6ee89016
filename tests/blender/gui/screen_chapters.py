"""What is drawn in the view: strokes that fair, and arrows that pull the last run."""

from typing import Any

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

import scenes
from driver import Story, in_view, look_as_first, middle, move_mouse, press, screenshot, tell, view
from panel import (
    drag_over,
    module,
    open_tab,
    report,
    wait_until,
)

# Once around the middle.
AROUND = [(90, 0), (64, 64), (0, 90), (-64, 64), (-90, 0), (-64, -64), (0, -90), (64, -64), (90, -10)]


def _reported() -> bool:
    return bool(report().free_vertices)


def lasso_and_paint_fair() -> Story:
    """Drawn around, or painted over, and let go: fair, in one step of undo."""
    for tool in ("lasso", "paint"):
        scenes.ear()
        with in_view():
            bpy.ops.view3d.view_selected()
            bpy.ops.mesh.select_all(action="DESELECT")
            bpy.ops.wm.tool_set_by_id(name=f"intrinsic_fairing.{tool}")
        yield 0.5
        before = scenes.positions()
        report().free_vertices = 0
        yield from drag_over(AROUND)
        yield from wait_until(_reported, 20.0)
        yield 1.0
        screenshot(f"stroke_{tool}")
        assert abs(scenes.positions() - before).max() > 1e-4
        press("Z", *middle(), ctrl=True)
        yield 1.0
        assert (scenes.positions() == before).all(), f"{tool}: one step back is not where it began"
        with in_view():
            bpy.ops.wm.tool_set_by_id(name="builtin.select_box")


def arrows_pull_the_last_run() -> Story:
    """The middle of a faired region is pulled up, and back by one step.

    Once with answers at once, once with answers that follow.
    """
    home = module("run.background")
    for large in (home.LARGE, 0):
        home.LARGE, kept = large, home.LARGE
        yield from _arrows_are_pulled()
        home.LARGE = kept


def _arrows_are_pulled() -> Story:
    open_tab()
    scenes.hill(40)
    look_as_first()
    with in_view():
        bpy.ops.view3d.view_all()
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.wm.tool_set_by_id(name="intrinsic_fairing.paint")
        tool = bpy.context.workspace.tools.from_space_view3d_mode("EDIT_MESH")
        tool.operator_properties("mesh.fair_paint").MESH_OT_fair_stroke.radius = 60
    yield 0.5
    before = scenes.positions()
    report().free_vertices = 0
    yield from drag_over([(-60, 0), (60, 0)])
    yield from wait_until(_reported, 20.0)
    yield 1.5
    screenshot("arrow_bulge")
    faired = scenes.positions()
    foot, tip = _ends_of_arrow()
    yield from _pull(tip, (2.0 * tip[0] - foot[0], 2.0 * tip[1] - foot[1]))

    def follows() -> bool:
        return abs(scenes.positions() - faired).max() > 1e-3

    yield from wait_until(follows, 10.0)
    yield 1.0
    screenshot("arrow_bulge_pulled")
    lifted = (scenes.positions() - before)[:, 2]
    assert len(np.flatnonzero(lifted)) == report().free_vertices, "not what was painted over"
    assert lifted.max() > 0.02
    bulge = module("show.gizmos").options_of(bpy.context.active_operator, "MESH_OT_fair_region").bulge
    tell(f"bulge pulled to {bulge:.3f}")
    press("Z", *middle(), ctrl=True)
    yield 1.0
    assert (scenes.positions() == before).all(), "one step back is not where it began"
    with in_view():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")


def _ends_of_arrow() -> tuple[Any, Any]:
    """Foot and tip of the arrow that stands in the view, in pixels of the window."""
    middle_of = module("run.last_run").middle
    with in_view():
        place, normal, radius = middle_of(bpy.context)
    return _in_window(place, place + 0.25 * radius * normal)


def _in_window(*places: Any) -> tuple[tuple[int, int], ...]:
    """Places in world space, in pixels of the window."""
    _, area, region = view()
    there = [location_3d_to_region_2d(region, area.spaces.active.region_3d, Vector(place)) for place in places]
    return tuple((int(p.x) + region.x, int(p.y) + region.y) for p in there)


def _pull(begin: Any, end: Any, steps: int = 10) -> Story:
    """Press there, drag, and let go."""
    window = view()[0]
    for x, y in (begin, (begin[0] + 1, begin[1]), begin):  # a gizmo lights up first
        move_mouse(int(x), int(y))
        yield 0.5
    window.event_simulate(type="LEFTMOUSE", value="PRESS", x=int(begin[0]), y=int(begin[1]))
    for k in range(1, steps + 1):
        yield 0.1
        move_mouse(*(int(b + (e - b) * k / steps) for b, e in zip(begin, end, strict=True)))
    yield 0.5
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", x=int(end[0]), y=int(end[1]))
    yield 0.5


SCREENS = (
    lasso_and_paint_fair,
    arrows_pull_the_last_run,
)
