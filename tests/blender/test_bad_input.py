"""Nothing breaks the operator: the rows of tests/test_robustness.py that apply in Blender, in its order.

Refused: the mesh keeps every bit, no undo step is added, the elements in question are selected. Solved: finite, all but
the free vertices keep every bit, what is odd is reported.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bmesh
import bpy
import meshes
import numpy as np
import pytest
import spoiled
from test_restoration import BOUND, off_sphere, spoil, upper_half


def without_selection(contents: dict[str, bytes]) -> dict[str, bytes]:
    return {key: value for key, value in contents.items() if "select" not in key}


def chosen(name: str) -> list[int]:
    meshes.leave()
    found = [v.index for v in bpy.data.objects[name].data.vertices if v.select]
    bpy.ops.object.mode_set(mode="EDIT")
    return found


@contextmanager
def no_step_added(obj: bpy.types.Object, moving: Any, faces: Any) -> Iterator[dict[str, bytes]]:
    """Give the contents after a move, `faces` selected; see that an undo afterwards takes back the move."""
    name = obj.name
    meshes.select(obj, moving)
    meshes.edit(obj)
    bpy.ops.ed.undo_push(message="first")
    first = meshes.contents_in_edit_mode(name)
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.25))
    meshes.leave()
    meshes.select(obj, faces)
    meshes.edit(obj)
    bpy.ops.ed.undo_push(message="second")
    second = meshes.contents_in_edit_mode(name)
    assert first["POINT position"] != second["POINT position"]
    yield second
    bpy.ops.ed.undo()
    assert meshes.contents_in_edit_mode(name)["POINT position"] == first["POINT position"]
    meshes.leave()


def refusal(obj: bpy.types.Object, faces: Any, **properties: Any) -> tuple[str, list[int]]:
    """Run what is refused, see that it leaves no trace; return the message and the vertices selected by it."""
    name = obj.name
    with no_step_added(obj, faces, faces) as before:
        with pytest.raises(RuntimeError) as caught:
            meshes.run(**properties)
        assert without_selection(meshes.contents_in_edit_mode(name)) == without_selection(before)
        return str(caught.value), chosen(name)


def solved(obj: bpy.types.Object, faces: Any, free: Any = None, **properties: Any) -> str:
    """Run what is solved, see that nothing but the free vertices moved and all is finite; return the warnings."""
    before = meshes.in_edit_mode_once(obj, faces)
    assert meshes.fair(obj, faces, **properties) == {"FINISHED"}
    moved = meshes.moved(before, meshes.contents(obj))
    assert not (moved & ~(meshes.free_vertices(obj, faces) if free is None else free)).any()
    assert moved.any()
    assert np.isfinite(meshes.positions(obj)[moved]).all()
    return str(meshes.report().warnings)


@pytest.mark.parametrize("method", ["GLOBAL", "PAPER"])
def test_a_fin_in_the_selection_is_refused(method: str) -> None:
    obj, _ = meshes.domed_grid()
    edge = spoiled.raise_fin(obj, (0.0, 0.125))
    text, selected = refusal(obj, spoiled.central(obj), method=method)
    assert "More than two faces meet at the edge" in text
    assert selected == sorted(edge)


def test_a_fin_on_the_outline_changes_nothing() -> None:
    clean, faces = meshes.domed_grid()
    meshes.fair(clean, faces)
    obj, _ = meshes.domed_grid()
    spoiled.raise_fin(obj, (0.625, 0.75))
    with_fin = np.append(faces, True)
    text = solved(obj, with_fin, np.append(meshes.free_vertices(clean, faces), False))
    assert "1 face stands on an edge with more than two faces" in text
    np.testing.assert_allclose(meshes.positions(obj)[:-1], meshes.positions(clean), atol=1e-6)


def test_lobes_that_share_a_vertex_are_solved_each_as_alone() -> None:
    results = []
    for corners in (((-0.5, -0.5), (0.5, 0.5)), ((-0.5, -0.5),), ((0.5, 0.5),)):
        obj, _ = meshes.domed_grid()
        faces = meshes.faces_where(obj, lambda c, at=corners: any(max(abs(c.x - x), abs(c.y - y)) < 0.5 for x, y in at))
        solved(obj, faces, boundary_normals="AVERAGE")  # the other lobe is among the surroundings of one alone
        results.append(meshes.positions(obj))
    both, low, high = results
    original = meshes.positions(meshes.domed_grid()[0])
    np.testing.assert_allclose(both, low + high - original, atol=1e-6)


def test_a_bow_tie_is_refused() -> None:
    obj = spoiled.bow_tie()
    text, selected = refusal(obj, np.ones(len(obj.data.polygons), dtype=bool))
    assert "Free vertex 0 joins several fans of faces" in text
    assert selected == [0]


@pytest.mark.parametrize("reach", [0.2, 0.3, 0.4])
@pytest.mark.parametrize("inner_fairness", ["UNIFORM", "CONFORMAL"])
def test_edges_without_length_and_faces_without_area(reach: float, inner_fairness: str) -> None:
    """Everything within `reach` of the middle moved into it: the middle alone has neighbours at 0.25."""
    clean, faces = meshes.domed_grid()
    obj, _ = meshes.domed_grid()
    points = meshes.positions(obj)
    near = np.linalg.norm(points[:, :2], axis=1) < reach
    near[spoiled.middle(obj) + 1] = True
    points[near] = points[spoiled.middle(obj)]
    meshes.move(obj, points)
    text = solved(obj, faces, inner_fairness=inner_fairness)
    assert "have a part without area" in text
    if inner_fairness == "UNIFORM":  # conformal weights belong to the shape given
        meshes.fair(clean, faces)
        np.testing.assert_allclose(meshes.positions(obj), meshes.positions(clean), atol=1e-5)


@pytest.mark.parametrize("boundary_normals", ["SURROUNDING", "AVERAGE"])
def test_an_unwelded_seam_stays_and_is_told(boundary_normals: str) -> None:
    obj, _ = meshes.domed_grid()
    doubled = spoiled.split_seam(obj)
    assert doubled == 9
    seam = np.abs(meshes.positions(obj)[:, 0]) < 1e-6
    faces = spoiled.central(obj)
    text = solved(obj, faces, meshes.free_vertices(obj, faces) & ~seam, boundary_normals=boundary_normals)
    assert "Merge by Distance" in text


def test_one_face_wound_the_other_way() -> None:
    clean = meshes.sphere()
    upper = upper_half(clean)
    spoil(clean, upper)
    obj = meshes.add(meshes.positions(clean), [tuple(p.vertices) for p in clean.data.polygons])
    top = int(np.argmax([p.center.z for p in obj.data.polygons]))
    spoiled.turn_face(obj, top)
    meshes.fair(clean, upper)
    text = solved(obj, upper)
    assert "1 face is wound against the others" in text
    np.testing.assert_allclose(meshes.positions(obj), meshes.positions(clean), atol=1e-6)


def test_a_moebius_strip_is_refused() -> None:
    obj = spoiled.moebius_strip()
    text, selected = refusal(obj, np.ones(len(obj.data.polygons), dtype=bool))
    assert "a single side" in text
    assert selected


def test_a_closed_component_alone_is_refused() -> None:
    obj = meshes.sphere(16)
    text, selected = refusal(obj, np.ones(len(obj.data.polygons), dtype=bool))
    assert "The selection is closed" in text
    assert selected == list(range(len(obj.data.vertices)))


def test_a_closed_component_beside_others_is_left_alone() -> None:
    clean, faces = meshes.domed_grid()
    meshes.fair(clean, faces)
    obj = spoiled.join(meshes.domed_grid()[0], meshes.sphere(16))
    count = len(clean.data.vertices)
    everything = np.ones(len(obj.data.polygons), dtype=bool)
    everything[: len(faces)] = faces
    free = np.zeros(len(obj.data.vertices), dtype=bool)
    free[:count] = meshes.free_vertices(clean, faces)
    assert "A closed part of the selection has nothing to hold it" in solved(obj, everything, free)
    np.testing.assert_allclose(meshes.positions(obj)[:count], meshes.positions(clean), atol=1e-6)


def test_normals_against_the_winding_are_told() -> None:
    obj, faces = meshes.domed_grid()
    obj.data.normals_split_custom_set([(0.0, 0.0, -1.0)] * len(obj.data.loops))
    assert "point to the faces' back" in solved(obj, faces, boundary_normals="CUSTOM", accept="ALL")


def test_the_normal_of_a_pin_is_told_to_be_ignored() -> None:
    obj, faces = meshes.domed_grid()
    pin = spoiled.middle(obj)
    obj.vertex_groups.new(name="Pin").add([pin], 1.0, "REPLACE")
    free = meshes.free_vertices(obj, faces)
    free[pin] = False
    assert "1 pinned vertex has no pinned neighbour" in solved(obj, faces, free, pin_group="Pin")


@pytest.mark.parametrize("count", [0, 1, 2])
def test_nothing_to_move_adds_no_undo_step(count: int) -> None:
    obj, faces = meshes.domed_grid()
    few = np.zeros_like(faces)
    few[:count] = True
    name = obj.name
    with no_step_added(obj, faces, few) as before:
        assert meshes.run() == {"CANCELLED"}
        assert meshes.contents_in_edit_mode(name) == before


def dented(obj: bpy.types.Object, faces: Any) -> None:
    """Flatten the free vertices."""
    points = meshes.positions(obj)
    points[meshes.free_vertices(obj, faces), 2] *= 0.5
    meshes.move(obj, points)


@pytest.mark.parametrize("segments", [3, 4, 6, 50, 500])
def test_one_free_vertex_on_a_sphere(segments: int) -> None:
    obj = spoiled.globe(segments, (0.2, 0.3, 0.4, 0.5, 0.6) if segments > 6 else (0.4, 0.8, 1.2, 1.6))
    faces = np.array([0 in p.vertices for p in obj.data.polygons])
    dented(obj, faces)
    solved(obj, faces)
    # The normals come from three or four faces outside where there are few segments: those miss by degrees.
    assert off_sphere(meshes.positions(obj)) < (5e-3 if segments > 6 else 0.1)


@pytest.mark.parametrize("segments", [50, 500])
def test_poles_of_high_valence(segments: int) -> None:
    obj = spoiled.globe(segments, np.arange(1, 13) / 12.0)
    faces = meshes.faces_where(obj, lambda c: c.z > np.cos(0.5))
    dented(obj, faces)
    solved(obj, faces)
    assert meshes.report().converged
    assert off_sphere(meshes.positions(obj)) < 5e-3


def test_clusters_of_valence_3() -> None:
    obj = meshes.sphere()
    spoiled.edited(obj, lambda bm: bmesh.ops.triangulate(bm, faces=bm.faces[:]))
    spoiled.edited(obj, lambda bm: bmesh.ops.poke(bm, faces=[f for f in bm.faces if f.calc_center_median().z > 1e-3]))
    upper = upper_half(obj)
    spoil(obj, upper)
    solved(obj, upper)
    assert off_sphere(meshes.positions(obj)) < BOUND[48]


def test_infinity_elsewhere() -> None:
    clean, obj = meshes.domed_grid()[0], meshes.domed_grid()[0]
    faces = spoiled.central(obj, 0.5)
    points = meshes.positions(obj)
    points[0] = np.inf, np.nan, 0.0
    meshes.move(obj, points)
    meshes.fair(clean, faces, boundary_normals="AVERAGE")  # of the faces at the outline, which are all finite
    solved(obj, faces, boundary_normals="AVERAGE")
    np.testing.assert_allclose(meshes.positions(obj)[1:], meshes.positions(clean)[1:], atol=1e-6)
    solved(obj, faces)


@pytest.mark.parametrize("scale", [2.0**-30, 2.0**30])
def test_scale(scale: float) -> None:
    """Powers of two near 1e-9 and 1e9: float32 holds the same digits then."""
    control = meshes.sphere()
    upper = upper_half(control)
    spoil(control, upper)
    obj = meshes.add(scale * meshes.positions(control), [tuple(p.vertices) for p in control.data.polygons])
    meshes.fair(control, upper)
    solved(obj, upper)
    np.testing.assert_allclose(meshes.positions(obj) / scale, meshes.positions(control), atol=1e-6)


def test_offset_is_told() -> None:
    """At a million float32 lie 1/16 apart, which is a quarter of an edge here."""
    obj, faces = meshes.domed_grid()
    points = meshes.positions(obj)
    meshes.move(obj, points + 2.0**20)
    assert "PRECISION" in solved(obj, faces)


def test_offset_of_the_object_does_no_harm() -> None:
    """The mesh keeps its float32, the object's matrix moves it: there and back in double precision."""
    control, faces = meshes.domed_grid()
    obj, _ = meshes.domed_grid()
    obj.location = (2.0**20, -(2.0**20), 0.0)
    bpy.context.view_layer.update()
    meshes.fair(control, faces)
    solved(obj, faces)
    np.testing.assert_allclose(meshes.positions(obj), meshes.positions(control), atol=1e-6)


