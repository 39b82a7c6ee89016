"""Which hard edges a fair surface must not take away without a word."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Ints, Mask
from addon.fair.engine import Problem
from addon.fair.solve import pose
from addon.options.options import FairOptions
from addon.verdict.eaten import Eaten, eaten_edges

from polygon_mesh import grid_points, grid_quads, polygon_mesh

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


def eaten(mesh: MeshArrays, sharp: Mask | None = None) -> tuple[Eaten, Problem]:
    """Lower the ridge's free vertices to where their neighbours are: the surface is flat there."""
    problem, _ = pose(mesh, np.eye(4), FairOptions())
    after = problem.points.copy()
    free = problem.patch.free
    crest = free[on_ridge(mesh)[problem.vertices[free]]]
    after[crest, 2] = problem.points[free, 2].min()
    after[free, 2] = after[free, 2].min()
    pairs = None if sharp is None else np.sort(mesh.edges[sharp], axis=1)
    return eaten_edges(problem, after, pairs), problem


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


@pytest.mark.parametrize(
    ("degrees", "across", "stands_out"), [(100.0, 9.0, True), (100.0, 18.0, False), (50.0, 9.0, False)]
)
def test_where_the_faces_beside_it_bend_too_a_ridge_is_no_hard_edge(
    degrees: float, across: float, stands_out: bool
) -> None:
    """Every column of faces bends against the next, up and down by turns, as the rim of a coarse fin does."""
    mesh = ridge(degrees)
    columns = np.round((mesh.positions[:, 0] + 1.0) * SIZE / 2).astype(np.int64)
    wrinkled, steep = mesh.positions.copy(), np.cos(np.radians(degrees / 2.0))
    wrinkled[:, 2] += np.tan(np.radians(across / 2.0)) / SIZE * np.where(columns % 2, -1.0, 1.0) / steep
    assert (len(eaten(replace(mesh, positions=wrinkled))[0].running_on) > 0) == stands_out


def test_a_ridge_within_the_selection_is_what_fairing_removes() -> None:
    found, _ = eaten(ridge(90.0, ends=0.44))
    assert (len(found.running_on), len(found.marked)) == (0, 0)


def test_a_bend_that_is_not_hard_may_go() -> None:
    assert len(eaten(ridge(30.0))[0].running_on) == 0


@pytest.mark.parametrize("noise", [0.02, 0.04])
def test_noise_has_no_edges_that_run_on(noise: float) -> None:
    assert len(eaten(ridge(0.0, noise=noise))[0].running_on) == 0


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
    assert len(eaten_edges(problem, after, mesh.edges[along]).marked) == 0


@pytest.mark.parametrize("pinned", [True, False])
def test_a_pinned_edge_that_gets_blunter_is_not_missed(pinned: bool) -> None:
    """The crest stays, and the slopes beside it get gentler."""
    mesh = ridge(90.0)
    problem, _ = pose(replace(mesh, pinned=on_ridge(mesh) & pinned), np.eye(4), FairOptions())
    after = problem.points.copy()
    after[problem.patch.free, 2] *= 0.5
    assert (len(eaten_edges(problem, after, None).running_on) == 0) == pinned
