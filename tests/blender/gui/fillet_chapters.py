"""Fair Fillet by the mouse: the width follows, the wheel turns the profile, Esc leaves all, a click is one step."""

from typing import Any

import bmesh
import bpy
import numpy as np

import scenes
from driver import Story, click, in_view, middle, move_mouse, press, screenshot, tell, view
from panel import module, open_tab, run_operator, wait_until

FAR = 120  # pixels


def _cube() -> None:
    """A cube in edit mode, one of its edges selected."""
    scenes.clear()
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    for edge in bm.edges:
        edge.select_set(all(v.co.x > 0.0 and v.co.y < 0.0 for v in edge.verts))
    bm.select_flush_mode()
    bmesh.update_edit_mesh(bpy.context.object.data)
    bpy.ops.ed.undo_push(message="scene")
    with in_view():
        bpy.ops.view3d.view_all()


def _running() -> Any:
    """The operator that follows the mouse, or None."""
    window = bpy.context.window_manager.windows[0]
    return next((each for each in window.modal_operators if each.bl_idname == "MESH_OT_fair_fillet"), None)


def _follows() -> bool:
    return _running() is not None


def _has_ended() -> bool:
    return _running() is None


def _drag() -> Story:
    """Begin, and pull to a width."""
    x, y = middle()
    move_mouse(x, y)  # where the width is 0
    yield 0.3
    run_operator("mesh.fair_fillet")
    yield from wait_until(_follows, 5.0)
    for offset in (FAR // 3, 2 * FAR // 3, FAR):
        move_mouse(x + offset, y)
        yield 0.4


def fillet_is_dragged() -> Story:
    """Esc leaves the mesh bit for bit; a click writes what was shown; undo takes it back in one step."""
    _cube()
    open_tab()
    yield 1.0
    before = scenes.contents()
    fillet, said, shown = module("fillet.operator"), list[Any](), list[Any]()
    say = fillet.say
    fillet.say = lambda context, text: (said.append(text), say(context, text))
    show = fillet.show
    fillet.show = lambda surfaces: (shown.append(surfaces), show(surfaces))
    try:
        yield from _drag()
        width = _running().width
        x, y = middle()
        view()[0].event_simulate(type="WHEELUPMOUSE", value="PRESS", x=x + FAR, y=y)  # a wheel has no release
        yield 0.6
        assert abs(_running().profile - 0.1) < 1e-6, _running().profile
        assert f"Width {width:.4g}   Profile +0.10" in said[-1], said[-1]
        assert shown[-1], "nothing is previewed"
        assert scenes.contents() == before
        screenshot("fillet_dragged")
        press("ESC", x + FAR, y)
        yield from wait_until(_has_ended, 5.0)
        yield 0.5
        assert said[-1] is None, said[-1]
        assert shown[-1] == []
        assert scenes.contents() == before
        yield from _drag()
        assert abs(_running().width - width) < 0.01 * width, (_running().width, width)
        new = sum(len(each.result.vertices) for each in _running()._found)
        yield from click(x + FAR, y)
        yield from wait_until(_has_ended, 10.0)
        yield 1.0
        assert len(scenes.positions()) == 6 + new, new  # the edge's ends are cut off
        tell(f"fillet: width {width:.3g}, {new} new vertices")
        screenshot("fillet_accepted")
        press("Z", *middle(), ctrl=True)
        yield 1.0
        assert scenes.contents() == before
        press("Z", *middle(), ctrl=True, shift=True)
        yield 1.0
        assert len(scenes.positions()) == 6 + new
        assert np.isfinite(scenes.positions()).all()
    finally:
        fillet.say = say
        fillet.show = show
