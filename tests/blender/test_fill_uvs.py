"""Fair Fill over seams of UVs: each island goes on by itself, with its scale and its turn; seams go on with it."""

from __future__ import annotations

from typing import Any

import bpy
import meshes
import numpy as np
import pytest

from test_fill import Chosen, fill_hole, open_sphere, tubes

Floats = meshes.Floats
SIZE = 0.25  # of an island, whose centres lie at 1, 2, 3, …


def box_map(obj: bpy.types.Object, name: str = "Map", mirrored: bool = False, apart: float = 1.0) -> None:
    """Six islands, one for each side of a blown-up cube; UVs go by the angles of its grid, so that squares stay so."""
    mesh = obj.data
    points = meshes.positions(obj)
    places = np.zeros((len(mesh.loops), 2))
    for polygon in mesh.polygons:
        axis = int(np.abs(polygon.center).argmax())
        sign = 1.0 if polygon.center[axis] > 0.0 else -1.0
        for corner in polygon.loop_indices:
            point = points[mesh.loops[corner].vertex_index]
            angles = np.arctan2(np.roll(point, -axis)[1:] * [sign, 1.0], sign * point[axis])
            places[corner] = SIZE * angles * ([-1.0, 1.0] if mirrored else [1.0, 1.0])
            places[corner] += [apart * (2 * axis + (sign > 0)), 0.0]
    mesh.uv_layers.new(name=name).uv.foreach_set("vector", places.astype(np.float32).ravel())


def mark_seams(obj: bpy.types.Object) -> int:
    """Mark the edges where the sides of the cube meet; return how many there are."""
    sides: dict[Any, set[int]] = {}
    for polygon in obj.data.polygons:
        axis = int(np.abs(polygon.center).argmax())
        for key in polygon.edge_keys:
            sides.setdefault(key, set()).add(2 * axis + (polygon.center[axis] > 0.0))
    for edge in obj.data.edges:
        edge.use_seam = len(sides[tuple(sorted(edge.vertices))]) > 1
    return sum(edge.use_seam for edge in obj.data.edges)


def places(obj: bpy.types.Object, polygon: Any, name: str = "Map") -> Floats:
    uv = obj.data.uv_layers[name].uv
    return np.array([uv[corner].vector[:] for corner in polygon.loop_indices])


def flat_area(rows: Floats) -> float:
    x, y = rows.T
    return float(0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum())


def parted(obj: bpy.types.Object, name: str = "Map") -> set[Any]:
    """The edges between new polygons where UVs part."""
    found: dict[Any, set[Any]] = {}
    for polygon in obj.data.polygons:
        if polygon.select:
            of = dict(zip(polygon.vertices, map(tuple, places(obj, polygon, name).round(5)), strict=True))
            for key in polygon.edge_keys:
                found.setdefault(key, set()).add(tuple(of[vertex] for vertex in key))
    return {key for key, both in found.items() if len(both) > 1}


HOLES: dict[str, tuple[Chosen, int]] = {
    "edge": (lambda c: c.x + c.y > 1.25, 2),
    "corner": (lambda c: c.x + c.y + c.z > 1.45, 3),
    "side and more": (lambda c: c.z > 0.4, 4),
}


@pytest.mark.parametrize("quads", [False, True])
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("name", HOLES)
def test_islands_go_on_by_themselves(name: str, mirrored: bool, quads: bool) -> None:
    removed, islands = HOLES[name]
    obj = open_sphere(removed)
    box_map(obj, mirrored=mirrored)
    assert fill_hole(obj, quads=quads) == {"FINISHED"}
    used = set()
    for polygon in obj.data.polygons:
        if not polygon.select:
            continue
        rows = places(obj, polygon)
        assert np.ptp(rows, axis=0).max() < 0.1  # no face from island to island
        used.add(int(np.round(rows[:, 0].mean())))
        area = flat_area(rows) * (-1.0 if mirrored else 1.0)
        assert 0.4 < area / (SIZE**2 * polygon.area) < 2.5  # not turned over; about as much texture as around
    assert len(used) == islands
    assert bpy.context.window_manager.fairing_report.distortion < 0.1
    assert parted(obj)


