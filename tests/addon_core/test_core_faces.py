"""Triangles in pairs: the quads cover what the triangles did, and stay on one side of every border."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.lines import parting_edges
from addon.arrays.types import Floats, Ints
from addon.options.options import FairOptions
from addon.remesh.faces import Faces, paired_faces
from addon.remesh.remeshing import remesh_arrays

from polygon_mesh import grid, grid_points, grid_quads, on_sphere

SIZE = 6
NO_EDGES = np.empty((0, 2), dtype=np.int64)


def sheet() -> tuple[Floats, Ints]:
    """A flat grid; the diagonals of its quads run alike."""
    quads = np.array(grid_quads(SIZE))
    return grid_points(SIZE), quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def beneath(faces: Faces) -> list[set[int]]:
    """The triangles whose corners each face has."""
    ends = np.cumsum([len(polygon) for polygon in faces.polygons])
    return [set((corners // 3).tolist()) for corners in np.split(faces.corners, ends[:-1])]


def directed(polygons: list[list[int]]) -> set[tuple[int, int]]:
    return {(a, b) for polygon in polygons for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True)}


def test_every_pair_of_a_grid_becomes_its_quad_again() -> None:
    points, triangles = sheet()
    faces = paired_faces(points, triangles, NO_EDGES, np.zeros(len(triangles), dtype=np.int64))
    found = {frozenset(polygon) for polygon in faces.polygons}
    assert found == {frozenset(quad) for quad in grid_quads(SIZE)}
    assert directed(faces.polygons) <= directed(triangles.tolist())  # wound alike


def test_no_quad_has_two_kinds() -> None:
    points, triangles = sheet()
    kinds = np.arange(len(triangles)) // 2 % 2 + np.arange(len(triangles)) % 2  # mixed within the quads of the grid
    faces = paired_faces(points, triangles, NO_EDGES, kinds)
    assert all(len({int(kinds[t]) for t in of}) == 1 for of in beneath(faces))
    assert {len(polygon) for polygon in faces.polygons} == {3, 4}


def test_kept_edges_stay() -> None:
    points, triangles = sheet()
    diagonals = triangles[::2][:, [2, 0]]
    faces = paired_faces(points, triangles, diagonals, np.zeros(len(triangles), dtype=np.int64))
    sides = {tuple(sorted(side)) for side in directed(faces.polygons)}
    assert {tuple(sorted(edge)) for edge in diagonals.tolist()} <= sides
    assert 4 in {len(polygon) for polygon in faces.polygons}  # across other edges


@pytest.mark.parametrize("spacing", [0.7, 1.0])
def test_a_new_mesh_of_quads_stops_at_its_lines(spacing: float) -> None:
    size = 16
    mesh = grid(size, 0.6, on_sphere)
    rows = np.arange(len(mesh.in_patch)) // size
    values = (rows < size // 2).astype(np.float64)[mesh.corner_faces][:, None]
    mesh = replace(mesh, lines={"values": parting_edges(mesh, values)})
    done = remesh_arrays(mesh, np.eye(4), FairOptions(remesh=True, quads=True, spacing=spacing))
    faces = done.faces(np.zeros(len(done.part.triangles), dtype=np.int64))
    of = done.part.faces // size < size // 2
    assert all(len({bool(of[t]) for t in triangles}) == 1 for triangles in beneath(faces))
    quads = sum(len(polygon) == 4 for polygon in faces.polygons)
    assert quads > 0.4 * len(done.part.triangles)
    plain = remesh_arrays(mesh, np.eye(4), FairOptions(remesh=True, spacing=spacing))
    assert plain.faces(np.zeros(len(plain.part.triangles), dtype=np.int64)).polygons == plain.part.triangles.tolist()


def test_an_old_quad_does_not_come_again() -> None:
    """One with two sharp corners between lines: its two triangles stay, as a mesh can have a face only once."""
    size, own = 16, 8 * 16 + 7
    mesh = grid(
        size, 0.6, lambda points: on_sphere(points @ np.array([[1.0, 0.0, 0.0], [-0.7, 0.7, 0.0], [0.0, 0.0, 1.0]]))
    )
    alone = np.arange(len(mesh.in_patch)) == own
    mesh = replace(mesh, lines={"alone": parting_edges(mesh, alone.astype(np.float64)[mesh.corner_faces][:, None])})
    done = remesh_arrays(mesh, np.eye(4), FairOptions(remesh=True, quads=True))
    faces = done.faces(np.zeros(len(done.part.triangles), dtype=np.int64))
    corners = set(mesh.corner_vertices[mesh.corner_faces == own].tolist())
    stay = done.part.stay
    within = [polygon for polygon in faces.polygons if max(polygon) < len(stay) and {*stay[polygon]} <= corners]
    assert [len(polygon) for polygon in within] == [3, 3]
