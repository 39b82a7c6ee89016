"""What holds inside a selection and around it: creases, smooth curves, pins, open borders, hard boundaries."""

from dataclasses import replace
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module


def box(size: int = 10) -> tuple[bpy.types.Object, meshes.Mask]:
    """Three sides of a box around one corner, its edges marked sharp; the faces within 0.6 of the corner."""
    steps = np.linspace(0.0, 1.0, size + 1)
    numbers: dict[tuple[float, ...], int] = {}
    faces = []
    for axis in range(3):
        for i in range(size):
            for j in range(size):
                face = []
                for u, v in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    point = np.roll([0.0, -steps[u], -steps[v]], axis)
                    face.append(numbers.setdefault(tuple(np.round(point, 9) + 0.0), len(numbers)))
                faces.append(face)
    obj = meshes.add(list(numbers), faces, "Box")
    flat = np.isclose(meshes.positions(obj), 0.0)
    sharp = [bool(flat[list(edge.vertices)].all(axis=0).sum() == 2) for edge in obj.data.edges]
    obj.data.edges.foreach_set("use_edge_sharp", sharp)
    return obj, meshes.faces_where(obj, lambda c: max(abs(x) for x in c) < 0.6)


def bumpy(obj: bpy.types.Object, free: meshes.Mask) -> np.ndarray:  # type: ignore[type-arg]
    points = meshes.positions(obj)
    points[free] += 0.02 * np.random.default_rng(1).normal(size=(int(free.sum()), 3))
    meshes.move(obj, points)
    return meshes.positions(obj)


def off_box(points: np.ndarray) -> float:  # type: ignore[type-arg]
    """Largest distance of a vertex to the nearest side."""
    return float(np.abs(points).min(axis=1).max())


@pytest.mark.parametrize("pins", ["AUTOMATIC", "SHARP"])
def test_dented_edges_that_run_through_become_straight(pins: str) -> None:
    """A box corner with noise everywhere inside, its edges and its tip among it; nothing outside moves."""
    obj, faces = box()
    exact = meshes.positions(obj)
    before = bumpy(obj, meshes.free_vertices(obj, faces))
    meshes.fair(obj, faces, pin_edges=pins)
    after = meshes.positions(obj)
    on_edge = np.isclose(exact, 0.0).sum(axis=1) >= 2
    assert np.sort(np.abs(before), axis=1)[on_edge, 1].max() > 0.01
    assert np.sort(np.abs(after), axis=1)[on_edge, 1].max() < 1e-6
    assert off_box(after) < 1e-5
    outside = ~meshes.free_vertices(obj, faces)
    assert after[outside].tobytes() == before[outside].tobytes()


def unmarked_box() -> tuple[bpy.types.Object, meshes.Mask]:
    obj, faces = box()
    obj.data.edges.foreach_set("use_edge_sharp", [False] * len(obj.data.edges))
    bumpy(obj, meshes.free_vertices(obj, faces))
    return obj, faces


def test_unmarked_edges_that_no_usable_surface_holds_are_let_go(monkeypatch: pytest.MonkeyPatch) -> None:
    """The solve with the edge is made to be not usable: the rounded one is written, and the report says why."""
    fair_arrays = module("fair.fair_arrays")
    solve = fair_arrays._faired

    def spoiled(mesh: Any, *given: Any) -> Any:
        found = solve(mesh, *given)
        bad = mesh.held_by_angle is not None
        return replace(found, verdict=replace(found.verdict, grade="UNUSABLE")) if bad else found

    monkeypatch.setattr(fair_arrays, "_faired", spoiled)
    obj, faces = unmarked_box()
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert off_box(meshes.positions(obj)) > 1e-3
    assert "were rounded off" in meshes.report().warnings


@pytest.mark.parametrize("faired", [False, True])
def test_an_open_border_moves_where_that_is_asked_for(faired: bool) -> None:
    """A rough plate, selected up to its right side."""
    obj = meshes.grid(12)
    right = np.isclose(meshes.positions(obj)[:, 0], 1.0)
    faces = meshes.faces_where(obj, lambda c: c.x > 0.3)
    before = bumpy(obj, meshes.positions(obj)[:, 0] > 0.4)
    meshes.fair(obj, faces, fair_open_borders=faired, allow_folds=True)
    assert (meshes.positions(obj)[right] != before[right]).any() == faired
