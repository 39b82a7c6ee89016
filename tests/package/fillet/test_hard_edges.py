"""`fairing.hard_edges`: where a surface is broken, whatever its triangles are."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import fairing
import solids
from solids import FloatArray, IntArray


def lengths(vertices: FloatArray, edges: IntArray) -> FloatArray:
    return np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)


@pytest.mark.parametrize("n", [1, 2, 3, 9])
def test_a_box_has_its_twelve_edges(n: int) -> None:
    vertices, triangles = solids.box(n)
    edges = fairing.hard_edges(vertices, triangles)
    assert len(edges) == 12 * n
    assert lengths(vertices, edges).sum() == pytest.approx(24.0)
    assert ((np.abs(vertices[edges].mean(axis=1)) > 1 - 1e-9).sum(axis=1) == 2).all()


@pytest.mark.parametrize("sides", [5, 6, 8, 12, 32])
@pytest.mark.parametrize(("rows", "height"), [(1, 0.2), (1, 10.0), (4, 2.0), (20, 2.0)])
def test_a_cylinder_has_its_two_rims(sides: int, rows: int, height: float) -> None:
    vertices, triangles = solids.cylinder(sides, rows, height)
    edges = fairing.hard_edges(vertices, triangles)
    assert len(edges) == 2 * sides
    assert np.ptp(vertices[edges][:, :, 2], axis=1).max() < 1e-9


@pytest.mark.parametrize(("meridians", "parallels"), [(4, 2), (5, 3), (8, 4), (12, 6), (32, 16)])
def test_a_sphere_has_none_however_coarse(meridians: int, parallels: int) -> None:
    assert len(fairing.hard_edges(*solids.sphere(meridians, parallels))) == 0


@pytest.mark.parametrize("amount", [0.05, 0.1, 0.2, 0.3])
def test_noise_has_next_to_none(amount: float) -> None:
    """A tenth of the edges bend by more than 35° from an amount of .15 edges on."""
    count = np.arange(1500) + 0.5
    polar, turn = np.arccos(1 - 2 * count / 1500), np.pi * (1 + 5**0.5) * count
    points = np.column_stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)])
    triangles = ConvexHull(points).simplices
    across = np.cross(
        points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
    )
    inwards = (across * points[triangles].mean(axis=1)).sum(axis=1) < 0
    triangles[inwards] = triangles[inwards][:, ::-1]
    edge = lengths(points, triangles[:, :2]).mean()
    noisy = points + amount * edge * np.random.default_rng(1).normal(size=points.shape)
    assert len(fairing.hard_edges(noisy, triangles)) <= 0.002 * 1.5 * len(triangles)


def bent_sheet(columns: int, degrees: FloatArray) -> tuple[FloatArray, IntArray]:
    """A sheet of 8 × columns quads of width 1 whose halves meet in the middle at an angle of its own at each column."""
    v, u = (x.ravel() for x in np.meshgrid(np.arange(-4.0, 5.0), np.arange(columns + 1.0), indexing="ij"))
    bent = np.radians(np.interp(u, np.arange(columns + 1.0), degrees)) * (v > 0)
    vertices = np.column_stack([u, v * np.cos(bent), -v * np.sin(bent)])
    number = np.arange(9 * (columns + 1)).reshape(9, columns + 1)
    a, b, c, d = (x.ravel() for x in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]))
    return vertices, np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def test_an_edge_runs_on_where_it_fades() -> None:
    vertices, triangles = bent_sheet(24, np.linspace(60.0, 0.0, 25))
    edges = fairing.hard_edges(vertices, triangles)
    middle = vertices[edges].mean(axis=1)
    assert (np.abs(vertices[edges][:, :, 1]) < 1e-9).all()
    # 35° after ten columns, 17.5° after seventeen
    assert sorted(middle[:, 0]) == list(np.arange(len(edges)) + 0.5)
    assert 14 <= len(edges) <= 18
    weak = bent_sheet(24, np.linspace(30.0, 0.0, 25))
    assert len(fairing.hard_edges(*weak)) == 0


def test_a_crease_between_two_rows_is_found() -> None:
    """35° and more over three rows: each of the two rows bends by less."""
    vertices, triangles = bent_sheet(12, np.full(13, 0.0))
    v = vertices[:, 1]
    vertices[:, 2] = -np.maximum(v - 0.5, 0.0)
    edges = fairing.hard_edges(vertices, triangles)
    assert len(edges) == 2 * 12
    assert set(vertices[edges][:, :, 1].ravel()) == {0.0, 1.0}


@pytest.mark.parametrize(("sharp_columns", "found"), [(2, 0), (4, 5)])
def test_fewer_than_four_edges_within_a_smooth_surface_are_no_chain(sharp_columns: int, found: int) -> None:
    degrees = np.zeros(25)
    degrees[10 : 10 + sharp_columns] = 60.0
    vertices, triangles = bent_sheet(24, degrees)
    assert len(fairing.hard_edges(vertices * [40.0, 1.0, 1.0], triangles)) == found


@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize("stroke", [0.05, 0.3])
def test_strokes_on_a_plate_have_all_their_edges(stroke: float, rows: int) -> None:
    """Without vertices in their faces, as CAD makes them: half of the edges around one bend to the other side."""
    profile = np.array([[0.0, 0.0], [1, 0], [1, 0.2], [1 + stroke, 0.2], [1 + stroke, 0], [2, 0]])
    y = np.linspace(0, 2, rows + 1)
    vertices = np.array([[x, b, z] for x, z in profile for b in y])
    k = np.array([i * (rows + 1) + j for i in range(len(profile) - 1) for j in range(rows)])
    above = k + rows + 1
    triangles = np.concatenate([np.column_stack([k, above, above + 1]), np.column_stack([k, above + 1, k + 1])])
    lines = np.array([[i * (rows + 1) + j, i * (rows + 1) + j + 1] for i in range(1, 5) for j in range(rows)])
    assert fairing.hard_edges(vertices, triangles).tolist() == lines.tolist()


@pytest.mark.parametrize(("n", "waves"), [(8, 7.0), (16, 11.0)])
def test_plane_quads_of_a_rough_grid_are_no_faces_of_a_solid(n: int, waves: float) -> None:
    """z = f(x) + g(y) makes every quad plane, and rows bend by up to 50° to one side and the other in turns."""
    x, y = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    vertices = np.stack([x, y, 0.2 * np.cos(2 * x) + 0.1 * np.sin(waves * y)], axis=-1).reshape(-1, 3)
    k = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.concatenate([np.column_stack([k, k + n + 1, k + n + 2]), np.column_stack([k, k + n + 2, k + 1])])
    assert len(fairing.hard_edges(vertices, triangles)) == 0


def test_marked_edges_are_hard_whatever_they_bend() -> None:
    vertices, triangles = bent_sheet(6, np.full(7, 2.0))
    row = [4 * 7 + 2, 4 * 7 + 3]
    no_edge = [0, 30]
    assert fairing.hard_edges(vertices, triangles, marked=[row[::-1], no_edge]).tolist() == [row]


def test_bad_triangles_are_left_out() -> None:
    vertices, triangles = solids.box(2)
    expected = fairing.hard_edges(vertices, triangles).tolist()
    worse = np.concatenate([vertices, [[np.nan, 0.0, 0.0]]])
    more = np.concatenate([triangles, [[0, 0, 1], [0, 1, len(vertices)]]])
    assert fairing.hard_edges(worse, more).tolist() == expected
    assert len(fairing.hard_edges(vertices, np.empty((0, 3), dtype=int))) == 0
    with pytest.raises(ValueError, match="marked: shape"):
        fairing.hard_edges(vertices, triangles, marked=[1, 2, 3])
    with pytest.raises(ValueError, match="marked: row 0 names vertex 99"):
        fairing.hard_edges(vertices, triangles, marked=[[0, 99]])
