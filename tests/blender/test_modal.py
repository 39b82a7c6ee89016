"""The operator in the background, event by event; the events come from here instead of a window."""

import threading
from types import SimpleNamespace
from typing import Any

import bpy
import pytest

import meshes
from extension import give_options, module, stand_in


def event(kind: str, value: str = "PRESS") -> Any:
    return SimpleNamespace(type=kind, value=value)


def started(obj: bpy.types.Object, faces: Any, go_on: threading.Event) -> Any:
    """Return an operator whose run has begun and waits for `go_on`; a stand-in with its methods."""
    import fairing

    job, options = module("run.job"), module("options.options").FairOptions()
    meshes.enter(obj, faces)
    job.memory.clear()
    tasks = job.read(bpy.context, options)

    def work(progress: Any) -> Any:
        while not go_on.wait(0.01):
            if not progress(0.0, ""):
                raise fairing.Cancelled
        return job.solve(tasks, options, progress)

    stand = stand_in(module("fair.operator").MESH_OT_fair_region)
    stand._asked = module("fair.finish").Request(tasks, options)
    stand._signs = module("run.background").Signs(bpy.context)
    stand._run = module("run.runner").Run(work)
    return stand


@pytest.fixture
def go_on() -> Any:
    gate = threading.Event()
    yield gate
    gate.set()
    module("run.background").stop_all()


def test_the_button_cancels_as_escape_does(go_on: threading.Event) -> None:
    obj, faces = meshes.domed_grid()
    before = meshes.in_edit_mode_once(obj, faces)
    assert not bpy.ops.mesh.fair_cancel.poll()
    operator = started(obj, faces, go_on)
    assert bpy.ops.mesh.fair_cancel() == {"FINISHED"}
    assert operator.modal(bpy.context, event("TIMER")) == {"CANCELLED"}
    assert operator.reported == [({"INFO"}, "Fairing was cancelled; nothing has changed")]
    assert not bpy.context.window_manager.fairing_progress.running
    assert not bpy.ops.mesh.fair_cancel.poll()
    go_on.set()
    assert operator._run.wait(10.0)
    meshes.leave()
    assert meshes.contents(obj) == before


def windowed(category: str) -> Any:
    """A context with a 3D view of 800 x 500 pixels above the status bar, its sidebar on the right."""
    sidebar = SimpleNamespace(type="UI", x=600, y=20, width=200, height=500, active_panel_category=category)
    main = SimpleNamespace(type="WINDOW", x=0, y=20, width=800, height=500)
    area = SimpleNamespace(type="VIEW_3D", x=0, y=20, width=800, height=500, regions=[main, sidebar])
    window = SimpleNamespace(screen=SimpleNamespace(areas=[area]))
    return SimpleNamespace(window=window, preferences=bpy.context.preferences)


@pytest.mark.parametrize(
    ("place", "category", "passes"),
    [
        ((700, 300), "Fairing", True),  # our tab
        ((700, 300), "Item", False),  # another one
        ((300, 300), "Fairing", False),  # the mesh
        ((300, 10), "Item", True),  # the status bar
    ],
)
def test_clicks_reach_the_buttons_that_cancel(place: Any, category: str, passes: bool) -> None:
    click = SimpleNamespace(type="LEFTMOUSE", value="PRESS", mouse_x=place[0], mouse_y=place[1])
    assert module("host.status").over_buttons(windowed(category), click) == passes


