"""What a verdict looks at: edges that are gone, seams, faces passed through, triangles."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from addon.arrays.around import numbered, outside_triangles
from addon.arrays.region import MeshArrays, make_patch
from addon.arrays.types import Floats, Ints, Mask
from addon.fair.engine import Problem
from addon.fair.solve import pose, solve
from addon.options.options import FairOptions
from addon.remesh.remeshing import remesh_arrays
from addon.verdict import quality
from addon.verdict.outcome import Fairing, outcome
from addon.verdict.quality import Measured, measured, moved_sheet
from addon.verdict.verdict import LOOK

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh

SIZE = 20  # faces along each side of [−1, 1]²
HALF = 0.45  # of the selected square's side


def ridge(degrees: float, ends: float = 2.0, noise: float = 0.0) -> MeshArrays:
    """Two slopes that meet in a ridge along x, or a short one on a plain, to |x| = ends; the middle is selected."""
    points = grid_points(SIZE)
    away = np.abs(points[:, 1])
    height = -away if ends > 1.0 else 0.2 - np.minimum(away, 0.2)
    points[:, 2] = np.tan(np.radians(degrees) / 2.0) * height * np.clip((ends - np.abs(points[:, 0])) / 0.1, 0.0, 1.0)
    points += np.random.default_rng(3).normal(scale=noise, size=points.shape)
    quads = np.array(grid_quads(SIZE))
    return polygon_mesh(points, quads.tolist(), np.abs(grid_points(SIZE)[quads].mean(axis=1)[:, :2]).max(axis=1) < HALF)


def on_ridge(mesh: MeshArrays) -> Mask:
    found: Mask = np.abs(grid_points(SIZE)[:, 1]) < 1e-9
    return found


def eaten_edges(mesh: MeshArrays, problem: Problem, after: Floats, sharp: Mask | None = None) -> Measured:
    """What is seen of the mesh whose vertices problem.vertices are at (q, 3) now; sharp: (e,) the edges marked so."""
    before = mesh.positions.copy()
    before[problem.vertices] = problem.points
    sheet = moved_sheet(before, problem, after), problem
    moved = problem.vertices[problem.patch.free]
    return measured(replace(mesh, sharp=sharp), (before, problem.patch), sheet, moved=moved)


def eaten(mesh: MeshArrays, sharp: Mask | None = None) -> tuple[Measured, Problem]:
    """Lower the ridge's free vertices to where their neighbours are: the surface is flat there."""
    problem, _ = pose(mesh, np.eye(4), FairOptions())
    after = problem.points.copy()
    free = problem.patch.free
    crest = free[on_ridge(mesh)[problem.vertices[free]]]
    after[crest, 2] = problem.points[free, 2].min()
    after[free, 2] = after[free, 2].min()
    return eaten_edges(mesh, problem, after, sharp), problem


def crest_of(mesh: MeshArrays, problem: Problem) -> Ints:
    free = problem.vertices[problem.patch.free]
    crest: Ints = free[on_ridge(mesh)[free]]
    return crest


@pytest.mark.parametrize("degrees", [90.0, 50.0])
def test_a_ridge_that_runs_on_outside_is_missed(degrees: float) -> None:
    mesh = ridge(degrees)
    found, problem = eaten(mesh)
    crest = crest_of(mesh, problem)
    assert len(found.running_on) >= 4
    assert set(found.running_on) <= set(crest)  # those near the outline: rows are followed there
    assert set(crest[[0, -1]]) <= set(found.running_on)
    assert len(found.marked) == 0


def test_edges_that_are_marked_sharp_are_missed_wherever_they_end() -> None:
    """A short ridge inside: marked it is meant, and so are the other edges that became flatter, not the unmarked."""
    mesh = ridge(60.0, ends=0.25)
    along: Mask = on_ridge(mesh)[mesh.edges].all(axis=1)
    found, problem = eaten(mesh, along)
    assert len(found.marked) >= 3
    assert set(found.marked) <= set(crest_of(mesh, problem))
    assert len(eaten(mesh, ~along & False)[0].marked) == 0


def test_marks_on_most_edges_say_nothing() -> None:
    mesh = ridge(60.0, ends=0.25)
    assert len(eaten(mesh, np.ones(len(mesh.edges), dtype=bool))[0].marked) == 0


def test_a_pinned_edge_is_not_missed() -> None:
    mesh = ridge(60.0)
    along: Mask = on_ridge(mesh)[mesh.edges].all(axis=1)
    problem, _ = pose(replace(mesh, pinned=on_ridge(mesh)), np.eye(4), FairOptions())
    after = problem.points.copy()
    after[problem.patch.free, 2] = 0.0  # as high as the ridge, which stays
    assert len(eaten_edges(mesh, problem, after, along).marked) == 0


# Doubled vertices inside a selection are an open border that stays: what it holds up must not count as good.
SIZE_SEAMS = 16


EYE = np.eye(4)


