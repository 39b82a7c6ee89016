"""Ten jobs as somebody does them who has read the tooltips alone: what is in sight, F3 and words, the mouse."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np
from mathutils import Vector

import scenes
import spoilt_scenes
from driver import Story, in_view, leave_popup, look_as_first, middle, move_mouse, press, screenshot, tell, view
from panel import drag, drag_over, module, open_tab, report, run_with, wait_until

KEYS = {" ": "SPACE"}
_acts = [0]  # clicks, strokes, keys and words since the job began


def _act(count: int = 1) -> None:
    _acts[0] += count


def _rested() -> Story:
    """Until a run has ended, also one in the background."""
    yield 0.5

    def rests() -> bool:
        return not bpy.context.window_manager.fairing_progress.running

    yield from wait_until(rests, 60.0)
    yield 0.5


def search(words: str) -> Story:
    """F3, the words, Enter: the first entry must be the one."""
    _act(3)
    x, y = middle()
    move_mouse(x, y)
    press("F3", x, y)
    yield 0.6
    for letter in words.lower():
        kind = KEYS.get(letter, letter.upper())
        view()[0].event_simulate(type=kind, value="PRESS", unicode=letter, x=x, y=y)
        view()[0].event_simulate(type=kind, value="RELEASE", x=x, y=y)
        yield 0.05
    yield 0.8
    screenshot(f"search_{words.replace(' ', '_')}")
    press("RET", x, y)
    yield from _rested()


def _key(key: str, **modifiers: bool) -> Story:
    _act()
    press(key, *middle(), **modifiers)
    yield 0.4


def _tool(name: str) -> None:
    """Click a tool in the toolbar."""
    _act()
    with in_view():
        bpy.ops.wm.tool_set_by_id(name=f"intrinsic_fairing.{name}")


def _stroke(places: list[tuple[int, int]]) -> Story:
    _act()
    yield from drag_over(places)
    yield from _rested()


def _around(x: int, y: int, radius: int) -> list[tuple[int, int]]:
    """A circle around a place, in pixels from the middle of the view."""
    angles = np.linspace(0.0, 2.0 * np.pi, 13)
    return [(x + int(radius * np.cos(a)), y + int(radius * np.sin(a))) for a in angles]


def _look_at(place: tuple[float, float, float], distance: float) -> None:
    """Turn the view so that this direction is in front, at a distance: a matter of taste, not counted."""
    data = view()[1].spaces.active.region_3d
    data.view_rotation = Vector(place).to_track_quat("Z", "Y")
    data.view_distance, data.view_location = distance, (0.0, 0.0, 0.0)


def _mode(mode: str) -> None:
    with in_view():
        bpy.ops.object.mode_set(mode=mode)


def ear() -> Story:
    scenes.ear()
    with in_view():
        bpy.ops.view3d.view_selected()
        bpy.ops.mesh.select_all(action="DESELECT")
    _tool("lasso")
    yield from _stroke(_around(200, -50, 290))


def dent() -> Story:
    spoilt_scenes.dented()
    _look_at((0.5, -0.7, 0.5), 5.0)
    _mode("SCULPT")
    _tool("brush")
    tool = bpy.context.workspace.tools.from_space_view3d_mode("SCULPT")
    tool.operator_properties("mesh.fair_brush").radius = 90
    _act()
    yield from _stroke([(-60, 0), (60, 0), (0, 60), (0, -60), (0, 0)])


def scan_hole() -> Story:
    spoilt_scenes.hole()
    yield from search("fair fill")


def thirteen_holes() -> Story:
    scenes.clear()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    points = spoilt_scenes.object_positions()
    towards = points[:: len(points) // 13][:13]
    _mode("EDIT")
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    gone = [f for f in bm.faces if (towards @ np.array(f.calc_center_median())).max() > 0.985]
    bmesh.ops.delete(bm, geom=gone, context="FACES")
    bmesh.update_edit_mesh(bpy.context.object.data)
    bpy.ops.ed.undo_push(message="scene")
    yield from _key("A")
    yield from search("fair fill")


def fillet() -> Story:
    scenes.clear()
    bpy.ops.mesh.primitive_cube_add()
    _mode("EDIT")
    look_as_first()
    with in_view():
        bpy.ops.view3d.view_all()
        bpy.ops.mesh.select_all(action="DESELECT")
    yield from _key("TWO")
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    for edge in bm.edges:  # a click on the edge
        edge.select_set(all(v.co.x > 0.0 and v.co.z > 0.0 for v in edge.verts))
    bmesh.update_edit_mesh(bpy.context.object.data)
    bpy.ops.ed.undo_push(message="edge")
    _act()
    yield from search("fair fillet")
    move_mouse(middle()[0] + 80, middle()[1])
    yield 1.0
    yield from _key("LEFTMOUSE")


def bridge() -> Story:
    scenes.clear()
    for angle, place in ((0.0, (0.0, 0.0, 0.0)), (np.radians(70.0), (0.94, 0.0, 1.34))):
        bpy.ops.mesh.primitive_cylinder_add(vertices=32, end_fill_type="NOTHING", radius=0.4, depth=1.2)
        bpy.context.object.rotation_euler, bpy.context.object.location = (0.0, angle, 0.0), place
    for obj in bpy.data.objects:
        obj.select_set(True)
    bpy.ops.object.join()
    _mode("EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    world = bpy.context.object.matrix_world
    rims = [((0.0, 0.0, 0.6)), (0.376, 0.0, 1.135)]

    def is_inner(edge: Any) -> bool:
        middles = np.array(world @ ((edge.verts[0].co + edge.verts[1].co) / 2.0))
        return edge.is_boundary and min(np.linalg.norm(middles - rim) for rim in rims) < 0.45

    for edge in bm.edges:  # two clicks with Alt
        edge.select_set(is_inner(edge))
    bmesh.update_edit_mesh(bpy.context.object.data)
    bpy.ops.ed.undo_push(message="rims")
    _act(2)
    yield from search("fair bridge")


def swelling_on_skin() -> Story:
    """Blender's menu first; then the one button that the verdict offers."""
    spoilt_scenes.grainy()
    _act()
    yield from search("fair region")
    yield 1.0
    tell(f"  said: {report().verdict} {report().reason}; offered: {report().remedies}")
    screenshot("job_swelling_first")
    if report().remedies:
        _act()
        run_with("fair_again", way=report().remedies.split(",")[0])
        yield from _rested()


