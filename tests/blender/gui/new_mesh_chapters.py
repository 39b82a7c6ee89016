"""New faces: *Mesh: New* and *Fair Fill*, made finer in the redo panel."""

from __future__ import annotations

import bpy
import scenes
import spoilt_scenes
from driver import Story, click, in_view, middle, press, screenshot, tell, type_text
from panel import open_redo_panel, open_tab, redo_panel, report, run_operator, wait_until
from verdict_chapters import framed, run_and_wait

NEW_SPACING = 186  # pixels from the redo panel's upper edge down to the field Spacing of Fair Region
FILL_SPACING = 112  # and of Fair Fill


def gets_a_new_mesh() -> Story:
    """An ear removed on new triangles, then on finer ones; the result stands where the selection was."""
    yield from framed(scenes.ear)
    faces = spoilt_scenes.face_count()
    yield from run_and_wait(mesh="NEW")
    screenshot("new_mesh")
    coarse = spoilt_scenes.face_count()
    tell(f"new mesh: {faces} → {coarse} faces, {report().verdict} {report().reason}")
    assert coarse != faces
    yield from _finer("new_mesh", NEW_SPACING)
    tell(f"twice as fine: {spoilt_scenes.face_count()} faces, {report().verdict}")
    assert spoilt_scenes.face_count() > coarse + 500
    press("Z", *middle(), ctrl=True)
    yield 1.0
    assert spoilt_scenes.face_count() == faces
    screenshot("new_mesh_undone")


def fills_finer() -> Story:
    """A hole is filled; the redo panel makes the new faces half as large."""
    spoilt_scenes.hole()
    with in_view():
        bpy.ops.view3d.view_all()
    open_tab()
    yield 0.7
    before = spoilt_scenes.face_count()
    run_operator("mesh.fair_fill")
    yield from wait_until(lambda: spoilt_scenes.face_count() > before, 20.0)  # in the background on a busy machine
    yield 1.0
    coarse = spoilt_scenes.face_count() - before
    yield from _finer("fill_finer", FILL_SPACING)
    fine = spoilt_scenes.face_count() - before
    tell(f"fill: {coarse} new faces, with half the spacing {fine}")
    assert fine > 2 * coarse
    press("Z", *middle(), ctrl=True)
    yield 1.0
    assert spoilt_scenes.face_count() == before


def _finer(name: str, down: int) -> Story:
    """Type 0.5 into the redo panel's field so many pixels below its upper edge."""
    yield from open_redo_panel()
    screenshot(f"{name}_redo")
    hud = redo_panel()
    x, y = hud.x + int(0.7 * hud.width), hud.y + hud.height - down
    for _ in range(2):  # a double click edits the number
        yield from click(x, y)
    yield 0.3
    press("A", x, y, ctrl=True)
    type_text("0.5", x, y)
    yield 0.3
    screenshot(f"{name}_typing")
    press("RET", x, y)
    yield 2.5
    screenshot(f"{name}_finer")
