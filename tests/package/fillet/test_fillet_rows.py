"""fairing.fillet with quads: rows run along the seams, and edges outside go on across them."""

from collections import Counter

import numpy as np
import pytest

import fairing
import holes
import measures
import solids
import wedges
from fairing import _core
from measures import areas, with_new
from wedges import FloatArray, IntArray

WIDTH = 0.3
ROWS = 8  # by default


def sides_of(faces: IntArray) -> IntArray:
    return np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)


def without_diagonals(vertices: FloatArray, triangles: IntArray, axes: int = 1) -> IntArray:
    """The edges that are parallel to axes, or lie in a plane of two of them."""
    edges = measures.edges(triangles)
    along = np.abs(vertices[edges[:, 0]] - vertices[edges[:, 1]]) > 1e-9
    return edges[along.sum(axis=1) <= axes]


def valences(result: fairing.results.FilletResult) -> Counter[int]:
    """How many inner vertices have so many quads."""
    assert result.quads is not None
    sides = {(a, b) for a, b in sides_of(result.quads.quads).tolist()}
    border = {v for a, b in sides if (b, a) not in sides for v in (a, b)}
    around = Counter(result.quads.quads.ravel().tolist())
    return Counter(count for vertex, count in around.items() if vertex not in border)


def check_closed(vertices: FloatArray, triangles: IntArray, result: fairing.results.FilletResult) -> None:
    """The mesh with its fillet is closed, as it was, and only quads are new."""
    assert result.quads is not None
    assert len(result.quads.triangles) == result.outside  # the pieces of cut triangles
    points, faces = with_new(vertices, triangles, result)
    assert fairing.boundary_loops(faces) == []
    assert measures.euler_number(faces) == 2
    new = holes.angles(points, result.quads.quads)
    assert ((new > 50) & (new < 130)).mean() >= 0.95


@pytest.mark.parametrize("rows", [1, 7])
@pytest.mark.parametrize("degrees", [60, 90, 120, 150])
def test_between_planes_the_rows_are_on_the_arc(degrees: float, rows: int) -> None:
    vertices, triangles, seam = wedges.wedge(degrees, rows=rows)
    result = fairing.fillet(
        vertices, triangles, seam, width=WIDTH, faces="quads", neighbours=without_diagonals(vertices, triangles, 2)
    )
    centre, radius = wedges.arc(degrees, WIDTH)
    places = result.vertices[np.abs(result.vertices[:, 2]) < 0.7]
    assert (result.converged, result.warnings) == (True, ())
    assert len(places) >= ROWS + 1
    assert abs(np.linalg.norm(places[:, :2] - centre, axis=1) - radius).max() < 1e-3 * WIDTH
    assert valences(result) == Counter({4: sum(valences(result).values())})


def test_a_ring_has_a_column_for_each_edge_that_comes_to_it() -> None:
    """24 edges of a cylinder's wall; those of its lids go to the middle. Nothing else meets the line."""
    count = 24
    vertices, triangles = solids.cylinder(count, 5, 2.0)
    edges = measures.edges(triangles)
    turn = np.arctan2(vertices[:, 1], vertices[:, 0])
    way = np.abs(np.angle(np.exp(1j * (turn[edges[:, 0]] - turn[edges[:, 1]]))))
    flat = vertices[edges[:, 0], 2] == vertices[edges[:, 1], 2]
    centre = (np.linalg.norm(vertices[edges][:, :, :2], axis=2) < 1e-9).any(axis=1)
    result = fairing.fillet(
        vertices, triangles, width=0.25, faces="quads", neighbours=edges[flat | (way < 1e-9) | centre]
    )
    assert result.quads is not None
    assert len(result.quads.quads) == 2 * count * ROWS
    check_closed(vertices, triangles, result)
    spokes = np.angle(np.exp(1j * count * np.arctan2(result.vertices[:, 1], result.vertices[:, 0]))) / count
    assert abs(spokes * np.linalg.norm(result.vertices[:, :2], axis=1)).max() < 2e-3
    off = _distances(result, fairing.fillet(vertices, triangles, width=0.25, spacing=0.25 / 8), vertices)
    assert abs(off).max() < 1e-3 * 2**1.5


def _distances(
    rows: fairing.results.FilletResult, triangles: fairing.results.FilletResult, vertices: FloatArray
) -> FloatArray:
    """Of new vertices from the fillet of triangles."""
    points = np.concatenate([vertices, triangles.vertices])
    return _core.signed_distances(rows.vertices, points, triangles.triangles[triangles.outside :])


