"""Runs that something else ends: another file, undo, the end of the object, of the extension, of Blender."""

import threading
from pathlib import Path
from typing import Any

import bpy
import pytest

import meshes
import own_process
from extension import module
from test_modal import event, go_on, started

__all__ = ["go_on"]  # a fixture


def kept() -> dict[str, bool]:
    """Tell what is kept of the last run."""
    return {
        **{kind: len(values) > 0 for kind, values in module("run.job").memory._values.items()},
        "pairs": module("run.compare").is_available(),
        "regions": module("run.last_run").has_regions(),
        "report": bool(meshes.report().free_vertices),
    }


def test_nothing_of_a_file_is_kept_in_the_next_one(tmp_path: Path) -> None:
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces)
    meshes.edit(obj)
    assert all(kept().values())
    assert bpy.ops.mesh.fair_compare.poll()
    assert bpy.ops.mesh.fair_again.poll()
    same = str(tmp_path / "same.blend")
    bpy.ops.wm.save_as_mainfile(filepath=same)
    assert all(kept().values())  # saved under another name, it is the same file
    bpy.ops.wm.open_mainfile(filepath=same)
    assert bpy.context.mode == "EDIT_MESH"
    assert not any(kept().values()), kept()
    assert not bpy.ops.mesh.fair_compare.poll()
    assert not bpy.ops.mesh.fair_again.poll()


def test_a_run_ends_with_its_file(go_on: threading.Event, tmp_path: Path) -> None:
    """The next file is the same one: its object has the name and the mesh that the run has read."""
    obj, faces = meshes.domed_grid()
    operator = started(obj, faces, go_on)
    same = str(tmp_path / "same.blend")
    bpy.ops.wm.save_as_mainfile(filepath=same)
    bpy.ops.wm.open_mainfile(filepath=same)
    ended_before = operator._run.finished
    go_on.set()
    assert operator._run.wait(10.0)
    assert bpy.context.mode == "EDIT_MESH"
    before = meshes.contents(bpy.context.object)
    assert operator.modal(bpy.context, event("TIMER")) == {"CANCELLED"}
    assert ended_before
    assert not operator.reported
    assert not bpy.context.window_manager.fairing_progress.running
    assert meshes.contents(bpy.context.object) == before


@pytest.mark.parametrize("how", ["undone", "removed", "replaced"])
@pytest.mark.parametrize("refused", [False, True], ids=["solved", "refused"])
def test_a_run_whose_mesh_is_gone_writes_nothing(how: str, refused: bool, go_on: threading.Event) -> None:
    obj, faces = meshes.domed_grid()
    name = obj.name
    bpy.ops.ed.undo_push(message="first")
    meshes.enter(obj, faces)
    bpy.ops.ed.undo_push(message="edit mode")
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.5))
    bpy.ops.ed.undo_push(message="moved")
    meshes.leave()
    operator = started(bpy.context.object, faces, go_on)
    if refused:
        operator._run.cancel()
        operator._run = module("run.runner").Run(refusal_about(name))
    if how == "undone":
        bpy.ops.ed.undo()
        bpy.ops.ed.undo()
    else:
        bpy.data.objects.remove(bpy.data.objects[name])
        bpy.context.view_layer.update()
        if how == "replaced":
            other = meshes.grid(4)
            other.name = name
            meshes.edit(other)
    go_on.set()
    assert operator._run.wait(10.0)
    there = bpy.data.objects.get(name)
    before = there and meshes.contents(there)
    assert operator.modal(bpy.context, event("TIMER")) == {"CANCELLED"}
    assert [("changed meanwhile" in text) for _, text in operator.reported] == [True]
    assert there is None or meshes.contents(there) == before


def refusal_about(name: str) -> Any:
    """Return work that is refused because of a vertex."""
    cause: Any = ValueError("no good")
    cause.elements = [70]

    def work(_progress: Any) -> Any:
        raise module("run.job").Refused(name, cause)

    return work


UNDER_WAY = """
import sys
import threading
import time
from functools import partial

import addon_utils
import fairing
import meshes

ID = "bl_ext.user_default.intrinsic_fairing"

def part(name):
    return sys.modules[f"{ID}.{name}"]

def threads():
    return [thread for thread in threading.enumerate() if thread.name == "fairing"]

def scene():
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    obj = meshes.grid(40)
    points = meshes.positions(obj)
    points[:, 2] = 0.2 * points[:, 0] ** 2
    meshes.move(obj, points)
    meshes.enter(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.7))

def endless(solve, progress):  # in the engine nearly all the time
    while True:
        solve(progress)

def begin_run():
    scene()
    background, job, options = part("run.background"), part("run.job"), part("options.options").FairOptions()
    tasks = job.read(bpy.context, options)

    def solve(progress):
        job.memory.clear()
        job.solve(tasks, options, progress)

    background.Signs(bpy.context)
    return part("run.runner").Run(partial(endless, solve))

def begin_search():
    search = part("live.live")
    search.sought = lambda region, points, matrix, progress: endless(partial(region.afresh, points, matrix), progress)
    scene()
    home = part("live.live")
    home.PATIENCE, home.moment = 0.15, lambda: 0.0
    assert bpy.ops.mesh.fair_live_region() == {"FINISHED"}
    home.PATIENCE = -1.0  # nothing is found at once
    bpy.context.object.scale.z = 2.0
    bpy.context.view_layer.update()
    assert home.complete_all()
    return home.live.sessions["Grid"].search

def begun():
    run = begin()
    while run.fraction == 0.0:
        time.sleep(0.001)
    assert len(threads()) == 1
    return run

def ended_by(act):
    run = begun()
    act()
    assert threads() == []
    assert isinstance(run._error, fairing.Cancelled)
    print("ended by", act.__name__)

def another_file():
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not bpy.context.window_manager.fairing_progress.running

def disabling():
    addon_utils.disable(ID)
"""
STORY = """
ended_by(another_file)
ended_by(disabling)
addon_utils.enable(ID)
scene()
assert bpy.ops.mesh.fair_region() == {{"FINISHED"}}
run = begun()
time.sleep(0.1)
{last}
assert len(threads()) == 1
"""
LAST = {"goes on": "", "is cancelled": "run.cancel()"}


@pytest.mark.parametrize("last", LAST)
@pytest.mark.parametrize("kind", ["run", "search"])
def test_blender_ends_well(kind: str, last: str, tmp_path: Path) -> None:
    """Before that a file is opened, and the extension disabled and enabled: no thread outlives either."""
    story = STORY.format(last=LAST[last])
    ended = own_process.run(f"{UNDER_WAY}\nbegin = begin_{kind}\n{story}", tmp_path)
    assert "Error" not in ended.stderr
    assert ended.stdout.count("ended by") == 2
