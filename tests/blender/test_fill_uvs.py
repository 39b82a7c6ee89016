"""Fair Fill over seams of UVs: each island goes on by itself, with its scale and its turn; seams go on with it."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from test_fill import Chosen, fill_hole, open_sphere

Floats = meshes.Floats
SIZE = 0.25  # of an island, whose centres lie at 1, 2, 3, …


def box_map(obj: bpy.types.Object, name: str = "Map", mirrored: bool = False) -> None:
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
            places[corner] += [2.0 * axis + (sign > 0), 0.0]
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


def test_each_map_has_seams_of_its_own() -> None:
    obj = open_sphere(HOLES["edge"][0])
    box_map(obj, "Box")
    points = meshes.positions(obj)[[loop.vertex_index for loop in obj.data.loops], 1:]
    obj.data.uv_layers.new(name="Plain").uv.foreach_set("vector", points.astype(np.float32).ravel())
    assert fill_hole(obj, quads=True) == {"FINISHED"}
    assert parted(obj, "Box")
    assert not parted(obj, "Plain")
    assert {len(polygon.vertices) for polygon in obj.data.polygons if polygon.select} == {4}
