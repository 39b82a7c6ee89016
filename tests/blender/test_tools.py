"""The tools of the toolbar and the overlay: that they are there, what they run and show, that they leave nothing."""

from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import ID, module
from test_refusals import add_tent


def in_toolbar(mode: str) -> list[str]:
    """Return the add-on's tools of a mode, by their names."""
    found = []

    def look(entry: Any) -> None:
        if hasattr(entry, "idname"):  # a tool, itself a tuple
            if entry.idname.startswith("intrinsic_fairing."):
                found.append(entry.idname.partition(".")[2])
        elif isinstance(entry, tuple):
            for each in entry:
                look(each)

    for entry in bpy.types.VIEW3D_PT_tools_active._tools[mode]:
        look(entry)
    return found


def test_they_go_with_the_extension() -> None:
    import addon_utils

    addon_utils.disable(ID)
    assert in_toolbar("EDIT_MESH") == in_toolbar("SCULPT") == in_toolbar("OBJECT") == []
    addon_utils.enable(ID)
    assert in_toolbar("EDIT_MESH") == ["lasso", "fillet"]


def test_what_they_press_exists() -> None:
    """Each entry of a keymap names an operator that is there, with properties that it has."""
    for tool in module("show.tools").TOOLS:
        for name, event, properties in tool.bl_keymap:
            room, _, operator = name.partition(".")
            known = getattr(getattr(bpy.ops, room), operator).get_rna_type().properties.keys()
            assert event["type"] == "LEFTMOUSE"
            for option, _ in (properties or {}).get("properties", ()):
                assert option in known, (name, option)
        assert tool.bl_label
        assert tool.bl_description


def test_a_stroke_leaves_no_gap() -> None:
    between = module("fair.brush").between
    assert list(between((0, 0), (0, 0), 5.0)) == [(0, 0)]
    places = np.array([(3.0, 1.0), *between((3, 1), (33, -39), 7.0)])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() <= 7.0
    np.testing.assert_allclose(places[-1], (33, -39))


def test_a_timer_finds_another_window_or_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its own may be closed by then, or show no 3D view any more."""
    home = module("host.context")
    assert home.in_view(0)["area"].type == "VIEW_3D"
    assert home.in_view(0)["region"].type == "HEADER"
    areas = [SimpleNamespace(type="TEXT_EDITOR", regions=[SimpleNamespace(type="HEADER")])]
    window = SimpleNamespace(as_pointer=lambda: 0, screen=SimpleNamespace(areas=areas))
    manager = SimpleNamespace(window_manager=SimpleNamespace(windows=[window]))
    monkeypatch.setattr(home, "bpy", SimpleNamespace(context=manager))
    assert home.in_view(0) is None


# The quality overlay's figures and switches; its pictures are for the GUI tests.
@pytest.fixture
def overlay() -> Any:
    found = module("overlay.overlay")
    yield found.overlay
    found.stop()


def settings() -> Any:
    return bpy.context.window_manager.fairing_overlay


def test_a_ball_is_red(overlay: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """As what a run has moved outwards is: the shader's colour for values above 0."""
    meshes.sphere(48)
    settings().show = True
    sent: dict[str, Any] = {}
    monkeypatch.setattr(module("overlay.overlay"), "batch_for_shader", lambda *args, **_: sent.update(args[2]))
    module("overlay.overlay")._batch(None, overlay.surfaces[0], "CURVATURE")
    assert (sent["curvature"] > 0.0).all()
    assert module("overlay.data").sense("DEVIATION") == 1.0


def test_deviation_is_the_distance_from_the_shape_before(overlay: Any) -> None:
    """A bump of a tenth on a sphere goes: its top comes down by as much, and what did not move is 0."""
    obj = meshes.sphere(48)
    points = meshes.positions(obj)
    top = points[:, 2] > 0.9
    meshes.move(obj, points * (1.0 + 0.1 * top[:, None]))
    faces = meshes.faces_where(obj, lambda centre: centre.z > 0.8)
    settings().mode = "DEVIATION"
    try:
        settings().show = True
        meshes.select(obj, faces)
        meshes.edit(obj)
        assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True) == {"FINISHED"}
        overlay.measure(bpy.context)
        (surface,) = overlay.surfaces
        highest = surface.positions[:, 2].argmax()
        assert surface.deviation[highest] == pytest.approx(-0.1, abs=5e-3)
        assert surface.largest("DEVIATION") == pytest.approx(-0.1, abs=5e-3)
        assert bpy.ops.mesh.fair_compare() == {"FINISHED"}
        overlay.measure(bpy.context)
        assert not overlay.surfaces[0].deviation.any()
        meshes.leave()
    finally:
        settings().mode = "ZEBRA"


def test_follows_edits(overlay: Any) -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    settings().show = True
    before = overlay.surfaces[0].curvature.copy()
    meshes.run()
    bpy.context.view_layer.update()
    module("overlay.overlay")._measure_later()  # the timer's function; a background process runs no timers
    assert np.abs(overlay.surfaces[0].curvature - before).max() > 0.1
    assert bpy.app.timers.is_registered(module("overlay.overlay")._measure_later)


def test_measuring_is_no_change(overlay: Any) -> None:
    later = module("overlay.overlay")._measure_later
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    settings().show = True
    bpy.context.view_layer.update()
    if bpy.app.timers.is_registered(later):
        bpy.app.timers.unregister(later)
    overlay.measure(bpy.context)
    bpy.context.view_layer.update()
    assert not bpy.app.timers.is_registered(later)  # else it would go round for ever


def test_what_is_no_surface_is_reported(overlay: Any) -> None:
    obj, _ = meshes.domed_grid()
    add_tent(obj)
    settings().show = True
    assert overlay.surfaces == ()
    assert "More than two faces" in overlay.message


def test_switching_off_leaves_nothing(overlay: Any) -> None:
    meshes.sphere()
    count = len(bpy.app.handlers.depsgraph_update_post)
    settings().show = True
    assert len(bpy.app.handlers.depsgraph_update_post) == count + 1
    settings().stripes = 12  # changes the look, not the handlers
    assert len(bpy.app.handlers.depsgraph_update_post) == count + 1
    settings().show = False
    assert len(bpy.app.handlers.depsgraph_update_post) == count
    assert (overlay.surfaces, overlay.handle) == ((), None)
