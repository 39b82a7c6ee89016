"""What is refused leaves no trace and says where; nothing is said twice; what is odd is reported."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import give_options, inspect, module, stand_in


def add_nan(obj: bpy.types.Object) -> None:
    points = meshes.positions(obj)
    points[np.abs(points[:, :2]).max(axis=1).argmin()] = np.nan
    meshes.move(obj, points)


def add_tent(obj: bpy.types.Object) -> None:
    """Raise a closed tent on an edge in the middle of the selection: four faces meet there."""
    with meshes.rebuilt(obj) as bm:
        a, b = min(bm.edges, key=lambda e: sum(v.co.xy.length for v in e.verts)).verts
        tips = [bm.verts.new((0.0, y, 1.0)) for y in (-0.1, 0.1)]
        for face in ((a, b, tips[0]), (b, a, tips[1]), (a, tips[0], tips[1]), (b, tips[1], tips[0])):
            bm.faces.new(face)


@pytest.mark.parametrize("name", ["pin_group", "continuity_group", "vertex_group"])
def test_a_group_that_is_not_there_is_refused(name: str) -> None:
    obj, faces = meshes.domed_grid()
    before = meshes.in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match="Missing"):
        meshes.fair(obj, faces, **{name: "Missing", "continuity": "G0"})
    assert meshes.contents(obj) == before


def test_a_refused_run_takes_the_place_of_the_one_before() -> None:
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces)
    assert meshes.report().written
    assert module("run.last_run").has_regions()
    with pytest.raises(RuntimeError, match="Missing"):
        meshes.fair(obj, faces, pin_group="Missing")
    report = meshes.report()
    assert (report.verdict, report.written, report.converged, report.free_vertices) == ("UNUSABLE", False, False, 0)
    assert report.reason == "Pin Group: there is no vertex group named 'Missing'"
    assert (report.objects, report.warnings, len(report.checks), report.seconds) == (obj.name, "", 0, 0.0)
    assert not module("run.last_run").has_regions()
    assert not bpy.types.VIEW3D_PT_fairing_report.poll(bpy.context)


# By name, for the reason that test_panel.py gives for its SPOILERS.


def test_too_little_memory_is_a_refusal(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the engine says of a run that is too large for the machine."""

    def refuse(*_: Any, **__: Any) -> None:
        raise MemoryError("about 7.0 GB of memory are needed")

    job = module("run.job")
    job.memory.clear()  # another test may have faired this very mesh: that answer needs no engine
    monkeypatch.setattr(module("fair.engine").fairing, "fair", refuse)
    obj, faces = meshes.domed_grid()
    before = meshes.in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match=r"7\.0 GB"):
        meshes.fair(obj, faces)
    assert meshes.contents(obj)["POINT position"] == before["POINT position"]
    assert "7.0 GB" in inspect(obj, faces).refusal


# What is said to the user: nothing in silence, nothing twice, and one of a kind in the singular.
def reported(*objects: bpy.types.Object, **properties: Any) -> list[str]:
    """Return the infos and warnings of a run, from and to object mode."""
    execute = module("run.background").Watched.execute
    stand = give_options(stand_in(module("fair.operator").MESH_OT_fair_region, execute=execute), **properties)
    meshes.edit(*objects)
    try:
        stand.execute(bpy.context)
    finally:
        meshes.leave()
    return [text for _, text in stand.reported]


def test_an_object_without_free_vertices_is_named() -> None:
    first, faces = meshes.domed_grid()
    second, _ = meshes.domed_grid()
    third, _ = meshes.domed_grid()
    one = np.zeros_like(faces)
    one[9] = True
    for obj, chosen in ((first, faces), (second, one), (third, np.zeros_like(faces))):
        meshes.select(obj, chosen)
    said = reported(first, second, third)
    note = f"{second.name} was left as it is: no vertex inside its selection is free to move"
    assert note in said
    assert note in meshes.report().warnings
    assert not any(third.name in text for text in said)  # nothing was asked for there


@pytest.mark.parametrize("weight", [None, 0.0, 1.0])
def test_a_pin_group_that_pins_nothing(weight: float | None) -> None:
    obj, faces = meshes.domed_grid()
    group = obj.vertex_groups.new(name="Pin")
    outside = np.flatnonzero(~meshes.free_vertices(obj, faces)).tolist()
    inside = np.flatnonzero(meshes.free_vertices(obj, faces)).tolist()
    group.add(outside, 1.0, "REPLACE")
    if weight is not None:
        group.add(inside[:1], weight, "REPLACE")
    meshes.select(obj, faces)
    notes = [text for text in reported(obj, pin_group="Pin") if "pins nothing" in text]
    assert len(notes) == (0 if weight else 1)
    assert ("'Pin' has no vertex inside" in "".join(inspect(obj, faces, pin_group="Pin").notes)) == bool(notes)


@pytest.mark.parametrize("nothing", ["no face", "no free vertex", "no border"])
def test_where_there_is_nothing_to_do_the_report_is_not_that_of_the_run_before(nothing: str) -> None:
    obj, faces = meshes.domed_grid()
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert (meshes.report().verdict, meshes.report().written) == ("GOOD", True)
    alone = np.zeros_like(faces)
    alone[np.flatnonzero(faces)[0]] = nothing == "no free vertex"
    if nothing == "no border":
        meshes.select(obj, np.zeros_like(faces))
        meshes.edit(obj)
        with pytest.raises(RuntimeError, match="No border is selected"):
            bpy.ops.mesh.fair_fill()
        meshes.leave()
    else:
        assert meshes.fair(obj, alone) == {"CANCELLED"}
    assert (meshes.report().verdict, meshes.report().written) == ("UNUSABLE", False)
    assert meshes.report().reason.startswith("No ")
