"""*Live Region* while its first surface takes long: Blender goes on, and nothing changes before it is there."""

import threading
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module, stand_in
from test_live import drag, now, switch


class Gate:
    """The engine's first answer, which takes until it is let go, and whoever waits for it."""

    def __init__(self) -> None:
        self.go, self.threads, self.stands_in = threading.Event(), list[threading.Thread](), False


@pytest.fixture
def gate(monkeypatch: pytest.MonkeyPatch) -> Iterator[Gate]:
    kind, found = module("live.region").LiveRegion, Gate()
    real = kind.answer

    def slow(region: Any, *rest: Any) -> Any:
        found.threads.append(threading.current_thread())
        assert found.go.wait(10.0)
        return None if found.stands_in else real(region, *rest)

    monkeypatch.setattr(kind, "answer", slow)
    monkeypatch.setattr(module("run.background"), "MOMENT", 0.01)
    monkeypatch.setattr(module("run.background"), "has_events", lambda _context: True)
    yield found
    found.go.set()
    switch(False)
    module("run.runner").stop_all()


def clicked() -> Any:
    """A stand-in for the operator with its methods, called as a click would."""
    watching = lambda stand, context: setattr(stand, "_signs", module("run.background").Signs(context))  # noqa: E731
    return stand_in(module("live.start").MESH_OT_fair_live_region, _start_watching=watching)


def mountain() -> bpy.types.Object:
    """A bumpy grid in edit mode with its middle selected."""
    obj = meshes.bumpy_grid()
    meshes.enter(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.6))
    return obj


