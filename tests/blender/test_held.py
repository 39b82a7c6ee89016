"""What holds inside a selection: creases, smooth curves, pins with a radius, open borders."""

from __future__ import annotations

import bpy
import meshes
import numpy as np
import pytest


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


@pytest.mark.parametrize(("slope", "flat"), [("AUTOMATIC", True), ("CREASE", True), ("AVERAGE", False)])
def test_a_box_corner_with_sharp_edges_comes_back_flat(slope: str, flat: bool) -> None:
    obj, faces = box()
    on_edge = np.isclose(meshes.positions(obj), 0.0).sum(axis=1) >= 2
    before = bumpy(obj, meshes.free_vertices(obj, faces) & ~on_edge)
    assert off_box(before) > 0.01
    meshes.fair(obj, faces, pin_edges="SHARP", pin_slope=slope)
    after = meshes.positions(obj)
    assert after[on_edge].tobytes() == before[on_edge].tobytes()
    assert (off_box(after) < 1e-5) == flat


def test_sharp_edges_along_the_outline_are_creases_too() -> None:
    """A part of one side, up to two sharp edges: flat, whatever the sides around it are."""
    obj, _ = box()
    faces = meshes.faces_where(obj, lambda c: abs(c.x) < 1e-6 and max(abs(c.y), abs(c.z)) < 0.6)
    free = meshes.free_vertices(obj, faces)
    bumpy(obj, free)
    meshes.fair(obj, faces, pin_edges="SHARP")
    assert np.abs(meshes.positions(obj)[free, 0]).max() < 1e-5


def test_the_surface_runs_smoothly_through_a_lifted_curve() -> None:
    obj = meshes.grid(16)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.8)
    points = meshes.positions(obj)
    curve = (np.abs(points[:, 0]) < 1e-6) & (np.abs(points[:, 1]) < 0.4)
    points[curve, 2] = 0.125
    meshes.move(obj, points)
    seam = [bool(curve[list(edge.vertices)].all()) for edge in obj.data.edges]
    obj.data.edges.foreach_set("use_seam", seam)
    meshes.fair(obj, faces, pin_edges="SEAM", pin_slope="SMOOTH")
    after = meshes.positions(obj)
    assert after[curve].tobytes() == meshes.positions(obj)[curve].tobytes()
    left = np.isclose(points[:, 0], -0.125) & np.isclose(points[:, 1], 0.0)
    right = np.isclose(points[:, 0], 0.125) & np.isclose(points[:, 1], 0.0)
    assert 0.1 < after[left, 2][0] < 0.13
    assert after[left, 2][0] == pytest.approx(after[right, 2][0], abs=5e-3)


def test_a_pin_lifts_more_with_a_radius() -> None:
    heights = []
    for radius in (0.0, 0.1):
        obj = meshes.grid(24)
        faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.8)
        points = meshes.positions(obj)
        centre = int(np.argmin(np.linalg.norm(points, axis=1)))
        points[centre, 2] = 0.25
        meshes.move(obj, points)
        obj.vertex_groups.new(name="Pin").add([centre], 1.0, "REPLACE")
        meshes.fair(obj, faces, pin_group="Pin", pin_radius=radius)
        after = meshes.positions(obj)
        assert after[centre].tobytes() == points[centre].astype(np.float32).astype(np.float64).tobytes()
        heights.append(after[np.linalg.norm(after[:, :2] - after[centre, :2], axis=1) < 0.13, 2].min())
    assert heights[1] > 1.02 * heights[0]


@pytest.mark.parametrize("border", ["HELD", "FAIRED"])
def test_a_noisy_open_border(border: str) -> None:
    """A strip of a cylinder, selected up to its open border."""
    rows, columns = 12, 40
    angle = 2 * np.pi * np.arange(columns) / columns
    height = 0.15 * np.arange(rows)
    points = [(np.cos(a), np.sin(a), h) for h in height for a in angle]
    faces = [
        (columns * r + c, columns * r + (c + 1) % columns, columns * (r + 1) + (c + 1) % columns, columns * (r + 1) + c)
        for r in range(rows - 1)
        for c in range(columns)
    ]
    obj = meshes.add(points, faces, "Strip")
    selected = meshes.faces_where(obj, lambda c: c.z > 0.7)
    heights = meshes.positions(obj)[:, 2]
    moving = heights > 0.8
    top = np.isclose(heights, height[-1])
    before = bumpy(obj, moving)
    meshes.fair(obj, selected, open_border=border)
    after = meshes.positions(obj)
    off = np.abs(np.linalg.norm(after[:, :2], axis=1) - 1.0)
    if border == "HELD":
        assert after[top].tobytes() == before[top].tobytes()
    else:
        assert off.max() < 1e-4
        assert after[top, 2].std() < 0.6 * before[top, 2].std()
    assert after[~moving].tobytes() == before[~moving].tobytes()
