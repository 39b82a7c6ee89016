"""What holds inside a selection: creases, a pin with a radius, an open border; and the soft edge of Feather."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import bpy
import held_scenes
import numpy as np
import scenes
from driver import Story, in_view, middle, press, screenshot, tell
from panel import open_redo_panel, report, run_operator, set_options, wait_until
from verdict_chapters import framed, run_and_wait


def holds_sharp_edges() -> Story:
    """A hammered corner of a box: sharp edges as creases, and averaged."""
    crease = yield from _in_ways(
        "corner", held_scenes.box_corner, "pin_slope", ("CREASE", "AVERAGE"), pin_edges="SHARP"
    )
    sides = np.abs(np.abs(crease) - 1.0).min(axis=1)
    tell(f"corner: off the box by {sides.max():.1e}")
    assert sides.max() < 1e-4, "the sides of the box are not flat again"


def misses_sharp_edges() -> Story:
    """The same corner without pins: its marked edges are rounded off, the panel says so, and shows where."""
    yield from framed(held_scenes.box_corner)
    yield from run_and_wait()
    assert (report().verdict, report().written) == ("LOOK", True), report().reason
    assert report().reason.startswith("Edges marked sharp were rounded off"), report().reason
    tell(f"sharp edges: {report().reason}")
    yield 3.0  # panels glide to their places
    screenshot("eaten")
    run_operator("mesh.fair_spots")
    yield from wait_until(_selects_vertices, 20.0)
    yield 1.0
    screenshot("eaten_spots")


def _selects_vertices() -> bool:
    return bool(bpy.context.tool_settings.mesh_select_mode[0])


def runs_through_a_curve() -> Story:
    """A plain with a lifted seam: smooth through it, a crease along it."""
    yield from _in_ways("curve", held_scenes.lifted_curve, "pin_slope", ("SMOOTH", "CREASE"), pin_edges="SEAM")


def lifts_a_pin() -> Story:
    """A plain with its middle lifted: in a point, and over a radius."""
    yield from _in_ways("pin", held_scenes.lifted_pin, "pin_radius", (0.0, 0.1, 0.3), pin_group="Pin")


def fairs_an_open_border() -> Story:
    """A ball with a crumpled opening: its border held, and faired."""
    yield from _in_ways("border", held_scenes.porthole, "open_border", ("HELD", "FAIRED"))


def feathers() -> Story:
    """An ear removed; then the change fades out around it."""
    yield from _in_ways("feather", scenes.ear, "feather", (0.0, 0.15))


def _in_ways(name: str, scene: Callable[[], int], option: str, values: Any, **options: Any) -> Any:
    """Run with each value of an option, undone in between; each must give another mesh. Returns the first one's."""
    yield from framed(scene)
    screenshot(f"{name}_before")
    shapes = []
    for value in values:
        yield from run_and_wait(**options, **{option: value})
        shapes.append(scenes.positions())
        assert report().written, f"{option}={value}: {report().reason}"
        tell(f"{name} {option} {value}: {report().verdict} {report().reason} {report().warnings}")
        tell(f"    {report().free_vertices} vertices in {report().seconds:.2f} s")
        screenshot(f"{name}_{str(value).lower()}")
        if value != values[-1]:
            press("Z", *middle(), ctrl=True)
            yield 0.7
    for first, second in pairwise(shapes):
        assert np.abs(first - second).max() > 1e-4, f"{option} changes nothing"
    yield from open_redo_panel()
    screenshot(f"{name}_redo")
    set_options()
    return shapes[0]


def copies_fairly() -> Story:
    """A bottle that bends by a modifier: its fair copy follows from frame to frame."""
    held_scenes.bending_bottle()
    with in_view():
        bpy.ops.view3d.view_all()
    yield 1.0
    screenshot("copy_before")
    with in_view():
        assert bpy.ops.object.fair_copy("INVOKE_DEFAULT", True) == {"FINISHED"}
    yield 1.0
    screenshot("copy_made")
    shapes = []
    for frame in (1, 10, 20):
        bpy.context.scene.frame_set(frame)
        yield 1.0
        shapes.append(_shown())
        screenshot(f"copy_{frame}")
    assert np.abs(shapes[0] - shapes[1]).max() > 0.05, "the copy does not follow"
    assert np.abs(shapes[1] - shapes[2]).max() > 0.05, "the copy does not follow"
    bpy.context.scene.frame_set(1)
    press("Z", *middle(), ctrl=True)
    yield 1.0
    screenshot("copy_undone")
    assert [obj.name for obj in bpy.context.scene.objects] == ["Bottle"]
    assert bpy.context.scene.objects["Bottle"].visible_get(), "undo leaves the original hidden"


def _shown() -> np.ndarray:
    mesh = bpy.context.object.data
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat
