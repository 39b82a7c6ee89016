"""Live: the region follows what is moved around it, and one undo takes both back.

A background process updates the scene by view_layer.update(), which calls the same handlers as the window does.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module


@pytest.fixture
def live(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    found = module("live.live")
    monkeypatch.setattr(found, "PATIENCE", 60.0)  # a machine with other work is slow; no surface depends on that
    yield found.live
    bpy.context.window_manager.fairing_live.on = False
    assert not found.live.on


def switch(on: bool) -> None:
    bpy.context.window_manager.fairing_live.on = on


def table_mountain(size: int = 16) -> tuple[bpy.types.Object, Any]:
    """Add a bumpy grid in edit mode with its middle as the live region."""
    obj = meshes.bumpy_grid(size)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.6)
    meshes.enter(obj, faces)
    bpy.ops.ed.undo_push(message="start")
    assert bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True) == {"FINISHED"}
    return bpy.data.objects[obj.name], faces


def now(name: str = "Grid") -> Any:
    """(n, 3) positions of a mesh in edit mode, straight from its bmesh."""
    bm = bmesh.from_edit_mesh(bpy.data.objects[name].data)
    return np.array([vertex.co[:] for vertex in bm.verts])


def drag(vertices: Any, step: tuple[float, float, float], name: str = "Grid") -> None:
    """Move some vertices as a tool does, and let Blender update the scene."""
    mesh = bpy.data.objects[name].data
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    for vertex in vertices:
        bm.verts[vertex].co += bm.verts[vertex].co.__class__(step)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    bpy.context.view_layer.update()


def flank(points: Any) -> Any:
    """Vertices beside the region: on its boundary and outside, on one side."""
    return np.flatnonzero((points[:, 0] > 0.6) & (np.abs(points[:, 1]) < 0.4))


def assert_fair(faces: Any, name: str = "Grid") -> None:
    """The operator would change nothing but the last digits: of its tolerance, and of float32."""
    before = now(name)
    obj = bpy.data.objects[name]
    meshes.leave()
    meshes.enter(obj, faces)
    switch(False)
    meshes.run()
    np.testing.assert_allclose(now(name), before, atol=2e-5)
    switch(True)


def test_region_follows_every_change(live: Any) -> None:
    _, faces = table_mountain()
    points = now()
    for _ in range(3):
        before = now()
        drag(flank(points), (0.0, 0.0, 0.03))  # without hard edges beside it
        moved = np.abs(now() - before).max(axis=1) > 1e-4
        assert moved.sum() > len(flank(points)) + 20  # the region came along
    assert live.updates == 3
    assert live.message == ""
    assert_fair(faces)


def test_one_undo_takes_edit_and_fairing_back(live: Any) -> None:
    table_mountain()
    start = now()
    drag(flank(start), (0.0, 0.0, 0.05))
    bpy.ops.ed.undo_push(message="drag")
    first = now()
    drag(flank(start), (0.0, 0.0, 0.05))
    bpy.ops.ed.undo_push(message="drag again")
    for expected in (first, start):
        bpy.ops.ed.undo()
        bpy.context.view_layer.update()
        np.testing.assert_allclose(now(), expected, atol=2e-6)
    bpy.ops.ed.redo()
    bpy.context.view_layer.update()
    np.testing.assert_allclose(now(), first, atol=2e-6)


def test_undo_step_made_before_the_fairing(live: Any) -> None:
    """A tool that is done at once pushes its step before the scene is updated: the step back is fair all the same."""
    table_mountain()
    start = now()
    mesh = bpy.data.objects["Grid"].data
    for _ in range(2):
        bm = bmesh.from_edit_mesh(mesh)
        bm.verts.ensure_lookup_table()
        for vertex in flank(start):
            bm.verts[vertex].co.z += 0.05
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        bpy.ops.ed.undo_push(message="tool")
        bpy.context.view_layer.update()
        if _ == 0:
            first = now()
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    np.testing.assert_allclose(now(), first, atol=2e-5)


def test_off_is_off(live: Any) -> None:
    _, faces = table_mountain()
    before = now()
    switch(False)
    drag(flank(before), (0.0, 0.0, 0.05))
    changed = np.flatnonzero(np.abs(now() - before).max(axis=1) > 0.0)
    assert set(changed) == set(flank(before))
    switch(True)  # and back on: what was missed is made good
    assert_fair(faces)


def test_region_is_saved_with_the_mesh(live: Any, tmp_path: Path) -> None:
    _, faces = table_mountain()
    points = now()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "live.blend"))
    switch(False)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "live.blend"))
    obj = bpy.data.objects["Grid"]
    if obj.mode != "EDIT":
        meshes.edit(obj)
    switch(True)
    drag(flank(points), (0.0, 0.0, 0.05))
    assert live.updates >= 1
    assert_fair(faces)


def test_a_file_that_is_opened_keeps_its_positions(live: Any, tmp_path: Path) -> None:
    """Its region is not fair, and Live was on in the last file."""
    table_mountain()
    switch(False)
    drag(flank(now()), (0.0, 0.0, 0.03))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "live.blend"))
    before = now()
    switch(True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "live.blend"))
    assert not bpy.context.window_manager.fairing_live.on
    if bpy.data.objects["Grid"].mode != "EDIT":
        meshes.edit(bpy.data.objects["Grid"])
    bpy.context.view_layer.update()
    assert np.array_equal(now(), before)


def test_options_are_those_of_the_last_run(live: Any) -> None:
    obj = meshes.grid(12)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.6)
    meshes.enter(obj, faces)
    options = module("options.options").FairOptions(bulge=0.4)
    session = module("live.session").candidate(obj, options)
    first = module("live.region").sought(session.region, session.positions, session.matrix, lambda *_: True)
    live.take(obj, session, options, first)
    switch(True)
    height = now()[:, 2].max()
    assert height > 0.02
    boundary = np.flatnonzero(now()[:, 0] > 0.55)
    drag(boundary, (0.0, 0.0, 0.001))
    # Hardly moved: the bulge is as high as before, which a harmonic surface would not be.
    assert now()[:, 2].max() == pytest.approx(height, rel=0.05)
    before = now()
    switch(False)
    meshes.run(bulge=0.4)
    np.testing.assert_allclose(now(), before, atol=2e-5)


def test_new_connectivity_is_read_anew(live: Any) -> None:
    table_mountain()
    mesh = bpy.data.objects["Grid"].data
    bm = bmesh.from_edit_mesh(mesh)
    bm.faces.ensure_lookup_table()
    layer = bm.faces.layers.int[module("mesh.live_mesh").LAYER]
    inside = [face for face in bm.faces if face[layer]]
    bmesh.ops.poke(bm, faces=[inside[len(inside) // 2]])
    bmesh.update_edit_mesh(mesh)
    bpy.context.view_layer.update()
    count = live.updates
    drag(flank(now()), (0.0, 0.0, 0.05))
    assert live.updates == count + 1
    assert live.message == ""


def test_a_spoilt_boundary_is_reported_and_leaves_the_mesh(live: Any) -> None:
    table_mountain()
    before = now()
    beside = flank(before)
    drag(beside, (float("nan"), 0.0, 0.0))
    assert "invalid coordinate" in live.message
    others = np.setdiff1d(np.arange(len(before)), beside)
    assert np.array_equal(now()[others], before[others])


def test_a_slow_answer_is_stood_in_for_until_the_end_of_the_drag(live: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Out of patience at once: a smooth surface follows its boundary, and the answer comes when all is quiet."""
    home = module("live.live")
    monkeypatch.setattr(home, "PATIENCE", -1.0)
    _, faces = table_mountain()
    before = now()
    everything = np.arange(len(before))
    drag(everything, (0.0, 0.0, 0.05))
    drag(flank(before), (0.0, 0.0, 0.05))
    shown = now()
    assert live.stands_in()
    assert live.message == ""
    wait = home._complete_later()
    assert 0.0 < wait <= home.PAUSE  # the drag may still go on
    live.changed_at -= home.PAUSE
    assert home._complete_later() is None
    assert not live.stands_in()
    assert live.message == ""
    assert 0.0 < np.abs(now() - shown).max() < 0.03  # carried along, it would be .05 off
    monkeypatch.setattr(home, "PATIENCE", 60.0)
    assert_fair(faces)


def with_keys() -> tuple[bpy.types.Object, Any]:
    """Add a bumpy grid in edit mode with a live region in its Basis, and another key of the very same shape."""
    obj = meshes.bumpy_grid()
    for name in ("Basis", "Smile"):
        obj.shape_key_add(name=name, from_mix=False)
    obj.active_shape_key_index = 0
    meshes.enter(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.6))
    smile, points = obj.data.shape_keys.key_blocks["Smile"], now()
    points[:, 2] += 0.2 * np.cos(5.0 * points[:, 0])
    smile.data.foreach_set("co", points.astype(np.float32).ravel())
    assert bpy.ops.mesh.fair_live_region("EXEC_DEFAULT", True) == {"FINISHED"}
    return obj, smile


@pytest.mark.parametrize("locked", [False, True])
def test_another_shape_key_is_never_written(live: Any, locked: bool) -> None:
    obj, smile = with_keys()
    smile.lock_shape = locked
    basis = now()
    obj.active_shape_key_index = 1
    shown = now()
    bpy.context.view_layer.update()
    drag([], (0.0, 0.0, 0.0))
    assert np.array_equal(now(), shown)
    assert ("Unlock" if locked else "belongs to the Basis") in live.message
    assert live.sessions == {}
    drag(flank(shown), (0.0, 0.0, 0.05))
    assert set(np.flatnonzero(np.abs(now() - shown).max(axis=1))) == set(flank(shown))
    obj.active_shape_key_index = 0  # and back: it goes on
    np.testing.assert_allclose(now(), basis, atol=1e-6)
    drag(flank(basis), (0.0, 0.0, 0.05))
    assert live.message == ""
    assert np.abs(now() - basis).max(axis=1)[middle_of(basis)].max() > 1e-3


def middle_of(points: Any) -> Any:
    """The grid's vertices well inside the region."""
    return np.abs(points[:, :2]).max(axis=1) < 0.4


def test_what_cannot_be_live_is_refused() -> None:
    obj = meshes.grid(6)
    meshes.enter(obj, meshes.faces_where(obj, lambda c: False))
    with pytest.raises(RuntimeError, match="No face is selected"):
        bpy.ops.mesh.fair_live_region()
    session, options = module("live.session"), module("options.options")
    meshes.leave()
    meshes.enter(obj, meshes.faces_where(obj, lambda c: abs(c.x) < 0.7 and abs(c.y) < 0.7))
    before = now()
    with pytest.raises(ValueError, match="can't be followed"):
        session.candidate(obj, options.FairOptions(boundary_normals="CUSTOM"))
    assert np.array_equal(now(), before)
    assert not module("mesh.live_mesh").has_region(obj.data)


def test_what_live_refuses_is_said_as_of_any_run() -> None:
    """The report has the reason, a button what it is about; the mesh and its selection are as before."""
    obj = meshes.grid(12)
    points = meshes.positions(obj)
    (middle,) = np.flatnonzero((points[:, :2] == 0.0).all(axis=1))
    points[middle] = np.nan
    meshes.move(obj, points)
    meshes.enter(obj, meshes.faces_where(obj, lambda c: not max(abs(c.x), abs(c.y)) > 0.6))
    before = now()
    selected = [face.select for face in bmesh.from_edit_mesh(obj.data).faces]
    with pytest.raises(RuntimeError, match=f"Vertex {middle} "):
        bpy.ops.mesh.fair_live_region()
    report = meshes.report()
    assert (report.verdict, report.objects, report.free_vertices) == ("UNUSABLE", obj.name, 0)
    assert np.array_equal(now(), before, equal_nan=True)
    assert [face.select for face in bmesh.from_edit_mesh(obj.data).faces] == selected
    assert not module("mesh.live_mesh").has_region(obj.data)
    assert not bpy.context.window_manager.fairing_live.on
    assert bpy.ops.mesh.fair_select(what="SPOTS") == {"FINISHED"}
    assert [vertex.index for vertex in bmesh.from_edit_mesh(obj.data).verts if vertex.select] == [middle]


@pytest.mark.parametrize("mode", [(True, False, False), (False, False, True)])
def test_region_can_be_selected(live: Any, mode: tuple[bool, bool, bool]) -> None:
    obj, faces = table_mountain()
    before = now()
    hidden = np.flatnonzero(faces)[5]
    meshes.leave()
    obj.data.polygons[hidden].hide = True
    obj.data.polygons.foreach_set("select", (~faces).tolist())
    meshes.edit(obj)
    bpy.context.tool_settings.mesh_select_mode = mode
    assert bpy.ops.mesh.fair_select(what="LIVE") == {"FINISHED"}
    meshes.leave()
    shown = faces.copy()
    shown[hidden] = False
    assert np.array_equal([polygon.select for polygon in obj.data.polygons], shown)
    assert np.array_equal(meshes.positions(obj), before)


def test_forgetting_leaves_no_trace(live: Any) -> None:
    obj, _ = table_mountain()
    assert bpy.ops.mesh.fair_live_forget() == {"FINISHED"}
    bpy.context.view_layer.update()
    meshes.leave()
    assert module("mesh.live_mesh").LAYER not in obj.data.attributes
    assert module("mesh.live_mesh").OPTIONS not in obj.data
    assert module("mesh.live_mesh").KEY not in obj.data
    meshes.edit(obj)
    assert not bpy.ops.mesh.fair_live_forget.poll()
    assert bpy.ops.mesh.fair_select(what="LIVE") == {"CANCELLED"}
