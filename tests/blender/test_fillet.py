"""Fair Fillet in Blender: edges are rounded, faces are cut; what is cancelled or refused leaves the mesh as it was."""

from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import letters
import meshes
from extension import module, stand_in
from test_fill import border_edges

WIDTH = 0.3


def cube() -> bpy.types.Object:
    """[−1, 1]³ of six quads, with a UV map and two materials: one side has the second."""
    bm = bmesh.new()
    bmesh.ops.create_cube(bm, size=2.0, calc_uvs=True)
    mesh = bpy.data.meshes.new("Cube")
    bm.loops.layers.uv.verify()
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new("Cube", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    for name in ("One", "Two"):
        mesh.materials.append(bpy.data.materials.new(name))
    for polygon in mesh.polygons:
        polygon.material_index = int(polygon.center.x > 0.9)
    return obj


def edge_mask(obj: bpy.types.Object, chosen: Any) -> Any:
    points = meshes.positions(obj)
    return np.array([bool(chosen(points[list(edge.vertices)])) for edge in obj.data.edges])


def upright(ends: Any) -> bool:
    """Whether an edge is the one at x = y = 1."""
    return bool(np.allclose(ends[:, :2], 1.0))


def enter(obj: bpy.types.Object, chosen: Any) -> None:
    """Edit the mesh with exactly these edges selected."""
    meshes.select_edges(obj, lambda edge: chosen[edge.index])


def run(obj: bpy.types.Object, chosen: Any, **properties: Any) -> set[str]:
    """Run it from and to object mode."""
    enter(obj, chosen)
    try:
        return set(bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", True, **{"width": WIDTH, "quads": False, **properties}))
    finally:
        meshes.leave()


def off_the_arc(points: Any) -> Any:
    """How far the places in the middle of the edge x = y = 1 are off its arc, in widths."""
    near = points[(np.abs(points[:, 2]) < 0.25) & (points[:, :2] > 1 - WIDTH - 1e-6).all(axis=1)]
    assert len(near) > 20
    return np.abs(np.linalg.norm(near[:, :2] - (1 - WIDTH), axis=1) - WIDTH) / WIDTH


def test_an_edge_of_a_cube_becomes_an_arc_and_its_faces_stay_polygons() -> None:
    obj = cube()
    assert run(obj, edge_mask(obj, upright)) == {"FINISHED"}
    assert border_edges(obj) == 0
    assert off_the_arc(meshes.positions(obj)).max() < 2e-3
    rest = [polygon for polygon in obj.data.polygons if not polygon.select]
    assert len(rest) == 6
    assert {len(polygon.vertices) for polygon in rest} > {4}
    corners = 2 * (1.0 - np.pi / 4) * WIDTH**2  # of the faces at its ends
    assert sum(polygon.area for polygon in rest) == pytest.approx(24.0 - 2 * WIDTH * 2.0 - corners, abs=2e-3)
    assert all(len(polygon.vertices) == 3 for polygon in obj.data.polygons if polygon.select)


@pytest.mark.parametrize("quads", [True, False])
def test_marks_of_edges_that_are_cut_stay(quads: bool) -> None:
    """Those of the four upright edges, from which all edges around the top take their upper ends."""
    obj = cube()
    mesh = obj.data
    mesh.attributes.new("mine", "INT", "EDGE")
    mesh.attributes.new("crease_edge", "FLOAT", "EDGE")
    beside = edge_mask(obj, lambda ends: np.ptp(ends[:, 2]) > 1.0)
    for edge, on in zip(mesh.edges, beside, strict=True):
        edge.use_edge_sharp = edge.use_seam = bool(on)
        mesh.attributes["mine"].data[edge.index].value = 7 * int(on)
        mesh.attributes["crease_edge"].data[edge.index].value = 0.5 * int(on)
    assert run(obj, edge_mask(obj, lambda ends: (ends[:, 2] > 0.9).all()), quads=quads) == {"FINISHED"}
    pieces = edge_mask(obj, lambda ends: np.ptp(ends[:, 2]) > 1.0)
    assert pieces.sum() == 4
    for edge, on in zip(obj.data.edges, pieces, strict=True):
        marks = (edge.use_edge_sharp, edge.use_seam, obj.data.attributes["mine"].data[edge.index].value == 7)
        assert set(marks) == {bool(on)}
        assert obj.data.attributes["crease_edge"].data[edge.index].value == 0.5 * on


def test_materials_and_textures_follow_from_each_side() -> None:
    """A texture that is the place itself runs on without a jump on either side of the edge."""
    obj = cube()
    layer = obj.data.uv_layers.active.data
    points = meshes.positions(obj)
    for polygon in obj.data.polygons:
        first = polygon.material_index == 1
        for k in polygon.loop_indices:
            x, y, z = points[obj.data.loops[k].vertex_index]
            layer[k].uv = (y, z) if first else (x + 10.0, z)
    assert run(obj, edge_mask(obj, upright)) == {"FINISHED"}
    layer = obj.data.uv_layers.active.data
    kinds = set()
    for polygon in obj.data.polygons:
        us = np.array([layer[k].uv[0] for k in polygon.loop_indices])
        assert (us < 5.0).all() if polygon.material_index == 1 else (us > 5.0).all()
        if polygon.select:
            kinds.add(polygon.material_index)
    assert kinds == {0, 1}


def snapshot() -> Any:
    """The mesh in edit mode to the bit, with its selection."""
    return meshes.contents_in_edit_mode(bpy.context.edit_object.name)


def test_what_is_refused_stays_with_its_selection_and_its_spots_are_shown() -> None:
    obj = cube()
    meshes.enter(obj, np.ones(6, dtype=bool))
    before = snapshot()
    with pytest.raises(RuntimeError, match="is too large"):
        bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", True, width=1.2, clamp=False)
    assert snapshot() == before
    bpy.ops.mesh.select_all(action="DESELECT")
    assert bpy.ops.mesh.fair_select(what="SPOTS") == {"FINISHED"}
    assert all(vertex.select for vertex in bmesh.from_edit_mesh(obj.data).verts)


def stand() -> Any:
    """The operator's methods without Blender's own part, and what it has read."""
    fillet = module("fillet.operator")
    made = stand_in(fillet.MESH_OT_fair_fillet, confirm_on_release=False)
    for name, value in asdict(module("options.other_options").FilletOptions(quads=False)).items():
        setattr(made, name, value)
    made._asked = made._read(bpy.context)
    return made


def event(kind: str, value: str = "PRESS", at: tuple[int, int] = (0, 0), ascii: str = "") -> Any:
    return SimpleNamespace(type=kind, value=value, mouse_x=at[0], mouse_y=at[1], shift=False, ascii=ascii)


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> Any:
    """What previews were reported."""
    reported: list[Any] = []
    monkeypatch.setattr(module("fillet.operator"), "show", reported.append)
    return reported


def dragged(operator: Any, pixels: int) -> None:
    operator._follow(event("MOUSEMOVE"), 0.01)
    assert operator.modal(bpy.context, event("MOUSEMOVE", at=(0, pixels))) == {"RUNNING_MODAL"}
    searched(operator)


def searched(operator: Any) -> None:
    for _ in "begin", "show":
        assert operator.modal(bpy.context, event("TIMER")) == {"RUNNING_MODAL"}
        assert operator._search.wait(10.0)


def test_the_mouse_moves_the_width_and_a_click_accepts(shown: Any) -> None:
    obj = cube()
    enter(obj, edge_mask(obj, upright))
    operator = stand()
    before = snapshot()
    dragged(operator, 30)
    assert operator.width == pytest.approx(WIDTH)
    assert len(shown[-1][0][1]) > 50
    assert snapshot() == before
    assert operator.modal(bpy.context, event("LEFTMOUSE")) == {"FINISHED"}
    assert shown[-1] == []
    meshes.leave()
    assert off_the_arc(meshes.positions(obj)).max() < 2e-3


def test_the_wheel_changes_the_profile_and_digits_the_width(shown: Any) -> None:
    obj = cube()
    enter(obj, edge_mask(obj, upright))
    operator = stand()
    dragged(operator, 10)
    for kind, character in (("ZERO", "0"), ("PERIOD", "."), ("THREE", "3")):
        operator.modal(bpy.context, event(kind, ascii=character))
    assert operator.width == pytest.approx(0.3)
    operator.modal(bpy.context, event("MOUSEMOVE", at=(0, 80)))  # what is typed stays
    assert operator.width == pytest.approx(0.3)
    for _ in range(5):
        operator.modal(bpy.context, event("WHEELUPMOUSE"))
    assert operator.profile == pytest.approx(0.5)
    searched(operator)
    assert operator._asked.options.profile == operator.profile


def test_what_takes_long_is_watched_after_the_click_and_can_be_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    obj = cube()
    enter(obj, edge_mask(obj, upright))
    operator, before = stand(), snapshot()
    operator._start_watching = lambda _context: None

    def endless(_tasks: Any, _options: Any, progress: Any) -> Any:
        while progress(0.0, ""):
            pass
        raise module("fair.engine").fairing.Cancelled

    monkeypatch.setattr(module("fillet.operator"), "solve", endless)
    operator._follow(event("MOUSEMOVE"), 0.01)
    operator.modal(bpy.context, event("LEFTMOUSE", "RELEASE"))  # from the menu the button is pressed once more
    assert operator._run is None
    operator.confirm_on_release = True
    assert operator.modal(bpy.context, event("LEFTMOUSE", "RELEASE")) == {"RUNNING_MODAL"}
    assert operator.modal(bpy.context, event("ESC")) == {"CANCELLED"}
    assert operator._run.wait(10.0)
    assert snapshot() == before


def test_a_width_that_is_too_large_is_reported_while_dragging(shown: Any) -> None:
    obj = cube()
    meshes.enter(obj, np.ones(6, dtype=bool))
    operator, before = stand(), snapshot()
    operator.clamp = False
    dragged(operator, 150)
    assert shown[-1] == []
    assert "is too large" in operator._reason
    assert operator.modal(bpy.context, event("ESC")) == {"CANCELLED"}
    assert snapshot() == before


def test_a_vertex_group_scales_the_width() -> None:
    obj = cube()
    group = obj.vertex_groups.new(name="Wide")
    for k, place in enumerate(meshes.positions(obj)):
        group.add([k], 1.0 if place[2] > 0 else 0.5, "REPLACE")
    assert run(obj, edge_mask(obj, upright), width=0.4, width_group="Wide") == {"FINISHED"}
    points = meshes.positions(obj)
    for side in (0, 1):
        ends = points[np.isclose(points[:, 1 - side], 1.0) & (points[:, side] < 0.999) & (np.abs(points[:, 2]) < 0.999)]
        ends = ends[ends[:, side] > 0]
        assert np.abs(1 - ends[:, side] - (0.3 + 0.1 * ends[:, 2])).min() < 1e-5


@pytest.mark.parametrize(("width", "status"), [(WIDTH, 0), (1.2, 2)])
def test_the_command_line_rounds_hard_edges(tmp_path: Path, width: float, status: int) -> None:
    obj = cube()
    target = tmp_path / "rounded.blend"
    words = f"--object {obj.name} --fillet --width {width} --edge-length 0.1 --no-clamp"
    given = [*words.split(), "--output", str(target)]
    assert module("run.cli").execute(given) == status
    assert target.exists() == (status == 0)
    assert (len(obj.data.polygons) > 6) == (status == 0)


@pytest.mark.parametrize("cuts", [0, 1])
def test_a_closed_seam_is_what_is_rounded_not_what_it_encloses(cuts: int) -> None:
    """The cube's upper rim is rounded, and none of the edges below it; undivided, all of its edges select a face."""
    obj = cube()
    if cuts:
        meshes.edit(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide(number_cuts=cuts)
        bpy.ops.object.mode_set(mode="OBJECT")
    rim = edge_mask(
        obj, lambda ends: np.allclose(ends[:, 2], 1.0) and np.isclose(np.abs(ends).min(axis=0), 1.0).sum() > 1
    )
    assert run(obj, rim, width=WIDTH) == {"FINISHED"}
    points = meshes.positions(obj)
    below = points[np.abs(points[:, 2] + 1.0) < 1e-6]
    assert len(below) == (4, 9)[cuts]
    assert np.abs(points[:, :2]).max() == 1.0
    top = points[np.abs(points[:, 2] - 1.0) < 1e-6]
    assert np.abs(top[:, :2]).max() < 1.0 - 0.9 * WIDTH


@pytest.mark.parametrize(("letter", "width"), [("A", 0.05), ("R", 0.025)])
def test_a_letter_on_a_bent_plate_has_a_fillet_at_its_foot(letter: str, width: float) -> None:
    """Of the surface asked for, not of a stand-in (R has the equation's at 2 of 11 widths); nothing above it moves."""
    obj = letters.on_plate(letter)
    above = [tuple(v.co) for v in obj.data.vertices if v.co.z > letters.HEIGHT - 1e-4]
    result = module("fillet.script").fillet_mesh(obj.data, letters.foot(obj), width=width)
    assert (result.converged, result.provenance) == (True, "equation")
    assert len(result.vertices) > 1000
    assert np.percentile(result.boundary_angle, 80) < 10.0  # more where the letter's upright edges end
    assert {tuple(v.co) for v in obj.data.vertices} >= set(above)
