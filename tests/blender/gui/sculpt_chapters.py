"""Outside edit mode: a face set that is clicked and a stroke of the brush, and undo."""

import bpy
import numpy as np

import spoilt_scenes
from driver import Story, in_view, middle, press, screenshot, tell
from panel import drag_over, module, open_tab, report, wait_until


def _reported() -> bool:
    return bool(report().free_vertices)


def _undo(redo: bool = False) -> Story:
    press("Z", *middle(), ctrl=True, shift=redo)
    yield 1.0


def _begin_sculpting() -> None:
    """Go to sculpt mode, with a step to come back to."""
    with in_view():
        bpy.ops.view3d.view_all()
        bpy.ops.object.mode_set(mode="SCULPT")
        bpy.ops.ed.undo_push(message="start")


def _now() -> np.ndarray:
    """Positions and mask (n, 4) of the object, whichever mode it is in."""
    return np.column_stack([spoilt_scenes.object_positions(), spoilt_scenes.mask()])


def face_set_by_a_click() -> Story:
    """Two face sets: the tool takes the one that is clicked; at once, and in the background."""
    home = module("run.background")
    for name, large in (("at_once", 1_000_000), ("in_background", 1)):
        home.LARGE, kept = large, home.LARGE
        yield from _clicked_and_undone(name)
        home.LARGE = kept


def _clicked_and_undone(name: str) -> Story:
    tell(f"face sets: {spoilt_scenes.face_sets()} faces in one of them; {name}")
    _begin_sculpting()
    open_tab()
    yield 0.7
    before = _now()
    report().free_vertices = 0
    with in_view():
        bpy.ops.wm.tool_set_by_id(name="intrinsic_fairing.face_set")
    yield 0.7
    press("LEFTMOUSE", *middle())
    yield from wait_until(_reported, 30.0)
    yield 1.0
    assert report().written, report().reason
    assert np.abs(_now() - before).max() > 1e-2
    screenshot(f"face_set_after_{name}")
    yield from _undo()

    def back() -> bool:
        return np.array_equal(_now(), before)

    yield from wait_until(back, 10.0)  # one step; a slow window takes its time
    assert report().undone, "a run that was undone is shown as the last"


def brush_in_sculpt_mode() -> Story:
    """A dent is painted over: on release it is fair, one step back brings it again; a small radius says so."""
    spoilt_scenes.dented()
    _begin_sculpting()
    with in_view():
        bpy.ops.wm.tool_set_by_id(name="intrinsic_fairing.brush")
        bpy.context.workspace.tools.from_space_view3d_mode("SCULPT").operator_properties("mesh.fair_brush").radius = 110
    open_tab()
    yield 1.0
    screenshot("brush_before")
    before = _now()
    report().free_vertices = 0
    yield from drag_over([(-200, 40), (-120, 40), (-160, 80), (-160, 0), (-190, 60)], "brush_painting")
    yield from wait_until(_reported, 30.0)
    yield 1.0
    assert report().written, report().reason
    after = _now()
    assert np.abs(after - before).max() > 1e-2
    assert (after[:, 3] == before[:, 3]).all(), "the mask was changed"
    screenshot("brush_after")
    yield from _undo()

    def back() -> bool:
        return np.array_equal(_now(), before)

    yield from wait_until(back, 10.0)
    with in_view():
        bpy.ops.object.mode_set(mode="OBJECT")
