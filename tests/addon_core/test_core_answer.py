"""The add-on's way from a mesh to new positions, on a sphere, whose answer is the sphere."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays, Patch
from addon.arrays.types import Floats, Ints
from addon.fair import engine
from addon.fair.memory import MOST, Memory
from addon.fair.solve import Kept, pose, solve
from addon.options.options import FairOptions
from addon.verdict import quality
from addon.verdict.outcome import Fairing, outcome
from addon.verdict.verdict import AS_SELECTED, GOOD, LOOK

import fairing
from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh

EYE = np.eye(4)


def spoilt_sphere(size: int = 16) -> MeshArrays:
    """A side of a cubic sphere, its selected middle pushed in and shaken."""
    mesh = grid(size, 0.6, on_sphere)
    points = mesh.positions.copy()
    inside, _ = pose(mesh, EYE, FairOptions())
    free = inside.patch.vertices[inside.patch.free]
    points[free] = 0.8 * points[free] + 0.05 * np.random.default_rng(5).normal(size=(len(free), 3))
    return replace(mesh, positions=points)


def fair(mesh: MeshArrays, matrix: Floats = EYE, **options: object) -> Fairing:
    chosen = FairOptions(**options)
    return outcome(mesh, matrix, chosen, solve(mesh, matrix, chosen))


def test_the_sphere_comes_back() -> None:
    done = fair(spoilt_sphere())
    assert done.result.converged
    np.testing.assert_allclose(np.linalg.norm(done.positions, axis=1), 1.0, atol=1e-6)
    assert done.curvature == pytest.approx((1.0, 1.0), abs=2e-2)
    assert len(done.before.folded) > 0
    assert (len(done.after.folded), len(done.after.needles), done.verdict.grade) == (0, 0, GOOD)
    assert done.join.worst < 1.0  # a sphere of this size bends by 6° from face to face


def test_it_is_fair_in_the_space_that_the_matrix_leads_to() -> None:
    """In a mesh that is a sphere only after its object's shear, turn and shift."""
    matrix = np.array([[0.0, -2.0, 0.3, 1.0], [1.5, 0.0, 0.0, -2.0], [0.0, 0.4, 0.7, 3.0], [0.0, 0.0, 0.0, 1.0]])
    sphere = spoilt_sphere()
    local = np.linalg.solve(matrix[:3, :3], (sphere.positions - matrix[:3, 3]).T).T
    done = fair(replace(sphere, positions=local), matrix)
    world = done.positions @ matrix[:3, :3].T + matrix[:3, 3]
    np.testing.assert_allclose(np.linalg.norm(world, axis=1), 1.0, atol=1e-6)


def test_the_factor_blends_between_the_mesh_and_the_answer() -> None:
    mesh = spoilt_sphere()
    whole, half, nothing = (fair(mesh, factor=factor) for factor in (1.0, 0.5, 0.0))
    start = mesh.positions[whole.vertices]
    assert nothing.positions.tobytes() == start.tobytes()
    np.testing.assert_allclose(half.positions, 0.5 * (start + whole.positions), atol=1e-15)


def counting_kept(ahead: bool = False) -> Kept:
    return Kept(Memory(MOST), ahead)