def masked_cheek() -> Story:
    spoilt_scenes.masked()
    _mode("SCULPT")
    yield 0.5
    yield from search("fair masked")


def face_set() -> Story:
    spoilt_scenes.face_sets()
    _mode("SCULPT")
    with in_view():
        bpy.ops.view3d.view_all()
    _tool("face_set")
    yield 0.5
    yield from _key("LEFTMOUSE")
    yield from _rested()


def live() -> Story:
    scenes.bottle()
    look_as_first()
    with in_view():
        bpy.ops.view3d.view_all()
    _act()
    run_with("fair_live_region")  # the button in the panel Live
    yield from _rested()
    _act()
    before = scenes.positions()
    scenes.select_vertices(before[:, 2] > 0.59 - 1e-6)
    yield 0.5
    yield from drag(10, (90, 20))
    yield from _key("LEFTMOUSE")
    yield 1.0
    free = next(iter(module("live.live").live.sessions.values())).region.free
    assert np.abs(scenes.positions() - before)[free].max() > 0.05
    bpy.context.window_manager.fairing_live.on = False


JOBS: tuple[Callable[[], Story], ...] = (
    ear, dent, scan_hole, thirteen_holes, fillet, bridge, swelling_on_skin, masked_cheek, face_set, live,
)  # fmt: skip


def ten_jobs() -> Story:
    """All of them; each leaves a picture, how many acts it took, and what the verdict says."""
    for job in JOBS:
        with in_view():
            if bpy.context.mode != "OBJECT":
                bpy.ops.object.mode_set(mode="OBJECT")
        _acts[0] = 0
        report().free_vertices, report().reason, report().verdict = 0, "", "GOOD"
        open_tab()
        begin = time.perf_counter()
        try:
            yield from job()
        except TimeoutError as late:
            tell(f"  {job.__name__}: {late}")
        yield 1.0
        screenshot(f"job_{job.__name__}")
        yield from leave_popup()
        seen: Any = report()
        tell(
            f"{job.__name__}: {_acts[0]} acts, {time.perf_counter() - begin:.0f} s of this window, engine "
            f"{seen.seconds:.2f} s, {seen.free_vertices} vertices, {seen.verdict} {seen.reason}"
        )
