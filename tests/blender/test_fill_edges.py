"""Fair Fill over hard edges, in rows of quads, over seams of UVs: each goes on."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module
from test_fill import Chosen, fill_hole, open_sphere

SIZE = 12


def box_edge(*, marked: bool = False, wire: Sequence[tuple[float, float, float]] = ()) -> bpy.types.Object:
    """The faces z = 0 and x = 0 of a box with a square hole over their edge; a wire across it through these places."""
    s, t = np.meshgrid(np.arange(2 * SIZE + 1) / SIZE - 1.0, np.arange(SIZE + 1) / SIZE, indexing="ij")
    points = np.column_stack([np.minimum(s, 0).ravel(), t.ravel(), -np.maximum(s, 0).ravel()])
    number = np.arange(points.shape[0]).reshape(s.shape)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=-1).reshape(-1, 4)
    centres = np.stack([s, t], axis=-1).reshape(-1, 2)[quads].mean(axis=1)
    kept = quads[np.abs(centres - [0.0, 0.5]).max(axis=1) > 0.26]
    used, kept = np.unique(kept, return_inverse=True)
    places = points[used].tolist()
    ends = [k for k, p in enumerate(places) if p[0] == 0.0 == p[2] and abs(p[1] - 0.5) < 0.26]
    chain = [ends[0], *range(len(places), len(places) + len(wire)), ends[-1]]
    obj = meshes.add(places + [list(place) for place in wire], kept.reshape(-1, 4).tolist(), "Box")
    mesh = obj.data
    if wire:
        first = len(mesh.edges)
        mesh.edges.add(len(chain) - 1)
        for k, pair in enumerate(pairwise(chain)):
            mesh.edges[first + k].vertices = pair
    for edge in mesh.edges:
        a, b = (mesh.vertices[v].co for v in edge.vertices)
        edge.use_edge_sharp = marked and max(abs(a.x), abs(a.z), abs(b.x), abs(b.z)) < 1e-6
    return obj


def fill(obj: bpy.types.Object, **properties: Any) -> Any:
    mesh = obj.data
    rim = [v.index for v in mesh.vertices if max(abs(v.co.x), abs(v.co.z), abs(v.co.y - 0.5)) < 0.26]
    (result,) = module().fill_mesh(mesh, rim, **properties)
    return result


def off_the_faces(obj: bpy.types.Object) -> float:
    places = np.array([v.co[:] for v in obj.data.vertices])
    return float(np.minimum(np.abs(places[:, 0]), np.abs(places[:, 2])).max())


def sharp_edges(obj: bpy.types.Object) -> list[Any]:
    return [edge for edge in obj.data.edges if edge.use_edge_sharp]


def test_an_edge_runs_on_and_its_mark_too() -> None:
    obj = box_edge(marked=True)
    before = len(sharp_edges(obj))
    fill(obj)
    assert off_the_faces(obj) < 1e-6
    marked = sharp_edges(obj)
    ends = np.array([[obj.data.vertices[v].co[:] for v in edge.vertices] for edge in marked])
    assert np.abs(ends[:, :, [0, 2]]).max() < 1e-6
    assert abs(np.abs(np.diff(ends[:, :, 1], axis=1)).sum() - 1.0) < 1e-6
    assert len(marked) > before
    soft = box_edge()
    fill(soft)
    assert off_the_faces(soft) < 1e-6
    assert not sharp_edges(soft)
    rounded = box_edge()
    fill(rounded, run_on=False, allow_folds=True)
    assert off_the_faces(rounded) > 0.02


def test_a_drawn_edge_is_taken_with_its_own_vertices() -> None:
    """No vertex lies twice, no edge is left without faces, and the wire's vertex stays where it was drawn."""
    obj = box_edge(wire=[(0.0, 0.5, 0.05)])
    count = len(obj.data.vertices)
    fill(obj)
    mesh = obj.data
    assert mesh.vertices[count - 1].co[:] == (0.0, 0.5, np.float32(0.05))
    uses = np.zeros(len(mesh.edges), dtype=int)
    for loop in mesh.loops:
        uses[loop.edge_index] += 1
    places = np.array([v.co[:] for v in mesh.vertices])
    at_hole = (np.abs(places[:, 1] - 0.5) < 0.3) & (np.abs(places[:, [0, 2]]).max(axis=1) < 0.3)
    inner = [k for k, e in enumerate(mesh.edges) if at_hole[list(e.vertices)].all()]
    assert set(uses[inner].tolist()) == {2}
    assert (count - 1) in {v for polygon in mesh.polygons for v in polygon.vertices}
    distances = np.linalg.norm(places[:, None] - places[None], axis=2) + np.eye(len(places))
    assert distances.min() > 1e-3
    assert mesh.validate(verbose=True) is False


# Fair Fill over seams of UVs: each island goes on by itself, with its scale and its turn; seams go on with it.
Floats = meshes.Floats


SIZE_UVS = 0.25  # of an island, whose centres lie at 1, 2, 3, …


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
            places[corner] = SIZE_UVS * angles * ([-1.0, 1.0] if mirrored else [1.0, 1.0])
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
