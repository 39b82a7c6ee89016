"""What is said to the user: nothing in silence, nothing twice, and one of a kind in the singular."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import give_options, inspect, module, stand_in


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


@pytest.mark.parametrize("mode", [(True, False, False), (False, True, False), (False, False, True)])
def test_no_face_selected(mode: tuple[bool, bool, bool]) -> None:
    obj, faces = meshes.domed_grid()
    meshes.select(obj, np.zeros_like(faces))
    if not mode[2]:  # a single edge, its vertices with it
        obj.data.edges[5].select = True
        for vertex in obj.data.edges[5].vertices:
            obj.data.vertices[vertex].select = True
    bpy.context.tool_settings.mesh_select_mode = mode
    (text,) = reported(obj)
    assert text.startswith("No face is selected: select the faces")
    assert inspect(obj, np.zeros_like(faces)).refusal == text


def test_no_free_vertex() -> None:
    obj, faces = meshes.domed_grid()
    one = np.zeros_like(faces)
    one[9] = True
    meshes.select(obj, one)
    (text,) = reported(obj)
    assert text.startswith("No vertex is free to move")
    assert inspect(obj, one).refusal == text


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
