"""A short animation: Live while a bottle's neck is dragged."""

import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
import numpy as np
from PIL import Image

import demo_pictures as pictures
import lesson_sheets
import sheet
from lesson_play import Move, box_above, move

SIZE = 600  # pixels of each of two pictures beside each other
FRAMES = 20
PAUSE, HOLD = 90, 1200  # ms of a frame, of the first and the last one


def live(out: Path) -> Iterator[Path]:
    """The neck is dragged aside and back, and the shoulder follows."""
    sys.modules["bl_ext.user_default.intrinsic_fairing.live.live"].PATIENCE = 60.0  # no surface depends on it
    lesson = lesson_sheets.LESSONS["tutorial_bottle"]
    lesson_sheets.begun(lesson)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.fair_live_region()
    box_above()
    at = 0.0
    for k in range(FRAMES + 1):
        aim = 0.5 * np.sin(2.0 * np.pi * k / FRAMES)
        move(Move("X", aim - at))
        at = aim
        bpy.ops.object.mode_set(mode="OBJECT")
        yield frame(out / f"live_{k}.png", "Live: the neck (orange) is dragged", with_selection=True)
        bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.window_manager.fairing_live.on = False


def frame(path: Path, words: str, *, with_selection: bool) -> Path:
    """Clay beside stripes."""
    pictures.SIZE = SIZE
    mesh = bpy.context.object.data
    mesh.materials.clear()
    clay = lesson_sheets.clay(path.with_name(f"{path.stem}_clay.png"), with_selection)
    for obj in [obj for obj in bpy.context.scene.objects if obj.type == "CURVE"]:
        bpy.data.objects.remove(obj)
    stripes = path.with_name(f"{path.stem}_stripes.png")
    pictures.striped(stripes)
    sheet.sheet([[sheet.Tile([clay], [words]), sheet.Tile([stripes], [])]], path)
    return path


def write(name: str, out: Path) -> None:
    """One of MOVING, as an animated WebP."""
    frames = [Image.open(path).convert("RGB") for path in MOVING[name](out)]
    times = [HOLD, *[PAUSE] * (len(frames) - 2), HOLD]
    target = out / f"{name}.webp"
    frames[0].save(target, save_all=True, append_images=frames[1:], duration=times, loop=0, quality=92, method=6)


MOVING = {"live": live}