@pytest.mark.parametrize("count", [1, 3])
def test_a_box_gets_a_pole_at_each_corner_and_keeps_its_loops(count: int) -> None:
    vertices, triangles = solids.box(count)
    counted = without_diagonals(vertices, triangles)
    result = fairing.fillet(vertices, triangles, width=0.2, faces="quads", neighbours=counted)
    assert result.quads is not None
    assert result.warnings == ()
    assert len(result.quads.quads) == 12 * count * ROWS + 8 * 3 * (ROWS // 2) ** 2
    assert valences(result)[3] == 8
    assert set(valences(result)) == {3, 4}
    check_closed(vertices, triangles, result)
    points = np.concatenate([vertices, result.vertices])
    on_line = np.unique(result.line)
    across = np.sort(np.abs(points[on_line]), axis=1)
    assert abs(across[:, 2] - 1).max() < 1e-12
    assert abs(across[:, 1] - 0.8).max() < 1e-12
    marks = np.append(np.linspace(-1, 1, count + 1)[1:-1], [-0.8, 0.8])  # edges of the grid, and corners
    assert abs(across[:, 0][:, None] - np.abs(marks)).min(axis=1).max() < 1e-12
    triangulated = fairing.fillet(vertices, triangles, width=0.2, spacing=0.025)
    assert abs(_distances(result, triangulated, vertices)).max() < 1e-3 * np.sqrt(12)


def test_a_seam_that_fades_out_has_rows_between_triangles() -> None:
    vertices, triangles = solids.box(4)
    counted = without_diagonals(vertices, triangles)
    on_edge = (np.abs(vertices[:, :2] - 1) < 1e-9).all(axis=1) & (np.abs(vertices[:, 2]) < 0.6)
    seam = counted[on_edge[counted].all(axis=1)]
    result = fairing.fillet(vertices, triangles, seam, width=0.25, faces="quads", neighbours=counted)
    assert "NO_QUAD_ROWS" not in [warning.code for warning in result.warnings]
    assert result.quads is not None
    assert len(result.quads.quads) >= 2 * ROWS
    assert len(result.quads.triangles) > result.outside
    points, faces = with_new(vertices, triangles, result)
    assert fairing.boundary_loops(faces) == []
    assert len(fairing.self_intersections(points, faces)) == 0
    new = holes.angles(points, result.quads.quads)
    assert ((new > 50) & (new < 130)).mean() >= 0.95


def test_diagonals_get_no_vertices() -> None:
    """Where they cross the line, the pieces outside are meshed anew."""
    vertices, triangles, seam = wedges.wedge(90, rows=3)
    counted = without_diagonals(vertices, triangles, 2)
    edges = measures.edges(triangles)
    diagonals = edges[~(edges[:, None] == counted).all(axis=2).any(axis=1)]
    start, way = vertices[diagonals[:, 0]], vertices[diagonals[:, 1]] - vertices[diagonals[:, 0]]
    crossings = []
    for edges_that_count in (counted, None):
        result = fairing.fillet(vertices, triangles, seam, width=WIDTH, faces="quads", neighbours=edges_that_count)
        points, faces = with_new(vertices, triangles, result)
        off = np.linalg.norm(np.cross(points[np.unique(result.line)][:, None] - start, way), axis=2)
        crossings.append((off < 1e-9).any(axis=1).sum())
        assert areas(points, result.triangles[: result.outside]).min() > 1e-6
        assert fairing.boundary_loops(faces) == []
        outside = np.concatenate([np.delete(triangles, result.gone, axis=0), result.triangles[: result.outside]])
        assert (
            abs(areas(points, outside).sum() - 4 * (2 * (1 - WIDTH) + np.sqrt(2)) - 2 * 0.5) < 1e-9
        )  # the sides, and both ends
    assert crossings == [0, 6]


def test_vertices_of_the_middle_row_come_from_the_seam() -> None:
    vertices, triangles, seam = wedges.wedge(100, rows=4)
    result = fairing.fillet(
        vertices, triangles, seam, width=WIDTH, faces="quads", neighbours=without_diagonals(vertices, triangles, 2)
    )
    triangle, weights = result.origin
    assert weights.min() >= 0
    carried = np.einsum("kc,kcd->kd", weights, vertices[triangles[triangle]])
    centre, _ = wedges.arc(100, WIDTH)
    turn = np.arctan2(result.vertices[:, 0], result.vertices[:, 1] - centre[1])
    near = np.abs(result.vertices[:, 2]) < 1.5
    middle = near & (np.abs(turn) < 1e-2)
    assert middle.sum() >= 3
    assert abs(carried[middle, :2]).max() == 0.0
    right = near & (turn > 1e-2)
    assert (carried[right, 0] > 0).all()
    assert np.linalg.norm(carried - result.vertices, axis=1).max() < 0.4 * WIDTH  # the seam is 0.36 above the arc


def test_where_fillets_run_into_each_other_triangles_stay_and_that_is_said() -> None:
    """The seams of a wall thinner than two widths: the part between them is gone, and with it a side of each."""
    vertices, triangles = solids.box(4)
    vertices = vertices * [1.0, 1.0, 0.15]
    counted = without_diagonals(vertices, triangles)
    hard = fairing.hard_edges(vertices, triangles)
    flat = vertices[hard[:, 0], 2] == vertices[hard[:, 1], 2]
    result = fairing.fillet(
        vertices, triangles, hard[flat], walls=hard[~flat], width=0.2, faces="quads", neighbours=counted
    )
    (warning,) = [warning for warning in result.warnings if warning.code == "NO_QUAD_ROWS"]
    assert warning.figures["seams"] == 1.0
    assert result.quads is not None
    assert len(result.quads.quads) == 0
    _, faces = with_new(vertices, triangles, result)
    assert fairing.boundary_loops(faces) == []
