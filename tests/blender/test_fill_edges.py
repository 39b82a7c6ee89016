"""Fair Fill over hard edges: they run on, drawn edges are taken, marks go on."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import bpy
import numpy as np

import meshes
from extension import module

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


def test_other_keys_carry_the_edge_along() -> None:
    """A key that lifts everything by one unit lifts the new vertices as much; the edge is in it, too."""
    obj = box_edge(marked=True)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Up")
    for point in key.data:
        point.co.z += 1.0 + 0.3 * point.co.y
    fill(obj)
    base, up = (np.array([p.co[:] for p in obj.data.shape_keys.key_blocks[k].data]) for k in (0, 1))
    lifted = up - base
    assert np.abs(lifted[:, :2]).max() < 1e-6
    assert np.abs(lifted[:, 2] - 1.0 - 0.3 * base[:, 1]).max() < 1e-2
