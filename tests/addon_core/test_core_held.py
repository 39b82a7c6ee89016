"""Curves and borders of a patch, and boundaries on the slope of a bump."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays, make_patch
from addon.fair.held_curves import none, released, with_pinned_edges
from addon.fair.solve import solve
from addon.options.options import FairOptions
from addon.remesh.remeshing import remesh_arrays

from polygon_mesh import grid, grid_points, polygon_mesh

SIZE = 8


def marked(mesh: MeshArrays) -> np.ndarray:  # type: ignore[type-arg]
    """(e,) edges of the grid's middle column."""
    rows = round(float(np.sqrt(len(mesh.positions))))
    on_column: np.ndarray = (mesh.edges % rows == rows // 2).all(axis=1)  # type: ignore[type-arg]
    return on_column


def with_curve(mesh: MeshArrays, kind: str) -> MeshArrays:
    edges = marked(mesh)
    pinned = mesh.pinned.copy()
    pinned[mesh.edges[edges]] = True
    return replace(mesh, pinned=pinned, **{kind: edges})


def with_marks(mesh: MeshArrays) -> MeshArrays:
    """The middle column marked sharp, and read as Pin Edges: Automatic does."""
    return with_pinned_edges(replace(mesh, sharp=marked(mesh)), FairOptions(), none(mesh))


def test_a_crease_reaches_the_boundary_and_a_smooth_curve_stops_before_it() -> None:
    mesh = grid(SIZE, 0.6)  # 4 × 4 quads: rows from −0.5 to 0.5
    sharp = make_patch(with_curve(mesh, "creases"))
    rounded = make_patch(with_curve(mesh, "smooth_curves"))
    heights = mesh.positions[sharp.vertices[sharp.creases], 1]
    assert np.allclose(np.sort(heights), [-0.5, -0.25, 0.0, 0.25, 0.5])
    inner = mesh.positions[rounded.vertices[rounded.smooth_curves], 1]
    assert np.allclose(np.sort(inner), [-0.25, 0.0, 0.25])
    assert len(sharp.smooth_curves) == len(rounded.creases) == 0
    assert np.isin(sharp.creases, sharp.fixed).all()


def test_a_border_that_becomes_fair_is_free_but_where_the_selection_ends() -> None:
    mesh = grid(SIZE, 2.0)
    mesh = replace(mesh, in_patch=mesh.positions[mesh.corner_vertices.reshape(-1, 4)][:, :, 0].mean(axis=1) > 0)
    held, faired = make_patch(mesh), make_patch(replace(mesh, fair_border=True))
    more = held.vertices[np.setdiff1d(faired.free, held.free)]
    points = mesh.positions[more]
    assert (np.abs(points[:, :2]).max(axis=1) > 1 - 1e-9).all()
    assert (points[:, 0] > 1e-9).all()
    assert len(more) == 2 * (SIZE // 2) + SIZE - 1


@pytest.mark.parametrize(
    ("options", "slope"),
    [
        ({}, "CREASE"),
        ({"pin_edges": "SHARP"}, "CREASE"),
        ({"pin_edges": "SEAM"}, "AVERAGE"),
        ({"pin_edges": "SEAM", "pin_slope": "SMOOTH"}, "SMOOTH"),
        ({"pin_edges": "SHARP", "pin_slope": "AVERAGE"}, "AVERAGE"),
    ],
)
def test_what_automatic_stands_for(options: dict[str, str], slope: str) -> None:
    assert FairOptions(**options).slope_at_pinned_edges == slope  # type: ignore[arg-type]


def folded(points: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
    """A grid folded by a right angle along x = 0."""
    x, y, _ = points.T
    return np.column_stack([np.minimum(x, 0.0), y, -np.maximum(x, 0.0)])


@pytest.mark.parametrize("spacing", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("matrix", [np.eye(4), np.diag([2.0, 2.0, -2.0, 1.0])], ids=["as it is", "mirrored"])
def test_a_new_mesh_makes_a_dented_edge_fair_and_both_sides_flat(
    spacing: float,
    matrix: np.ndarray,  # type: ignore[type-arg]
) -> None:
    """What is written are the edge's own vertices, straight again, and new ones on the two sides."""
    mesh = with_marks(grid(16, 0.55, folded))
    inside = make_patch(replace(mesh, pinned=np.zeros_like(mesh.pinned)))
    moving = inside.vertices[inside.free]
    noisy = mesh.positions.copy()
    noisy[moving] += 0.02 * np.random.default_rng(2).normal(size=(len(moving), 3))
    done = remesh_arrays(replace(mesh, positions=noisy), matrix, FairOptions(remesh=True, spacing=spacing))
    on_edge = np.abs(grid_points(16)[moving, 0]) < 1e-9
    assert set(done.vertices.tolist()) == set(moving[on_edge].tolist())
    assert np.abs(done.positions[:, [0, 2]]).max() < 1e-9
    assert off_fold(done.new_positions) < 1e-9
    assert done.verdict.grade == "GOOD"
    number = {int(v): k for k, v in enumerate(done.part.stay)}
    kept = mesh.edges[marked(mesh) & np.isin(mesh.edges, moving).any(axis=1)]
    sides = {tuple(sorted(pair)) for t in done.part.triangles.tolist() for pair in (t[:2], t[1:], t[::2])}
    assert {tuple(sorted((number[a], number[b]))) for a, b in kept.tolist()} <= sides


def dented_fold() -> tuple[MeshArrays, np.ndarray]:  # type: ignore[type-arg]
    """A fold that nobody has marked, thrown about inside the patch, and what is free of it."""
    mesh = grid(16, 0.55, folded)
    patch = make_patch(mesh)
    inside = patch.vertices[patch.free]
    mesh.positions[inside] += 0.02 * np.random.default_rng(2).normal(size=(len(inside), 3))
    return mesh, inside


def off_fold(points: np.ndarray) -> float:  # type: ignore[type-arg]
    return float(off_fold_each(points).max())


def test_an_edge_that_nobody_has_marked_is_held_by_its_angle() -> None:
    """Its vertices are those of the middle column; with Pin Edges: None the fold is rounded."""
    mesh, inside = dented_fold()
    held = with_pinned_edges(mesh, FairOptions(), none(mesh))
    on_edge = np.intersect1d(inside, mesh.edges[marked(mesh)])
    assert np.flatnonzero(held.held_by_angle).tolist() == [int(on_edge[0]) - 17, *on_edge, int(on_edge[-1]) + 17]
    assert off_fold(solve(held, np.eye(4), FairOptions()).result.vertices) < 1e-9
    rounded = with_pinned_edges(mesh, FairOptions(pin_edges="NONE"), none(mesh))
    assert rounded.held_by_angle is None
    assert off_fold(solve(rounded, np.eye(4), FairOptions(pin_edges="NONE")).result.vertices) > 0.01


@pytest.mark.parametrize(
    "options", [{"bulge": 0.1}, {"continuity": "G0"}, {"continuity": "G2"}, {"smooth_boundary": True}]
)
def test_shapes_that_know_no_edges_are_not_changed_by_unmarked_ones(options: dict[str, str]) -> None:
    mesh, _ = dented_fold()
    assert with_pinned_edges(mesh, FairOptions(**options), none(mesh)).held_by_angle is None  # type: ignore[arg-type]


def test_edges_held_by_their_angle_can_be_let_go_and_marked_ones_stay() -> None:
    mesh, _ = dented_fold()
    let_go = released(with_pinned_edges(mesh, FairOptions(), none(mesh)))
    for name in ("pinned", "creases", "hard", "held_by_angle"):
        assert np.array_equal(getattr(let_go, name), getattr(mesh, name)), name
    both = with_marks(mesh)
    assert both.held_by_angle is None
    assert np.array_equal(released(both).pinned, both.pinned)


def test_a_patch_of_nothing_but_an_edge_is_not_held() -> None:
    """Two rows of faces at the fold: held, nothing would be left to move."""
    mesh = grid(16, 2.0, folded)
    centres = mesh.positions[mesh.corner_vertices.reshape(-1, 4)].mean(axis=1)
    narrow = (off_fold_each(centres) < 1e-9) & (np.abs(centres).max(axis=1) < 0.5)
    narrow &= (np.abs(centres[:, 0]) < 0.1) & (np.abs(centres[:, 2]) < 0.1)
    strip = with_pinned_edges(replace(mesh, in_patch=narrow), FairOptions(), none(mesh))
    assert strip.held_by_angle is None
    assert len(make_patch(strip).free) > 0


def off_fold_each(points: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
    return np.minimum(np.abs(points[:, 0]), np.abs(points[:, 2]))


def test_a_crease_that_runs_out_of_the_selection_does_not_go_with_a_smoothed_boundary() -> None:
    mesh = with_curve(grid(16, 0.55, folded), "creases")
    options = FairOptions(pin_edges="SHARP", smooth_boundary=True)
    with pytest.raises(ValueError, match="Smooth Boundary would round off the creases"):
        solve(mesh, np.eye(4), options)
    assert solve(replace(mesh, creases=None), np.eye(4), options).result.converged


def test_a_patch_without_a_boundary_has_no_edges() -> None:
    """Three faces meet at an edge: that is for the solve to say."""
    points = np.array([[0.0, 0, 0], [0, 1, 0], [1, 0, 0], [-1, 0, 0], [0, 0, 1]])
    fan = polygon_mesh(points, [[0, 2, 1], [0, 1, 3], [0, 1, 4]], [True, True, True])
    assert with_pinned_edges(fan, FairOptions(), none(fan)).hard is None
