"""Who may write: Live rests while a run, its preview or an awaited answer has the meshes, and follows afterwards."""

import threading
from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from changes import Kind, Panel
from extension import module
from test_live import live, now, switch  # noqa: F401 - a fixture
from test_modal import event, go_on, started  # noqa: F401 - likewise


def beside_live() -> Any:
    """Edit a bumpy grid whose live region touches the faces that are selected; return object and mask."""
    obj = meshes.bumpy_grid()
    meshes.enter(obj, meshes.faces_where(obj, lambda c: -0.6 < c.x < 0.2 and abs(c.y) < 0.6))
    assert bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True) == {"FINISHED"}
    meshes.leave()
    faces = meshes.faces_where(obj, lambda c: 0.2 < c.x < 0.8 and abs(c.y) < 0.6)
    meshes.enter(obj, faces)
    bpy.context.view_layer.update()
    return obj, faces


@pytest.mark.parametrize("end", ["the run", "ESC", "stop_all"])
def test_live_leaves_a_run_and_its_preview_alone(end: str, live: Any, go_on: threading.Event) -> None:  # noqa: F811
    obj, faces = beside_live()
    operator = started(obj, faces, go_on)
    tasks, job = operator._asked.tasks, module("run.job")
    operator._signs.preview = preview = module("run.preview").Preview(tasks)
    (wanted,) = job.solve(tasks, operator._asked.options, lambda *_: True, give=preview.give)
    before, count = now(), live.updates
    assert operator.modal(bpy.context, event("TIMER")) == {"RUNNING_MODAL"}
    assert (now() != before).any()
    bpy.context.view_layer.update()
    assert live.updates == count
    go_on.set()
    assert operator._run.wait(10.0)
    if end == "stop_all":
        module("run.background").stop_all()
    else:
        kind, status = ("ESC", {"CANCELLED"}) if end == "ESC" else ("TIMER", {"FINISHED"})
        assert operator.modal(bpy.context, event(kind)) == status
    if end != "the run":
        np.testing.assert_array_equal(now(), before)
    else:
        np.testing.assert_array_equal(now()[wanted.vertices], wanted.positions.astype(np.float32))
    assert live.rested
    module("live.live")._complete_later()  # the timer's function
    assert live.updates == count + (end == "the run")
    assert not live.rested


def _enter() -> None:
    beside_live()


@pytest.fixture
def panel(monkeypatch: pytest.MonkeyPatch) -> Iterator[Panel]:
    made = Panel(monkeypatch, Kind(enter=_enter))
    yield made
    made.end()
    switch(False)


def test_live_leaves_a_change_in_the_redo_panel_alone(live: Any, panel: Panel) -> None:  # noqa: F811
    panel.leave_panel(shape="MINIMAL_ENERGY")
    assert panel.follows
    shown, count = panel.now, live.updates
    bpy.context.view_layer.update()
    assert (panel.now, live.updates) == (shown, count)
    panel.is_open = True
    panel.complete()
    assert panel.report.written
    assert "kept" not in panel.report.reason
    assert "not taken" not in panel.report.reason.lower()
    assert panel.now != shown
    assert live.updates == count
    module("live.live")._complete_later()
    assert live.updates == count + 1