def test_the_engine_is_asked_for_all_of_the_detail_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every share of it follows from that answer; none of it is another one."""
    mesh, kept = spoilt_sphere(), counting_kept()
    whole = solve(mesh, EYE, FairOptions(detail=1.0), kept=kept).result
    assert np.abs(whole.vertices - whole.base).max() > 0.01
    with monkeypatch.context() as nothing_solves:
        nothing_solves.setattr(fairing, "fair", lambda *_args, **_options: pytest.fail("solved again"))
        nothing_solves.setattr(engine, "RepeatedSolve", lambda *_args: pytest.fail("solved again"))
        part = solve(mesh, EYE, FairOptions(detail=0.25), kept=kept).result
    np.testing.assert_allclose(part.vertices, whole.base + 0.25 * (whole.vertices - whole.base), atol=1e-15)
    longer = FairOptions(detail=1.0, bulge=0.2)
    again, anew = solve(mesh, EYE, longer, kept=kept).result, solve(mesh, EYE, longer).result
    np.testing.assert_allclose(again.vertices, anew.vertices, atol=1e-5)
    assert np.abs(again.vertices - whole.vertices).max() > 0.01


def test_a_patch_that_may_cross_is_looked_at_and_a_clear_one_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = spoilt_sphere()
    solved = solve(mesh, EYE, FairOptions())
    asked: list[float] = []

    def seven(_patch: Patch, positions: Floats) -> Ints:
        asked.append(float(positions.sum()))
        return np.arange(7)

    monkeypatch.setattr(quality, "crossing", seven)
    clear = outcome(mesh, EYE, FairOptions(), solved)
    assert clear.before.crossing is not None
    assert clear.after.crossing is not None
    assert (len(clear.before.crossing) > 0, len(clear.after.crossing), len(asked)) == (True, 0, 1)
    outcome(mesh, EYE, FairOptions(factor=0.5), solved)  # nobody knows of what lies half-way
    assert len(asked) == 3


def cube_corner(size: int = 13, radius: float = 0.5) -> MeshArrays:
    """The three sides of a cube [−1, 1]³ that meet in (1, 1, 1), size² quads each; those near the corner selected."""
    points = grid_points(size) + np.array([0.0, 0.0, 1.0])
    sides = np.concatenate([np.roll(points, axis, axis=1) for axis in range(3)])
    positions, numbers = np.unique(sides.round(9), axis=0, return_inverse=True)
    quads = np.concatenate([np.array(grid_quads(size)) + axis * len(points) for axis in range(3)])
    faces = numbers.reshape(-1)[quads]
    near = np.linalg.norm(positions[faces].mean(axis=1) - 1.0, axis=1) < radius
    return polygon_mesh(positions, faces.tolist(), near)


@pytest.mark.parametrize("smooth", [False, True])
def test_a_hard_edge_outside_stays_and_one_that_is_rounded_inside_is_reported(smooth: bool) -> None:
    mesh = cube_corner()
    answered = fair(mesh, smooth_boundary=smooth)
    assert answered.verdict.grade == LOOK
    assert answered.verdict.reason.startswith("A hard edge runs on outside")
    assert AS_SELECTED not in answered.verdict.remedies


def test_knobs_are_looked_for_in_the_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = spoilt_sphere()

    compared: list[float] = []

    def most_lifted(points: Floats, triangles: Ints, *, fixed: Ints, before: float = 0.0) -> tuple[float, Ints]:
        if not np.allclose(np.linalg.norm(points, axis=1), 1.0, atol=0.02):  # not fair: the spoilt one
            return knobs(points, triangles, fixed=fixed)
        compared.append(before)
        return 1.0, np.setdiff1d(triangles, fixed)[:1]

    knobs = fairing.looks.knobs
    monkeypatch.setattr(fairing.looks, "knobs", most_lifted)
    verdict = fair(mesh).verdict
    assert compared[0] == 0.0
    assert compared[1] > 0.1  # what the spoilt one has
    assert verdict.grade == LOOK
    assert "knob" in verdict.reason
    assert np.isin(verdict.spots, pose(mesh, EYE, FairOptions())[0].patch.vertices).all()


def test_measuring_can_be_cancelled() -> None:
    """It takes as long as the solution, and a process that ends waits for it."""
    mesh = spoilt_sphere()
    solved = solve(mesh, EYE, FairOptions())
    asked: list[str] = []
    outcome(mesh, EYE, FairOptions(), solved, lambda _, stage: asked.append(stage))
    assert set(asked) == {"measurement"}
    for last in range(len(asked)):
        left = iter([True] * last + [False])
        with pytest.raises(fairing.Cancelled):
            outcome(mesh, EYE, FairOptions(), solved, lambda *_, left=left: next(left))