def slit_sphere(height: float, split: bool = True) -> MeshArrays:
    """A side of a cubic sphere with a bump in its selected middle, whose middle row is doubled inside."""
    points, quads = grid_points(SIZE_SEAMS), np.array(grid_quads(SIZE_SEAMS))
    selected = grid(SIZE_SEAMS, 0.6).in_patch
    row = np.flatnonzero((points[:, 1] == 0.0) & (np.abs(points[:, 0]) < 0.4))
    doubles = len(points) + np.arange(len(row))
    above = quads[:, 0] >= (SIZE_SEAMS // 2) * (SIZE_SEAMS + 1)
    if split:
        twin = np.arange(len(points))
        twin[row] = doubles
        quads[above] = twin[quads[above]]
        points = np.concatenate([points, points[row]])
    bump = 1.0 + height * np.exp(-((points**2).sum(axis=1)) / 0.05)
    return polygon_mesh(on_sphere(points) * bump[:, None], quads.tolist(), selected)


def fair(mesh: MeshArrays, matrix: Floats = EYE) -> Fairing:
    options = FairOptions()
    return outcome(mesh, matrix, options, solve(mesh, matrix, options))


def test_a_crest_on_a_doubled_seam_is_not_good() -> None:
    done = fair(slit_sphere(0.3))
    assert done.verdict.grade == "LOOK"
    assert "seam of doubled vertices" in done.verdict.reason
    mesh = slit_sphere(0.3)
    on_row = np.flatnonzero((np.abs(mesh.positions[:, 1]) < 1e-9) & (np.abs(mesh.positions[:, 0]) < 0.45))
    assert set(done.verdict.spots) <= set(on_row)
    assert len(done.verdict.spots) > 6


# Where a new surface passes through faces that are no part of it.
SIZE_PIERCING = 12


def dent_below_a_plate(height: float, slope: float = 0.0) -> MeshArrays:
    """A plain with a dent, which is selected, and a plate over its middle, at heights around this one."""
    points = grid_points(SIZE_PIERCING)
    selected = np.abs(points[np.array(grid_quads(SIZE_PIERCING))].mean(axis=1)).max(axis=1) < 0.6
    points[:, 2] = -0.8 * np.clip(0.5 - np.hypot(points[:, 0], points[:, 1]), 0.0, None)
    plate = np.array([[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.1, 0.1, 0.0], [-0.1, 0.1, 0.0]])
    plate[:, 2] = height + slope * plate[:, 0]
    quads = [*grid_quads(SIZE_PIERCING), [len(points) + k for k in range(4)]]
    return polygon_mesh(np.concatenate([points, plate]), quads, [*selected, False])


def reason(mesh: MeshArrays, anew: bool = False) -> str:
    if anew:
        verdict = remesh_arrays(mesh, np.eye(4), FairOptions(remesh=True)).verdict
    else:
        verdict = outcome(mesh, np.eye(4), FairOptions(), solve(mesh, np.eye(4), FairOptions())).verdict
    if "passes through faces outside" not in verdict.reason:
        return ""
    assert verdict.grade == LOOK
    near = np.abs(mesh.positions[verdict.spots, :2]).max(axis=1)
    assert near.max() < 0.35  # beside the plate
    return verdict.reason


def test_a_surface_that_rises_through_a_plate_is_worth_a_look() -> None:
    assert reason(dent_below_a_plate(0.01, slope=1.0))


def test_a_new_mesh_that_rises_through_a_plate_is_worth_a_look() -> None:
    assert reason(dent_below_a_plate(0.01, slope=1.0), anew=True)


@pytest.mark.parametrize("anew", [False, True])
def test_a_plate_above_is_no_matter(anew: bool) -> None:
    assert not reason(dent_below_a_plate(0.2), anew)


@pytest.mark.parametrize("anew", [False, True])
def test_what_passed_through_before_is_no_news(anew: bool) -> None:
    mesh = dent_below_a_plate(0.0, slope=1.0)
    lower = mesh.positions.copy()
    lower[-4:, 2] = [-0.9, 0.1, 0.1, -0.9]  # through the dent's floor and through the plain
    assert not reason(replace(mesh, positions=lower), anew)


# What is counted about triangles: turned over, flat, distorted; and when crossings are looked for.
QUAD = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])


TWO = np.array([[0, 1, 2], [0, 2, 3]])


def test_what_shrinks_to_nothing_counts_for_nothing() -> None:
    """Two squares: one keeps its shape, the other is stretched threefold and a thousandth as large."""
    squares = np.concatenate([QUAD, QUAD + np.array([5.0, 0.0, 0.0])])
    both = np.concatenate([TWO, TWO + len(QUAD)])
    after = np.concatenate([QUAD, 1e-3 * QUAD * [3.0, 1.0, 1.0]])
    assert quality.texture_distortion(squares, after, both) < 1e-5
    assert quality.texture_distortion(after, squares, both) > 0.1


def seen(mesh: MeshArrays, after: Floats, **options: Any) -> Measured:
    """What is seen of the mesh's patch where its vertices go from their positions to others (n, 3)."""
    patch = make_patch(mesh)
    vertices, outside = numbered(patch, outside_triangles(mesh, patch))
    problem = Problem(patch, after[vertices], np.empty((0, 3)), vertices, outside)
    return measured(
        mesh, (mesh.positions, patch), (moved_sheet(mesh.positions, problem, problem.points), problem), **options
    )


def test_crossings_are_looked_for_where_they_are_not_known_to_be_none() -> None:
    mesh = grid(12, 2.0)
    points = mesh.positions.copy()
    x, y, _ = points.T
    right = x > 0.0
    folded = np.column_stack([-x, 0.9 * y + 0.02, 0.35 - 0.6 * x])
    points[right] = folded[right]  # back, and through the left half
    for is_clear in (False, True):
        crossing = seen(mesh, points, is_clear=is_clear).after.crossing
        assert crossing is not None
        assert (len(crossing) > 0) != is_clear
