"""Milliseconds from an edit beside a live region to the redrawn window, with Live and without, as Markdown.

Runs inside a Blender with a window, as `benchmarks/blender/run window` starts it. The lower half of a sphere of quads
is stretched by Blender's own operator, a hundredth a step, and the window is drawn: by the wall, medians.
Without a graphics card the drawing is software, so that the columns are Live's own share and Blender's.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "blender"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "blender" / "gui"))

import bpy
import numpy as np

import meshes
import scenes
from driver import Story, in_view, middle, play, press, tell
from panel import extension, module

FREE = (2000, 10_000, 50_000)  # free vertices, about
STEPS = 20
STEP = 0.01


def milliseconds(sign: float) -> tuple[float, float]:
    """Stretch what is selected by a step; return milliseconds: the edit with Live's answer, and the drawing."""
    with in_view():
        begin = time.perf_counter()
        bpy.ops.transform.resize(value=((1.0 + STEP) ** sign, 1.0, 1.0))
        bpy.context.view_layer.update()
        edited = time.perf_counter()
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
        return 1e3 * (edited - begin), 1e3 * (time.perf_counter() - edited)


def median() -> tuple[float, float]:
    """Return the medians of both over steps to and fro, without the first ones."""
    steps = [milliseconds(1.0 if step % 10 < 5 else -1.0) for step in range(STEPS + 3)]
    edit, drawing = np.median(steps[3:], axis=0).tolist()
    return edit, drawing


def row(free_vertices: int) -> Story:
    """One line of the table."""
    obj = meshes.sphere(8 * round(np.sqrt(free_vertices / 3.0) / 2.0))
    meshes.select(obj, meshes.faces_where(obj, lambda centre: centre.z > 1e-6))
    lower = meshes.positions(obj)[:, 2] < 1e-6
    meshes.edit(obj)
    yield 0.5
    with in_view():
        assert bpy.ops.mesh.fair_live_region() == {"FINISHED"}
        yield 0.5
    window = bpy.context.window_manager
    live = module("live.live").live
    free = len(next(iter(live.sessions.values())).region.free)
    scenes.select_vertices(lower)
    yield 0.5
    found = {}
    for on in (False, True):
        window.fairing_live.on = on
        yield 0.5
        written = live.updates
        found[on] = median()
        assert live.updates - written == (STEPS + 3 if on else 0)
    window.fairing_live.on = False
    (plain, drawn), (edit, redrawn) = found[False], found[True]
    tell(f"| {free} | {edit - plain:.1f} | {plain:.1f} | {drawn:.1f} | {redrawn:.1f} | {edit + redrawn:.1f} |")
    meshes.leave()
    bpy.data.objects.remove(obj)
    bpy.context.view_layer.update()


def pages() -> Story:
    """The table."""
    extension()
    yield 1.0
    press("ESC", *middle())  # the splash screen of a first start
    yield 0.5
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.context.view_layer.update()
    tell("| free vertices | Live's share | Blender's edit | drawing without Live | with Live | in all, ms |")
    tell("| --: " * 6 + "|")
    for free in FREE:
        yield from row(free)


play(pages)