def dented_ball() -> bpy.types.Object:
    """A ball with a texture, its upper half flattened and selected, in edit mode: its faces slide where they spread."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    obj = bpy.context.object
    assert obj.data.uv_layers
    points = meshes.positions(obj)
    points[points[:, 2] > 0.3, 2] *= 0.6
    meshes.move(obj, points)
    meshes.enter(obj, meshes.faces_where(obj, lambda centre: centre.z > 0.05))
    return obj


def step(act: Any) -> Any:
    """Undo or redo, and let Live look; returns where all vertices are then."""
    act()
    bpy.context.view_layer.update()
    module("live.live")._complete_later()  # the timer's function
    return now(bpy.context.object.name)


def begun() -> tuple[Any, Any]:
    """Click, and have the answer take its time; returns the operator and where all vertices are."""
    mountain()
    before = now()
    operator = clicked()
    assert operator.invoke(bpy.context, SimpleNamespace(type="LEFTMOUSE", value="PRESS")) == {"RUNNING_MODAL"}
    return operator, before


def tick(operator: Any, kind: str = "TIMER") -> set[str]:
    """Give the operator an event."""
    status: set[str] = operator.modal(bpy.context, SimpleNamespace(type=kind, value="PRESS"))
    return status


def nothing_has_changed(before: Any) -> bool:
    return (
        np.array_equal(now(), before)
        and not module("mesh.live_mesh").has_region(bpy.context.object.data)
        and not bpy.context.window_manager.fairing_live.on
    )


def test_blender_goes_on_until_the_surface_is_there(gate: Gate) -> None:
    operator, before = begun()
    for _ in range(3):
        assert tick(operator) == {"RUNNING_MODAL"}
        assert bpy.context.window_manager.fairing_progress.running
        assert not bpy.ops.mesh.fair_live_region.poll()
        assert nothing_has_changed(before)
    assert gate.threads
    assert threading.main_thread() not in gate.threads
    gate.go.set()
    assert operator._run.wait(10.0)
    assert tick(operator) == {"FINISHED"}
    live = module("live.live").live
    assert (live.message, live.stands_in(), live.updates) == ("", False, 0)
    assert np.abs(now() - before).max() > 1e-3
    assert bpy.context.window_manager.fairing_live.on
    assert not bpy.context.window_manager.fairing_progress.running
    in_window = now()
    meshes.leave()
    bpy.ops.wm.read_homefile(use_empty=True)
    mountain()
    assert bpy.ops.mesh.fair_live_region("EXEC_DEFAULT") == {"FINISHED"}  # as scripts do it: at once
    assert np.array_equal(now(), in_window)


def test_escape_leaves_all_as_it_was(gate: Gate) -> None:
    operator, before = begun()
    assert tick(operator, "ESC") == {"CANCELLED"}
    gate.go.set()
    assert operator._run.wait(10.0)
    assert nothing_has_changed(before)


@pytest.mark.parametrize("change", ["moved", "other faces", "object scaled", "left"])
def test_a_mesh_that_changed_meanwhile_is_left_alone(gate: Gate, change: str) -> None:
    operator, _ = begun()
    if change == "moved":
        bpy.ops.transform.translate(value=(0.0, 0.0, 0.5))
    elif change == "other faces":
        bpy.ops.mesh.delete(type="FACE")
    elif change == "object scaled":
        bpy.context.object.scale = (1.0, 1.0, 2.0)
    else:
        meshes.leave()
    bpy.context.view_layer.update()
    gate.go.set()
    assert operator._run.wait(10.0)
    after = None if change == "left" else now()
    assert tick(operator) == {"CANCELLED"}
    assert "changed meanwhile" in operator.reported[-1][1]
    if after is not None:
        assert nothing_has_changed(after)


def test_the_even_surface_stands_in_and_says_so(gate: Gate) -> None:
    operator, before = begun()
    gate.stands_in = True
    gate.go.set()
    assert operator._run.wait(30.0)
    assert tick(operator) == {"FINISHED"}
    assert module("live.live").live.message == module("live.live").STAND_IN
    assert np.abs(now() - before).max() > 1e-3


def test_without_a_surface_nothing_changes(gate: Gate, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module("live.region").LiveRegion, "stand_in", lambda *_: None)
    operator, before = begun()
    gate.stands_in = True
    gate.go.set()
    assert operator._run.wait(10.0)
    assert tick(operator) == {"CANCELLED"}
    assert operator.reported == [({"ERROR"}, "Grid: No fair surface was found for the region")]
    assert nothing_has_changed(before)


@pytest.fixture
def live(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    found = module("live.live")
    monkeypatch.setattr(found, "PATIENCE", 60.0)
    yield found.live
    switch(False)


def test_a_redo_brings_the_region_back_to_the_bit(live: Any) -> None:
    """The texture keeps the spacing from before the region was fair, which the redone mesh has no more."""
    name = dented_ball().name
    bpy.ops.ed.undo_push(message="start")
    before = now(name)
    bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True)
    fair = now(name)
    assert np.abs(fair - before).max() > 0.1
    for _ in range(2):
        assert np.array_equal(step(bpy.ops.ed.undo), before)
        assert np.array_equal(step(bpy.ops.ed.redo), fair)
    assert (live.updates, live.message) == (0, "")
    drag(np.flatnonzero(fair[:, 2] < -0.9), (0.0, 0.0, 0.05), name)  # and it is followed again
    assert live.updates == 0, "what lies far away doesn't count"
    drag(np.flatnonzero(np.abs(fair[:, 2]) < 0.1), (0.0, 0.0, 0.05), name)
    assert live.updates == 1


def test_an_undo_goes_back_to_the_region_before(live: Any) -> None:
    """Each has its own spacing: the second region was taken when the first was fair."""
    name = dented_ball().name
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True)
    first = now(name)
    bpy.ops.mesh.select_less()
    bpy.ops.ed.undo_push(message="selection")
    bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True)
    second, count = now(name), live.updates
    faces = len(live.sessions[bpy.data.objects[name].data.name].faces)
    for _ in range(2):
        assert np.array_equal(step(bpy.ops.ed.undo), first)
        drag([0], (0.0, 0.0, 0.0), name)
        assert len(live.sessions[bpy.data.objects[name].data.name].faces) > faces
        assert np.array_equal(step(bpy.ops.ed.redo), second)
    assert live.updates == count


def test_a_session_put_aside_is_not_taken_for_another(live: Any) -> None:
    """The same faces with other options are another region."""
    name = dented_ball().name
    bpy.ops.ed.undo_push(message="start")
    bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True)
    mesh, home = bpy.data.objects[name].data, module("live.session")
    session = live.sessions[mesh.name]
    assert home.is_of(session, mesh)
    kept = mesh["fair_live_options"]
    mesh["fair_live_options"] = kept.replace('"shape": "AUTOMATIC"', '"shape": "MINIMAL_ENERGY"')
    assert not home.is_of(session, mesh)
    mesh["fair_live_options"] = kept
    mesh["fair_live_key"] = "Smile"
    assert not home.is_of(session, mesh)
