"""docs/tutorial.md in a window: each lesson's file is opened, and its steps are done as they are written."""

import sys
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).parents[3] / "scripts"))
sys.path.append(str(Path(__file__).parents[3] / "scripts" / "studio"))
sys.path.append(str(Path(__file__).parents[3] / "scripts" / "lessons"))
sys.path.append(str(Path(__file__).parents[1]))

import bpy

import demo_scenes
import lesson_page
import lesson_play
import lesson_scenes
from driver import OUT, Story, in_view, middle, press, screenshot, tell, view
from lesson_checks import CHECKS
from panel import open_tab, redo_with, report, run_with, wait_until

NAMES = "ZERO ONE TWO THREE FOUR FIVE SIX SEVEN EIGHT NINE PERIOD MINUS"
KEYS = dict(zip("0123456789.-", NAMES.split(), strict=True))


def tutorial_as_written() -> Story:
    """All eight lessons; each ends in object mode and does what it promises."""
    for lesson in lesson_page.lessons():
        yield from _opened(lesson.file)
        before = demo_scenes.positions(bpy.context.object.data)
        for action in lesson_play.actions(lesson.steps):
            yield from _done(action)
        screenshot(f"tutorial_{lesson.file}")
        with in_view():
            bpy.ops.object.mode_set(mode="OBJECT")
        CHECKS[lesson.file](before, demo_scenes.positions(bpy.context.object.data))
        bpy.context.window_manager.fairing_live.on = False
        tell(f"tutorial: {lesson.title}")


def _opened(name: str) -> Story:
    """Make the file of a lesson in this Blender, and open it."""
    path = str(OUT / f"{name}.blend")
    with in_view():
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        for obj in list(bpy.data.objects):
            bpy.data.objects.remove(obj)
        lesson_scenes.begin(name)
        bpy.ops.wm.save_as_mainfile(filepath=path, compress=True)
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False)
    yield 1.5
    open_tab()
    with in_view():
        bpy.ops.view3d.view_all()
    report().free_vertices = 0
    yield 1.0


def _done(action: Any) -> Story:
    if isinstance(action, lesson_play.Move):
        yield from _typed("G", action.axis, f"{action.by:g}")
    elif action == lesson_play.Key("B"):
        lesson_play.box_above()
    elif isinstance(action, lesson_play.Key):
        press(action.name.upper(), *middle())
        yield 1.0
    elif action.operator == "fair_fillet":  # it follows the mouse: the width is typed
        run_with(action.operator)
        yield 1.0
        yield from _typed("", "", f"{action.options['width']:g}")
    else:
        run_with(action.operator, **action.given)
        yield from _rested()
        if action.options:  # in the panel at the lower left
            yield from redo_with(**action.options)
            yield from _rested()


def _typed(key: str, axis: str, number: str) -> Story:
    """Keys, one after the other, and Enter."""
    for each in (*key, *axis):
        press(each, *middle())
        yield 0.4
    for sign in number:  # Blender's own number fields read the letter, not the key
        x, y = middle()
        view()[0].event_simulate(type=KEYS[sign], value="PRESS", unicode=sign, x=x, y=y)
        view()[0].event_simulate(type=KEYS[sign], value="RELEASE", x=x, y=y)
        yield 0.4
    press("RET", *middle())
    yield from _rested()


def _rested() -> Story:
    """Until nothing runs in the background."""
    yield 1.0

    def rests() -> bool:
        return not bpy.context.window_manager.fairing_progress.running

    yield from wait_until(rests, 60.0)
    yield 1.0
