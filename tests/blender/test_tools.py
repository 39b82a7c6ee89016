"""The tools of the toolbar: that they are there, what they run, and that they leave nothing behind.

How they feel is for the window: bpy has neither a mouse nor a 3D view.
"""

from types import SimpleNamespace
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import ID, give_options, module


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


def test_each_mode_has_its_tools() -> None:
    assert in_toolbar("EDIT_MESH") == ["lasso", "paint", "fillet"]
    assert in_toolbar("SCULPT") == ["brush", "face_set"]
    assert in_toolbar("OBJECT") == ["face_set"]


def test_they_go_with_the_extension() -> None:
    import addon_utils

    addon_utils.disable(ID)
    assert in_toolbar("EDIT_MESH") == in_toolbar("SCULPT") == in_toolbar("OBJECT") == []
    addon_utils.enable(ID)
    assert in_toolbar("EDIT_MESH") == ["lasso", "paint", "fillet"]


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


@pytest.mark.parametrize("name", ["lasso", "paint"])
def test_a_gesture_is_a_selection_and_a_run(name: str) -> None:
    properties = getattr(bpy.ops.mesh, f"fair_{name}").get_rna_type().properties.keys()
    selects = {"lasso": "VIEW3D_OT_select_lasso", "paint": "MESH_OT_fair_stroke"}[name]
    assert [key for key in properties if "_OT_" in key] == [selects, "MESH_OT_fair_region"]


def test_a_stroke_leaves_no_gap() -> None:
    between = module("fair.strokes").between
    assert list(between((0, 0), (0, 0), 5.0)) == [(0, 0)]
    places = np.array([(3.0, 1.0), *between((3, 1), (33, -39), 7.0)])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() <= 7.0
    np.testing.assert_allclose(places[-1], (33, -39))


def test_the_arrow_of_a_bulge_goes_as_far_as_the_surface() -> None:
    """On a flat disc: the option that the arrow sets lifts the middle as far as the arrow went."""
    obj = meshes.grid(24)
    faces = meshes.faces_where(obj, lambda c: c.xy.length < 0.7)
    meshes.enter(obj, faces)
    group = module("show.gizmos").VIEW3D_GGT_fair_bulge
    bulge = 0.2
    assert bpy.ops.mesh.fair_region("EXEC_DEFAULT", True, bulge=bulge) == {"FINISHED"}
    top = module("mesh.mesh_io").edit_positions(obj.data)[:, 2].max()
    place, normal, radius = module("run.last_run").middle(bpy.context)
    np.testing.assert_allclose(normal, (0.0, 0.0, 1.0), atol=0.1)
    np.testing.assert_allclose(place[2], top, rtol=0.1)
    np.testing.assert_allclose(bulge * module("show.gizmos").LIFT * radius, top, rtol=0.15)
    assert group.operator == "MESH_OT_fair_region"


def test_the_arrow_of_a_width_begins_at_the_seam() -> None:
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    bpy.ops.mesh.select_all(action="DESELECT")
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    for edge in bm.edges:
        edge.select_set(all(v.co.x > 0.0 and v.co.z > 0.0 for v in edge.verts))
    assert bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", True, width=0.3) == {"FINISHED"}
    foot, away = module("fillet.operator").handle.flank
    np.testing.assert_allclose(foot, (1.0, 0.0, 1.0), atol=1e-6)
    assert min(np.linalg.norm(away - d) for d in ((-1, 0, 0), (0, 0, -1))) < 1e-6
    options_of, operator = module("show.gizmos").options_of, bpy.context.window_manager.operators[-1]
    assert options_of(operator, "MESH_OT_fair_fillet").width == pytest.approx(0.3)
    assert options_of(operator, "MESH_OT_fair_region") is None


def test_the_face_set_under_the_mouse_is_faired(monkeypatch: pytest.MonkeyPatch) -> None:
    masked = module("fair.masked")
    obj, faces = meshes.domed_grid()
    by_number, _ = meshes.domed_grid()
    for each in (obj, by_number):
        sets = each.data.attributes.new(".sculpt_face_set", "INT", "FACE")
        sets.data.foreach_set("value", np.where(faces, 7, 3).astype(np.int32))
    assert bpy.ops.mesh.fair_masked("EXEC_DEFAULT", True, source="FACE_SET", face_set=7) == {"FINISHED"}
    bpy.context.view_layer.objects.active = obj
    picked = int(np.flatnonzero(faces)[0])
    monkeypatch.setattr(masked, "face_under_mouse", lambda *_: picked)
    parts = (
        module("run.background").Watched,
        module("host.picking").Picks,
        module("fair.outside").FairsOutside,
        masked.MESH_OT_fair_masked,
    )
    methods = {name: value for part in parts for name, value in vars(part).items() if not name.startswith("__")}
    methods.pop("bl_rna", None)
    stand = give_options(type("Stand", (), {**methods, "report": lambda *_: None})())
    stand.source, stand.face_set, stand.group, stand.under_mouse = "FACE_SET", 0, "", True
    assert stand.invoke(bpy.context, SimpleNamespace(type="LEFTMOUSE", value="PRESS")) == {"FINISHED"}
    assert meshes.positions(obj).tobytes() == meshes.positions(by_number).tobytes()


def test_letting_go_accepts_a_fillet_of_the_tool_alone() -> None:
    """From the menu the button is pressed once more."""
    for by_tool, accepted in ((True, True), (False, False)):
        stand: Any = SimpleNamespace(confirm_on_release=by_tool, _typed=SimpleNamespace(take=lambda *_: False))
        done: list[bool] = []
        stand._accept = lambda _context, done=done: done.append(True) or {"FINISHED"}
        stand._say = lambda _context: None
        release = SimpleNamespace(type="LEFTMOUSE", value="RELEASE", ascii="")
        module("fillet.operator").MESH_OT_fair_fillet.modal(stand, bpy.context, release)
        assert bool(done) == accepted


def test_blender_may_end_the_wait_for_a_click() -> None:
    """As it does where it closes the window or the add-on goes: pointer and status bar are as before."""
    left: list[Any] = []
    window = SimpleNamespace(
        cursor_modal_restore=lambda: left.append("pointer"), workspace=SimpleNamespace(status_text_set=left.append)
    )
    context = SimpleNamespace(window=None, window_manager=SimpleNamespace(windows=[window]))
    module("host.picking").Picks().cancel(context)
    assert left == ["pointer", None]


def test_a_timer_finds_another_window_or_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its own may be closed by then, or show no 3D view any more."""
    home = module("host.context")
    assert home.in_view(0, "WINDOW")["area"].type == "VIEW_3D"
    assert home.in_view(0, "WINDOW")["region"].type == "WINDOW"
    areas = [SimpleNamespace(type="TEXT_EDITOR", regions=[SimpleNamespace(type="HEADER")])]
    window = SimpleNamespace(as_pointer=lambda: 0, screen=SimpleNamespace(areas=areas))
    manager = SimpleNamespace(window_manager=SimpleNamespace(windows=[window]))
    monkeypatch.setattr(home, "bpy", SimpleNamespace(context=manager))
    assert home.in_view(0, "HEADER") is None
