"""Hard edges that run on through a patch are found by their angle, along edges of its own."""

from collections.abc import Callable

import numpy as np
import pytest

import creased
import fairing
import holes
import measures
from grids import IntArray

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


def test_an_edge_that_is_lost_inside_is_none() -> None:
    """The smooth surface over the outline has no edge to be held: what an artist has rounded stays round."""
    exact, inside, outside, _ = box_edge()
    outline = np.unique(np.concatenate(fairing.boundary_loops(inside)))
    normals = fairing.surrounding_normals(exact.vertices, outside, outline).normals
    smooth = fairing.fair(exact.vertices, inside, fixed=outline, fixed_normals=normals).vertices
    found = fairing.edges_through(smooth, inside, outside)
    assert len(found.edges) == 0


def test_an_edge_of_which_most_is_lost_is_none() -> None:
    """A third of it is as it was, the rest is smooth."""
    exact, inside, outside, _ = patch_of(creased.box_edge(24, 1), (0.0, 0.5, 0.0), 0.4)
    outline = np.unique(np.concatenate(fairing.boundary_loops(inside)))
    normals = fairing.surrounding_normals(exact.vertices, outside, outline).normals
    smooth = fairing.fair(exact.vertices, inside, fixed=outline, fixed_normals=normals).vertices
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