@pytest.mark.parametrize("ratio", [1e2, 1e4])
def test_slivers(ratio: float) -> None:
    """A grid squeezed together around x = 0."""
    obj, faces = meshes.domed_grid()
    points = meshes.positions(obj)
    near = np.abs(points[:, 0]) < 0.3
    points[near, 0] /= ratio
    meshes.move(obj, points)
    solved(obj, faces, accept="ALL")
    report = meshes.report()
    assert report.converged or (report.verdict == "UNUSABLE" and report.reason)


def test_spikes_and_folds_inside() -> None:
    results = []
    for spiked in (False, True):
        obj = meshes.sphere()
        upper = upper_half(obj)
        if spiked:
            points = meshes.positions(obj)
            free = np.flatnonzero(meshes.free_vertices(obj, upper))
            points[free[::7]] *= -3.0
            points[free[::11]] *= 40.0
            meshes.move(obj, points)
        solved(obj, upper)
        results.append(meshes.positions(obj))
    np.testing.assert_allclose(results[1], results[0], atol=1e-5)


def test_again_moves_nothing_and_the_same_gives_the_same() -> None:
    first, second = meshes.sphere(), meshes.sphere()
    upper = upper_half(first)
    for obj in (first, second):
        spoil(obj, upper)
        solved(obj, upper)
    once = meshes.positions(first)
    assert once.tobytes() == meshes.positions(second).tobytes()
    meshes.fair(first, upper)
    assert np.abs(meshes.positions(first) - once).max() < 1e-4 * 2.0
