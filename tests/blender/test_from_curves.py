"""Fair From Curves in Blender: faces over edges that have none, and nothing else about the mesh changes."""

from itertools import pairwise
from typing import Any

import bpy
import numpy as np
import pytest

import meshes


def wired(lines: list[Any], name: str = "Wires") -> bpy.types.Object:
    """Polylines; points in one place are one vertex."""
    numbers: dict[tuple[float, ...], int] = {}
    edges: set[tuple[int, int]] = set()
    for line in lines:
        at = [numbers.setdefault(tuple(np.round(point, 6) + 0.0), len(numbers)) for point in line]
        edges |= {(min(a, b), max(a, b)) for a, b in pairwise(at) if a != b}
    return meshes.add(list(numbers), [], name, sorted(edges))


def circles(count: int = 32) -> list[Any]:
    angles = 2.0 * np.pi * np.arange(count + 1) / count
    a, b, nought = np.cos(angles), np.sin(angles), 0.0 * angles
    return [np.stack(ring, axis=1) for ring in ((a, b, nought), (nought, a, b), (b, nought, a))]


def tube(count: int = 32) -> list[Any]:
    angles = 2.0 * np.pi * np.arange(count + 1) / count
    rings = [np.stack([np.cos(angles), np.sin(angles), 0.0 * angles + z], axis=1) for z in (0.0, 2.0)]
    lines = [np.linspace(*(ring[8 * k] for ring in rings), 9) for k in range(4)]
    return [*rings, *lines]


def run(obj: bpy.types.Object, chosen: Any = lambda edge: True, **properties: Any) -> set[str]:
    """Run it from and to object mode with these edges selected."""
    meshes.select_edges(obj, chosen)
    try:
        status: set[str] = bpy.ops.mesh.fair_from_curves("EXEC_DEFAULT", True, **properties)
        return status
    finally:
        meshes.leave()


def test_openings_stay_or_are_filled() -> None:
    obj = wired(tube())
    assert run(obj) == {"FINISHED"}
    with meshes.rebuilt(obj, write=False) as bm:
        assert sum(edge.is_boundary for edge in bm.edges) == 64
    assert np.abs(np.hypot(*meshes.positions(obj)[:, :2].T) - 1.0).max() < 1e-5
    closed = wired(tube())
    assert run(closed, fill_openings=True) == {"FINISHED"}
    with meshes.rebuilt(closed, write=False) as bm:
        assert all(edge.is_manifold for edge in bm.edges)
        assert bm.calc_volume() == pytest.approx(2.0 * np.pi, rel=0.02)
        assert sum(not edge.smooth for edge in bm.edges) == 64  # the rims


def test_edges_marked_sharp_are_creases() -> None:
    """A roof of two planes."""
    ridge = [(0.0, 0.25 * k, 1.0) for k in range(9)]
    lines: list[Any] = [ridge]
    for side in (-1.0, 1.0):
        eaves = [(side, 0.25 * k, 0.0) for k in range(9)]
        lines += [eaves, *(np.linspace(ridge[k], eaves[k], 6) for k in (0, 8))]
    obj = wired(lines)
    for edge in obj.data.edges:
        edge.use_edge_sharp = all(obj.data.vertices[v].co.z > 0.999 for v in edge.vertices)
    assert run(obj) == {"FINISHED"}
    x, _, z = meshes.positions(obj).T
    assert np.abs(z - 1.0 + np.abs(x)).max() < 1e-5


def test_an_open_end_is_shown() -> None:
    obj = wired([*circles(), [(1.0, 0.0, 0.0), (2.0, 0.0, 0.0)]])
    with pytest.raises(RuntimeError, match="A curve of edges ends"):
        run(obj)
    meshes.edit(obj)
    assert bpy.ops.mesh.fair_select(what="SPOTS") == {"FINISHED"}
    meshes.leave()
    assert [vertex.co.x for vertex in obj.data.vertices if vertex.select] == [2.0]


def test_fair_fill_says_what_is_for_wires() -> None:
    obj = wired(circles())
    meshes.enter(obj, np.zeros(0, dtype=bool))
    bpy.ops.mesh.select_all(action="SELECT")
    with pytest.raises(RuntimeError, match="Fair From Curves"):
        bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True)