def test_masked_faces_go_to_the_background_too(go_on: threading.Event, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sculpt mode goes on meanwhile; what comes out is what a script gets, and nothing where the mesh has changed."""
    outside, background = module("fair.outside"), module("run.background")
    scripted, faces = meshes.domed_grid()
    obj, _ = meshes.domed_grid()
    for each in (scripted, obj):
        mask = each.data.attributes.new(".sculpt_mask", "FLOAT", "POINT")
        values = [0.0] * len(each.data.vertices)
        for face in faces.nonzero()[0]:
            for vertex in each.data.polygons[face].vertices:
                values[vertex] = 1.0
        mask.data.foreach_set("value", values)
    bpy.context.view_layer.objects.active = scripted
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", True, source="MASK") == {"FINISHED"}
    bpy.context.view_layer.objects.active = obj
    before, solve = meshes.positions(obj), outside.solve

    def slow(*arguments: Any) -> Any:
        assert go_on.wait(10.0)
        return solve(*arguments)

    def started_masked() -> Any:
        watching = lambda stand, context: setattr(stand, "_signs", background.Signs(context))  # noqa: E731
        stand = stand_in(module("fair.masked").MESH_OT_fair_masked, _start_watching=watching)
        give_options(stand)
        stand.source, stand.face_set, stand.group, stand.under_mouse = "MASK", 0, "", False
        stand.is_repeated = lambda _context: False
        assert stand.invoke(bpy.context, event("LEFTMOUSE")) == {"RUNNING_MODAL"}
        return stand

    monkeypatch.setattr(outside, "solve", slow)
    monkeypatch.setattr(background, "has_events", lambda _context: True)
    monkeypatch.setattr(background, "MOMENT", 0.01)
    bpy.ops.object.mode_set(mode="SCULPT")
    try:
        changed = started_masked()
        assert bpy.context.mode == "SCULPT"
        assert not bpy.ops.mesh.fair_masked.poll()
        go_on.set()
        assert changed._run.wait(10.0)
        bpy.ops.object.mode_set(mode="OBJECT")
        meshes.move(obj, before + 1.0)
        bpy.ops.object.mode_set(mode="SCULPT")
        assert changed.modal(bpy.context, event("TIMER")) == {"CANCELLED"}
        bpy.ops.object.mode_set(mode="OBJECT")
        meshes.move(obj, before)
        bpy.ops.object.mode_set(mode="SCULPT")
        go_on.clear()  # else it may end within the moment in which nothing is shown
        stand = started_masked()
        go_on.set()
        assert stand._run.wait(10.0)
        assert stand.modal(bpy.context, event("TIMER")) == {"FINISHED"}
        assert bpy.context.mode == "SCULPT"
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    assert meshes.positions(obj).tobytes() == meshes.positions(scripted).tobytes()


@pytest.mark.parametrize("quick", [True, False])
def test_few_vertices_go_to_the_background_when_they_take_long(
    quick: bool, go_on: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A selection without a fair surface keeps the engine busy however small it is."""
    job, operators = module("run.job"), module("fair.operator")
    background = module("run.background")
    scripted, faces = meshes.domed_grid()
    meshes.fair(scripted, faces)
    obj, _ = meshes.domed_grid()
    job.memory.clear()
    solve = job.solve
    ahead: list[bool] = []
    watched: list[Any] = []

    def slow(*arguments: Any, **rest: Any) -> Any:
        ahead.append(rest["ahead"])
        assert quick or go_on.wait(10.0)
        return solve(*arguments, **rest)

    def watching(stand: Any, context: Any) -> None:
        stand._signs = background.Signs(context)
        watched.append(stand)

    operator = give_options(stand_in(operators.MESH_OT_fair_region, _start_watching=watching))
    monkeypatch.setattr(job, "solve", slow)
    monkeypatch.setattr(background, "has_events", lambda _context: True)
    monkeypatch.setattr(background, "MOMENT", 10.0 if quick else 0.01)
    meshes.enter(obj, faces)
    status = operator.invoke(bpy.context, event("LEFTMOUSE"))
    if not quick:
        assert (status, watched) == ({"RUNNING_MODAL"}, [operator])
        assert operator.modal(bpy.context, event("TIMER")) == {"RUNNING_MODAL"}
        assert bpy.context.window_manager.fairing_progress.running
        go_on.set()
        assert operator._run.wait(10.0)
        status = operator.modal(bpy.context, event("TIMER"))
    assert status == {"FINISHED"}
    assert watched == ([] if quick else [operator])
    assert ahead == [False]
    meshes.leave()
    assert meshes.positions(obj).tobytes() == meshes.positions(scripted).tobytes()


def test_only_looking_around_passes_through(go_on: threading.Event) -> None:
    obj, faces = meshes.domed_grid()
    operator = started(obj, faces, go_on)
    for kind in ("MIDDLEMOUSE", "WHEELUPMOUSE", "NUMPAD_1"):
        assert operator.modal(bpy.context, event(kind)) == {"PASS_THROUGH"}
    for kind in ("G", "X", "LEFTMOUSE", "TAB", "Z"):
        assert operator.modal(bpy.context, event(kind)) == {"RUNNING_MODAL"}
    assert operator.modal(bpy.context, event("ESC", "RELEASE")) == {"RUNNING_MODAL"}
    operator.cancel(bpy.context)


def test_refusal_at_the_end_is_reported(go_on: threading.Event) -> None:
    obj, faces = meshes.domed_grid()
    operator = started(obj, faces, go_on)
    operator._run.cancel()

    def refused(_progress: Any) -> Any:
        raise module("run.job").Refused(obj.name, ValueError("no"))

    operator._run = module("run.runner").Run(refused)
    assert operator._run.wait(10.0)
    assert operator.modal(bpy.context, event("TIMER")) == {"CANCELLED"}
    assert operator.reported == [({"ERROR"}, f"{obj.name}: no")]
