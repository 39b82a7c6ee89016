"""What the interface looks like: every panel, menu and tool, one picture each, to be looked at."""

from typing import Any

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

import scenes
import spoilt_scenes
from driver import Story, in_view, look_as_first, middle, move_mouse, press, screenshot, tell, view
from panel import (
    drag_over,
    module,
    open_panels,
    open_redo_panel,
    open_tab,
    redo_panel,
    report,
    run_operator,
    set_options,
    wait_until,
)

# Once around the middle.
AROUND = [(90, 0), (64, 64), (0, 90), (-64, 64), (-90, 0), (-64, -64), (0, -90), (64, -64), (90, -10)]
TOOLS = {
    "EDIT_MESH": ("intrinsic_fairing.lasso", "intrinsic_fairing.paint", "intrinsic_fairing.fillet"),
    "SCULPT": ("intrinsic_fairing.brush", "intrinsic_fairing.face_set"),
    "OBJECT": ("intrinsic_fairing.face_set",),
}
MENUS = {
    "EDIT_MESH": (
        "VIEW3D_MT_edit_mesh_faces",
        "VIEW3D_MT_edit_mesh_edges",
        "VIEW3D_MT_edit_mesh_vertices",
        "VIEW3D_MT_edit_mesh_clean",
        "VIEW3D_MT_edit_mesh_context_menu",
        "MESH_MT_fair_region_runs",
        "MESH_MT_fair_fill_runs",
    ),
    "SCULPT": ("VIEW3D_MT_mask", "VIEW3D_MT_face_sets"),
    "OBJECT": ("VIEW3D_MT_object",),
}


def _reported() -> bool:
    return bool(report().free_vertices)


def _mode(mode: str) -> None:
    with in_view():
        bpy.ops.object.mode_set(mode={"EDIT_MESH": "EDIT"}.get(mode, mode))


def _faired_ear(**options: Any) -> Story:
    scenes.ear()
    with in_view():
        bpy.ops.view3d.view_selected()
    set_options(**options)
    open_tab()
    yield 0.5
    report().free_vertices = 0
    run_operator()
    yield from wait_until(_reported, 30.0)
    yield 1.5


def panels_are_seen() -> Story:
    """The sidebar with all its panels open, after a run with options that are not the defaults."""
    open_panels()
    yield from _faired_ear(factor=0.8, bulge=0.1)
    screenshot("panels")
    bpy.context.window_manager.fairing_overlay.show = True
    region = next(r for r in view()[1].regions if r.type == "UI")
    for _ in range(12):
        press("WHEELDOWNMOUSE", region.x + region.width // 2, region.y + region.height // 2)
        yield 0.1
    yield 0.5
    screenshot("panels_below")
    bpy.context.window_manager.fairing_overlay.show = False
    for mode in ("OBJECT", "SCULPT"):
        _mode(mode)
        open_tab()
        yield 1.0
        screenshot(f"panels_{mode.lower()}")
    _mode("OBJECT")


def redo_panels_are_seen() -> Story:
    """Those of all operators, with Advanced open."""
    yield from _faired_ear()
    yield from open_redo_panel()
    screenshot("redo_region")
    bpy.context.window_manager.fairing_advanced = True
    redo_panel().tag_redraw()
    yield 1.0
    screenshot("redo_region_advanced")
    bpy.context.window_manager.fairing_advanced = False
    spoilt_scenes.hole()
    with in_view():
        bpy.ops.view3d.view_all()
    run_operator("mesh.fair_fill")
    yield 2.0
    screenshot("redo_fill")
    _mode("OBJECT")


def menus_are_seen() -> Story:
    """Each menu that has an entry of ours, and the pie."""
    scenes.ear()
    for mode, menus in MENUS.items():
        _mode(mode)
        yield 0.3
        for menu in menus:
            yield from menu_is_seen(menu)
        with in_view():
            bpy.ops.wm.call_menu_pie(name="VIEW3D_MT_fair_pie")
        yield 0.7
        screenshot(f"pie_{mode.lower()}")
        press("ESC", *middle())
        yield 0.3
    _mode("OBJECT")


def menu_is_seen(menu: str) -> Story:
    """Open it at the pointer and close it again."""
    move_mouse(*middle())
    yield 0.2
    with in_view():
        bpy.ops.wm.call_menu(name=menu)
    yield 0.7
    screenshot(f"menu_{menu}")
    press("ESC", *middle())
    yield 0.3


def tools_are_seen() -> Story:
    """The toolbar's tools with their options in the header."""
    scenes.ear()
    view()[1].spaces.active.show_region_toolbar = True
    view()[1].spaces.active.show_region_tool_header = True
    for mode, tools in TOOLS.items():
        _mode(mode)
        yield 0.3
        for tool in tools:
            with in_view():
                bpy.ops.wm.tool_set_by_id(name=tool)
            yield 0.7
            screenshot(f"tool_{mode.lower()}_{tool.rpartition('.')[2]}")
        with in_view():
            bpy.ops.wm.tool_set_by_id(name="builtin.select_box")
    _mode("OBJECT")


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


def overlays_are_seen() -> Story:
    """Every look of the overlay with its legend."""
    yield from _faired_ear()
    settings = bpy.context.window_manager.fairing_overlay
    settings.scope = "OBJECT"
    settings.show = True
    for mode in (item.identifier for item in settings.bl_rna.properties["mode"].enum_items):
        settings.mode = mode
        yield 1.5
        screenshot(f"overlay_{mode.lower()}")
    settings.property_unset("mode")
    settings.show = False


SCREENS = (
    panels_are_seen,
    redo_panels_are_seen,
    menus_are_seen,
    tools_are_seen,
    lasso_and_paint_fair,
    arrows_pull_the_last_run,
    overlays_are_seen,
)
