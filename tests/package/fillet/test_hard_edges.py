"""Hard edges: which there are, which run through a patch, and what they are when they are fair."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import creased
import fairing
import holes
import measures
import solids
from grids import halves, numbered
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


def test_a_notched_wedge_has_its_convex_edges() -> None:
    """As booleans leave it: edges that end at corners of two, and triangles of all shapes."""
    places = np.array([int(digit, 13) for digit in "000010309319810814c00870874c70"], dtype=float).reshape(-1, 3)
    faces = np.array([int(v) for v in "014021062231253046265647956967985978415513457758"]).reshape(-1, 3)
    assert len(fairing.hard_edges(places, faces)) == 14


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
    return vertices, halves(numbered(9, columns + 1))[:, ::-1]


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
    triangles = halves(numbered(len(profile), rows + 1))
    lines = np.array([[i * (rows + 1) + j, i * (rows + 1) + j + 1] for i in range(1, 5) for j in range(rows)])
    assert fairing.hard_edges(vertices, triangles).tolist() == lines.tolist()


@pytest.mark.parametrize(("n", "waves"), [(8, 7.0), (16, 11.0)])
def test_plane_quads_of_a_rough_grid_are_no_faces_of_a_solid(n: int, waves: float) -> None:
    """z = f(x) + g(y) makes every quad plane, and rows bend by up to 50° to one side and the other in turns."""
    x, y = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    vertices = np.stack([x, y, 0.2 * np.cos(2 * x) + 0.1 * np.sin(waves * y)], axis=-1).reshape(-1, 3)
    assert len(fairing.hard_edges(vertices, halves(numbered(n + 1, n + 1)))) == 0


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


# Hard edges that run on through a patch are found by their angle, along edges of its own.
Through = tuple[creased.Creased, IntArray, IntArray, IntArray]


def patch_of(exact: creased.Creased, centre: tuple[float, ...], radius: float) -> Through:
    """A surface, the triangles in a ball and the others, and all edges (h, 2) at which two sides meet."""
    inside = (np.linalg.norm(exact.vertices - centre, axis=1) < radius)[exact.triangles].all(axis=1)
    edges = measures.edges(exact.triangles)
    on = np.array([side(exact.vertices) < 1e-9 for side in exact.distances])
    hard = edges[np.count_nonzero(on[:, edges].all(axis=2), axis=0) > 1]
    return exact, exact.triangles[inside], exact.triangles[~inside], hard


def box_edge() -> Through:
    return patch_of(creased.box_edge(14, 1), (0.0, 0.5, 0.0), 0.3)


def box_corner() -> Through:
    return patch_of(creased.box_corner(12, 2), (0.0, 0.0, 0.0), 0.6)


def lid_rim() -> Through:
    return patch_of(creased.lid(12, 1), (1.0, 0.0, 0.0), 0.5)


def inner_vertices(inside: IntArray) -> IntArray:
    return np.setdiff1d(inside, np.concatenate(fairing.boundary_loops(inside)))


def pairs(edges: IntArray) -> set[tuple[int, int]]:
    return {(int(a), int(b)) for a, b in np.sort(edges, axis=1)}


@pytest.mark.parametrize("make", [box_edge, box_corner, lid_rim])
@pytest.mark.parametrize("noise", [0.0, 0.15])
def test_an_edge_that_runs_through_is_found(make: Callable[[], Through], noise: float) -> None:
    """Exact, and with all that is inside thrown about by a share of its edges: made fair it is where it was."""
    exact, inside, outside, hard = make()
    moving = inner_vertices(inside)
    size = np.linalg.norm(np.diff(exact.vertices[measures.edges(inside)], axis=1)[:, 0], axis=1).mean()
    points = exact.vertices.copy()
    points[moving] += noise * size * np.random.default_rng(4).normal(size=(len(moving), 3))
    found = fairing.edges_through(points, inside, outside)
    within = hard[np.isin(hard, moving).any(axis=1)]
    if noise == 0.0:
        assert pairs(found.edges) == pairs(within)
    assert len(found.edges) >= len(within)
    assert pairs(found.onward) >= pairs(hard) - pairs(within)
    fair = fairing.fair_edges(points, found.edges, found.onward)
    curve = np.unique(np.concatenate(fair.curves))
    off = np.sort([side(fair.vertices[curve]) for side in exact.distances], axis=0)[1]
    assert off.max() < (0.05 if noise else 1e-6) * size


def test_an_edge_of_which_most_is_lost_is_none() -> None:
    """A third of it is as it was, the rest is smooth."""
    exact, inside, outside, _ = patch_of(creased.box_edge(24, 1), (0.0, 0.5, 0.0), 0.4)
    boundary = np.unique(np.concatenate(fairing.boundary_loops(inside)))
    normals = fairing.surrounding_normals(exact.vertices, outside, boundary).normals
    smooth = fairing.fair(exact.vertices, inside, fixed=boundary, fixed_normals=normals).vertices
    mixed = np.where(exact.vertices[:, 1:2] < 0.35, exact.vertices, smooth)
    hard = fairing.hard_edges(mixed, np.concatenate([inside, outside]))
    assert np.count_nonzero(np.isin(hard, inner_vertices(inside)).all(axis=1)) > 5
    assert len(fairing.edges_through(mixed, inside, outside).edges) == 0


def test_an_edge_around_a_boss_inside_is_none() -> None:
    """It leads nowhere."""
    exact, inside, outside, _ = patch_of(creased.lid(14, 1), (0.0, 0.0, 0.0), 0.8)
    points = exact.vertices.copy()
    boss = np.linalg.norm(points, axis=1) < 0.4
    points[boss, 2] += 0.3
    assert len(fairing.hard_edges(points, inside)) > 10
    assert len(fairing.edges_through(points, inside, outside).edges) == 0


def test_only_edges_of_polygons_count() -> None:
    """Where the edges along the fold are diagonals of quads, there is no way along it."""
    exact, inside, outside, hard = box_edge()
    within = pairs(hard[np.isin(hard, inner_vertices(inside)).any(axis=1)])
    others = np.array([pair for pair in measures.edges(inside).tolist() if tuple(pair) not in within])
    assert len(fairing.edges_through(exact.vertices, inside, outside, neighbours=others).edges) == 0
    with pytest.raises(ValueError, match="neighbours: row 0 names vertex 99999"):
        fairing.edges_through(exact.vertices, inside, outside, neighbours=[[0, 99999]])


def test_marked_edges_count_however_flat() -> None:
    """A fold of 20°, found where it is marked."""
    exact, inside, outside, hard = box_edge()
    low = np.radians(20.0)
    z = exact.vertices[:, 2]
    flat = np.column_stack([exact.vertices[:, 0] - z * np.cos(low), exact.vertices[:, 1], z * np.sin(low)])
    assert len(fairing.edges_through(flat, inside, outside).edges) == 0
    within = hard[np.isin(hard, inner_vertices(inside)).any(axis=1)]
    assert pairs(fairing.edges_through(flat, inside, outside, marked=hard).edges) == pairs(within)


def test_a_smooth_surface_has_none() -> None:
    vertices, triangles = holes.bowl(24)
    inside = vertices[triangles][:, :, 2].mean(axis=1) < np.median(vertices[:, 2])
    assert len(fairing.edges_through(vertices, triangles[inside], triangles[~inside]).edges) == 0


# Chains of edges become fair between the edges that they continue.


def chain(first: int, count: int) -> list[list[int]]:
    return [[k, k + 1] for k in range(first, first + count - 1)]


def dented(exact: FloatArray, inner: slice, seed: int = 1) -> FloatArray:
    points = exact.copy()
    points[inner] += 0.1 * np.random.default_rng(seed).normal(size=points[inner].shape)
    return points


def on_line(count: int) -> FloatArray:
    return np.array([3.0, 0.0, 1.0]) + np.outer(np.linspace(0.0, 1.0, count) ** 1.3, [1.0, 2.0, -0.5])


def on_circle(count: int) -> FloatArray:
    angle = 2.0 * np.linspace(0.0, 1.0, count)
    return 0.5 * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])


@pytest.mark.parametrize("exact", [on_line(20), on_circle(20)], ids=["straight", "circle"])
def test_a_dented_edge_comes_back(exact: FloatArray) -> None:
    """Onto the line or the circle; its neighbours outside and the vertices at the boundary keep their bits."""
    inner = slice(6, 14)
    given = dented(exact, inner)
    result = fairing.fair_edges(given, chain(5, 10), chain(0, 6) + chain(14, 6))
    assert result.moved.tolist() == list(range(6, 14))
    (curve,) = result.curves
    assert sorted(curve.tolist()) == list(range(5, 15))
    offset = exact[10] - exact[9]
    if np.abs(np.cross(exact[1] - exact[0], offset)).max() < 1e-12:
        way = exact[-1] - exact[0]
        distance = np.linalg.norm(np.cross(result.vertices - exact[0], way), axis=1) / np.linalg.norm(way)
    else:
        distance = np.abs(np.linalg.norm(result.vertices, axis=1) - 0.5)
    assert distance.max() < 1e-9
    still = np.setdiff1d(np.arange(20), result.moved)
    assert np.array_equal(result.vertices[still], given[still])


def test_three_edges_meet_where_their_lines_do() -> None:
    """A box corner whose tip was knocked off."""
    arms = np.array([[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]])
    points = np.concatenate([[[0.2, -0.1, 0.3]], *(np.outer(np.arange(1, 9), arm) / 8.0 for arm in arms)])
    inner, onward = [], []
    for k in range(3):
        first = 1 + 8 * k
        inner += [[0, first], *chain(first, 4)]
        onward += chain(first + 3, 5)
    points[[1, 2, 9, 10, 17, 18]] += 0.05
    result = fairing.fair_edges(points, inner, onward)
    assert np.abs(result.vertices[0]).max() < 1e-9
    assert len(result.curves) == 3
    off_axes = np.sort(np.abs(result.vertices), axis=1)[:, 1]
    assert off_axes.max() < 1e-9


def test_what_does_not_run_through_stays() -> None:
    """A chain that ends inside, one that nothing continues, and a ring."""
    exact = dented(on_circle(20), slice(6, 14))
    ring = on_circle(8)
    for edges, onward in (
        (chain(5, 6), chain(0, 6)),
        (chain(5, 10), np.empty((0, 2), int)),
        (chain(5, 10), chain(0, 6)),
    ):
        result = fairing.fair_edges(exact, edges, onward)
        assert len(result.moved) == 0
        assert np.array_equal(result.vertices, exact)
    closed = fairing.fair_edges(ring, [*chain(0, 8), [7, 0]], np.empty((0, 2), int))
    assert np.array_equal(closed.vertices, ring)


def test_bad_input_is_named() -> None:
    with pytest.raises(fairing.MeshError, match="edges: row 0 names vertex 9"):
        fairing.fair_edges(on_line(5), [[0, 9]], [[1, 2]])
    with pytest.raises(ValueError, match="onward: shape"):
        fairing.fair_edges(on_line(5), [[0, 1]], [[1, 2, 3]])
