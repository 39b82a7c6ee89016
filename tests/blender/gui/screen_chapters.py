"""What is drawn in the view: strokes that fair."""

import bpy

import scenes
from driver import Story, in_view, middle, press, screenshot
from panel import drag_over, report, wait_until

# Once around the middle.
AROUND = [(90, 0), (64, 64), (0, 90), (-64, 64), (-90, 0), (-64, -64), (0, -90), (64, -64), (90, -10)]


def _reported() -> bool:
    return bool(report().free_vertices)


def lasso_fairs() -> Story:
    """Drawn around and let go: fair, in one step of undo."""
    scenes.ear()
    with in_view():
        bpy.ops.view3d.view_selected()
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.wm.tool_set_by_id(name="intrinsic_fairing.lasso")
    yield 0.5
    before = scenes.positions()
    report().free_vertices = 0
    yield from drag_over(AROUND)
    yield from wait_until(_reported, 20.0)
    yield 1.0
    screenshot("stroke_lasso")
    assert abs(scenes.positions() - before).max() > 1e-4
    press("Z", *middle(), ctrl=True)
    yield 1.0
    assert (scenes.positions() == before).all(), "one step back is not where it began"
    with in_view():
        bpy.ops.wm.tool_set_by_id(name="builtin.select_box")


SCREENS = (lasso_fairs,)
