"""A patch on a new mesh: the surface, where values come from, lines that stay. On a sphere, whose answer is itself."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from addon.arrays.lines import WIRES, edges_at_wires, inner_lines, parting_edges
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats, Ints, Mask
from addon.fair.engine import Problem
from addon.options.options import FairOptions
from addon.remesh import remeshing
from addon.remesh.faces import Faces, paired_faces
from addon.remesh.remeshing import Remeshed, remesh_arrays
from addon.verdict.verdict import GOOD, LOOK

import fairing
from polygon_mesh import grid, grid_points, grid_quads, on_sphere
from test_core_answer import EYE, spoilt_sphere

SIZE = 16


def remesh(mesh: MeshArrays, matrix: Floats = EYE, **options: object) -> Remeshed:
    return remesh_arrays(mesh, matrix, FairOptions(remesh=True, **options))


def all_points(mesh: MeshArrays, done: Remeshed) -> Floats:
    """Of the new part's r + k vertices."""
    moved = mesh.positions.copy()
    moved[done.vertices] = done.positions
    return np.concatenate([moved[done.part.stay], done.new_positions])


def seam(mesh: MeshArrays) -> Mask:
    """The (e,) mask of the edges on the middle row of vertices."""
    on_row: Mask = (mesh.edges // (SIZE + 1) == SIZE // 2).all(axis=1)
    return on_row


def sides(mesh: MeshArrays) -> Floats:
    """(c, 1): -1 at corners of faces before the middle row, 1 behind it."""
    rows = np.arange(len(mesh.in_patch)) // SIZE
    return np.where(rows < SIZE // 2, -1.0, 1.0)[mesh.corner_faces][:, None]


def test_values_come_from_where_the_new_vertices_lie() -> None:
    mesh = grid(SIZE, 0.6, on_sphere)
    done = remesh(mesh, spacing=0.7)
    carried = done.part.vertices.mean(mesh.positions)
    np.testing.assert_allclose(carried, done.new_positions, atol=0.02)
    corners = done.part.corners.mean(mesh.positions[mesh.corner_vertices])
    np.testing.assert_allclose(corners, all_points(mesh, done)[done.part.triangles.ravel()], atol=0.02)


def test_corners_take_values_of_their_own_side() -> None:
    mesh = spoilt_sphere()
    mesh = replace(mesh, lines={"side": parting_edges(mesh, sides(mesh))})
    assert np.array_equal(mesh.lines["side"], seam(mesh))
    done = remesh(mesh, spacing=0.7)
    assert len(done.vertices) == np.count_nonzero(seam(mesh) & inner_lines(mesh)) - 1
    carried = done.part.corners.mean(sides(mesh)).reshape(-1, 3)
    np.testing.assert_allclose(np.abs(carried), 1.0, atol=1e-12)
    carried = np.sign(carried)
    assert (carried == carried[:, :1]).all()  # one side for each face
    assert set(carried[:, 0]) == {-1.0, 1.0}
    rows = done.part.faces // SIZE
    assert np.array_equal(np.where(rows < SIZE // 2, -1.0, 1.0), carried[:, 0])


def test_nothing_but_lines_is_refused() -> None:
    every = np.ones(len(spoilt_sphere().edges), dtype=bool)
    mesh = replace(spoilt_sphere(), lines={"UVMap": every & False, "sharp_edge": every, "crease_edge": every & False})
    with pytest.raises(ValueError, match=r"\(\d+ for Mark Sharp\), too many to mesh anew"):
        remesh(mesh)


def test_a_seam_over_a_limb_that_is_gone_is_a_knot() -> None:
    """The old surface has a horn in the middle of the seam, which its edges climb."""
    mesh = grid(SIZE, 0.6, on_sphere)
    away = np.linalg.norm(mesh.positions[:, :2], axis=1)
    verdicts = []
    for height in (0.0, 3.0):
        horn = replace(mesh, positions=mesh.positions * (1.0 + height * np.exp(-30.0 * away**2))[:, None])
        verdicts.append(remesh(replace(horn, lines={"seam": seam(horn)})).verdict)
    assert [verdict.grade for verdict in verdicts] == [GOOD, LOOK]
    assert "bunch up" in verdicts[1].reason
    assert (away[verdicts[1].spots] < 0.3).all()
    assert remesh(replace(horn, lines={})).verdict.grade == GOOD


@pytest.mark.parametrize("spacing", [1.0, 4.0])
def test_warnings_name_the_mesh_that_was_solved(monkeypatch: pytest.MonkeyPatch, spacing: float) -> None:
    """The new one, also where its surface was found on a proxy mesh; the old one, if it was cut from it."""
    mesh = spoilt_sphere()
    solved = remeshing._solved

    def with_warning(problem: Problem, *rest: Any) -> fairing.RemeshResult:
        result = solved(problem, *rest)
        assert result.cut == (spacing > 1.0)
        count = len(problem.patch.vertices)
        last = count - 1 if result.cut else count + len(result.vertices) - 1
        reported = fairing.Diagnostic("PINS_NOT_SPREAD", "", np.array([last], np.int32), "vertex", {"tips": 1.0})
        return replace(result, polished=False, warnings=(reported,))

    monkeypatch.setattr(remeshing, "_solved", with_warning)
    verdict = remesh(mesh, spacing=spacing).verdict
    assert verdict.grade == LOOK
    assert np.isin(verdict.spots, mesh.corner_vertices[mesh.in_patch[mesh.corner_faces]]).all()


# Which edges a new mesh keeps for the sake of what hangs on them.
def hung_on(*vertices: int) -> object:
    """A grid of 8 × 8 quads, the inner 4 × 4 selected, with an edge without faces at each of these vertices."""
    mesh = grid(8, 0.5, lambda points: points * [1.0, 2.0, 1.0])
    count = len(mesh.positions)
    wires = [(vertex, count + k) for k, vertex in enumerate(vertices)]
    return replace(
        mesh,
        positions=np.concatenate([mesh.positions, np.ones((len(vertices), 3))]),
        edges=np.concatenate([mesh.edges, np.array(wires, dtype=np.int64).reshape(-1, 2)]),
        pinned=np.zeros(count + len(vertices), dtype=bool),
    )


def test_a_vertex_inside_is_kept_by_one_edge_of_the_patch() -> None:
    mesh = hung_on(4 * 9 + 4)
    found = np.flatnonzero(edges_at_wires(mesh))
    assert len(found) == 1
    assert 4 * 9 + 4 in mesh.edges[found[0]]
    assert found[0] in mesh.corner_edges
    kept = inner_lines(replace(mesh, lines={WIRES: edges_at_wires(mesh)}))
    assert np.array_equal(np.flatnonzero(kept), found)


def test_what_hangs_on_the_boundary_or_outside_needs_none() -> None:
    assert not edges_at_wires(hung_on()).any()
    assert not edges_at_wires(hung_on(2 * 9 + 4, 0)).any()


# Triangles in pairs: the quads cover what the triangles did, and stay on one side of every border.
SIZE_FACES = 6


NO_EDGES = np.empty((0, 2), dtype=np.int64)


def sheet() -> tuple[Floats, Ints]:
    """A flat grid; the diagonals of its quads run alike."""
    quads = np.array(grid_quads(SIZE_FACES))
    return grid_points(SIZE_FACES), quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def beneath(faces: Faces) -> list[set[int]]:
    """The triangles whose corners each face has."""
    ends = np.cumsum([len(polygon) for polygon in faces.polygons])
    return [set((corners // 3).tolist()) for corners in np.split(faces.corners, ends[:-1])]


def test_no_quad_has_two_kinds() -> None:
    points, triangles = sheet()
    kinds = np.arange(len(triangles)) // 2 % 2 + np.arange(len(triangles)) % 2  # mixed within the quads of the grid
    faces = paired_faces(points, triangles, NO_EDGES, kinds)
    assert all(len({int(kinds[t]) for t in of}) == 1 for of in beneath(faces))
    assert {len(polygon) for polygon in faces.polygons} == {3, 4}


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