def test_marked_seams_go_on(capfd: pytest.CaptureFixture[str]) -> None:
    for marked in (True, False):
        obj = open_sphere(HOLES["corner"][0])
        box_map(obj)
        before = mark_seams(obj) if marked else 0
        assert fill_hole(obj) == {"FINISHED"}
        new = parted(obj)
        seams = {tuple(sorted(edge.vertices)) for edge in obj.data.edges if edge.use_seam}
        assert len(seams) == (before + len(new) if marked else 0)
        assert new <= seams or not marked
        assert f"{len(new)} new edges are seams of UVs" in "".join(capfd.readouterr())


def test_what_lies_over_other_islands_is_told(capfd: pytest.CaptureFixture[str]) -> None:
    """Where all islands lie on one heap, and where each has its place."""
    for apart in (0.0, 1.0):
        obj = open_sphere(HOLES["edge"][0])
        box_map(obj, apart=apart)
        assert fill_hole(obj) == {"FINISHED"}
        assert ("over other faces in the texture" in "".join(capfd.readouterr())) == (apart == 0.0)


def test_each_map_has_seams_of_its_own() -> None:
    obj = open_sphere(HOLES["edge"][0])
    box_map(obj, "Box")
    points = meshes.positions(obj)[[loop.vertex_index for loop in obj.data.loops], 1:]
    obj.data.uv_layers.new(name="Plain").uv.foreach_set("vector", points.astype(np.float32).ravel())
    assert fill_hole(obj, quads=True) == {"FINISHED"}
    assert parted(obj, "Box")
    assert not parted(obj, "Plain")
    assert {len(polygon.vertices) for polygon in obj.data.polygons if polygon.select} == {3, 4}


def strip(obj: bpy.types.Object, upper: tuple[float, float] = (1.0, 0.0)) -> None:
    """Lay tubes out around their axis, cut at −x; those above z = 0 scaled and moved."""
    mesh = obj.data
    points = meshes.positions(obj)
    places = np.zeros((len(mesh.loops), 2))
    for polygon in mesh.polygons:
        middle = np.arctan2(polygon.center.y, polygon.center.x)
        for corner in polygon.loop_indices:
            x, y, z = points[mesh.loops[corner].vertex_index]
            turn = (np.arctan2(y, x) - middle + np.pi) % (2 * np.pi) - np.pi + middle
            row = np.array([turn, z])
            places[corner] = row * upper[0] + upper[1] if polygon.center.z > 0.0 else row
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", places.astype(np.float32).ravel())


@pytest.mark.parametrize("upper", [(1.0, 0.0), (0.5, 9.0)])
def test_a_bridge_between_cut_tubes(upper: tuple[float, float]) -> None:
    """One seam from end to end where both ends are of one island; a ring more where they are not."""
    obj = tubes()
    strip(obj, upper)
    assert fill_hole(obj, lambda co: abs(co.z) < 0.6, bridge=True) == {"FINISHED"}
    seams = parted(obj)
    heights = np.array([[obj.data.vertices[v].co.z for v in key] for key in seams])
    if upper[1] == 0.0:
        assert 4 <= len(seams) <= 8
        assert np.ptp(heights) == pytest.approx(1.0, abs=1e-5)
    else:
        assert len(seams) > 24
    assert bpy.context.window_manager.fairing_report.distortion < 0.05
    assert all(flat_area(places(obj, polygon)) > 0.0 for polygon in obj.data.polygons)


def test_a_scale_that_turns_inside_out_keeps_the_texture_as_it_is() -> None:
    obj = open_sphere(HOLES["edge"][0])
    box_map(obj)
    points = meshes.positions(obj)
    meshes.move(obj, points / (-1.0, 1.0, 1.0))
    obj.scale = (-1.0, 1.0, 1.0)
    assert fill_hole(obj) == {"FINISHED"}
    assert all(flat_area(places(obj, polygon)) > 0.0 for polygon in obj.data.polygons)
    assert bpy.context.window_manager.fairing_report.distortion < 0.1


def test_uvs_that_are_no_numbers_do_not_stop_it() -> None:
    obj = open_sphere(HOLES["edge"][0])
    box_map(obj)
    rim = next(loop for loop in obj.data.loops if obj.data.vertices[loop.vertex_index].co.z > 0.3)
    obj.data.uv_layers["Map"].uv[rim.index].vector = (float("nan"), 0.0)
    old = len(obj.data.loops)
    assert fill_hole(obj) == {"FINISHED"}
    uv = np.array([item.vector[:] for item in obj.data.uv_layers["Map"].uv])
    assert np.isfinite(uv[old:]).all()
