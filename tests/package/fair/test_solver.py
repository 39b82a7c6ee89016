"""Repeated solves: the first is fair's bit for bit, later ones start from the last answer and give the same surface."""

import threading
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
from curves import FloatArray
from shapes import Patch

TOLERANCE = 1e-10
# Two solves that stop at steps below 1e-10 D are this near to each other.
SAME = 1e-8
SIZE = 600


def solver_of(patch: Patch, **options: Any) -> fairing.Solver:
    return fairing.Solver(patch.triangles, fixed=patch.fixed, **{"tolerance": TOLERANCE, **options})


def fair(patch: Patch, vertices: FloatArray, at_fixed: FloatArray, **options: Any) -> fairing.FairResult:
    arguments: dict[str, Any] = {"tolerance": TOLERANCE, **options}
    return fairing.fair(vertices, patch.triangles, fixed=patch.fixed, fixed_normals=at_fixed, **arguments)


def stages(solver: fairing.Solver, *arguments: Any, **named: Any) -> tuple[fairing.FairResult, set[str]]:
    """The result, and what was reported on the way to it."""
    seen: set[str] = set()
    result = solver.solve(*arguments, progress=lambda fraction, stage: seen.add(stage), **named)
    return result, seen


WITHOUT_FACTORISATION = {"topology", "iteration", "done"}


def dragged(patch: Patch, vertices: FloatArray, at: int, by: float) -> FloatArray:
    """Everything near one fixed vertex moved, at most by `by` × D."""
    reach = np.linalg.norm(vertices - vertices[patch.fixed[at]], axis=1) / (0.2 * patch.diameter)
    step: FloatArray = by * patch.diameter * np.exp(-(reach**2))[:, None] * np.array([0.3, -0.5, 0.8])
    return vertices + step


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"inner_fairness": "conformal"},
        {"equation": "constant", "load": 2.0},
        {"equation": "soap_film"},
        {"equation": "minimal_energy"},
        {"method": "paper", "tolerance": 1e-5},
    ],
)
def test_first_solve_has_the_bits_of_fair(options: dict[str, Any]) -> None:
    patch = shapes.cap(300, half_angle=60)
    start = shapes.start_from_nothing(patch)
    first = solver_of(patch, **options).solve(start, patch.fixed_normals)
    single = fair(patch, start, patch.fixed_normals, **options)
    for name in ("vertices", "fixed", "mean_curvature", "boundary_angle"):
        assert np.array_equal(getattr(first, name), getattr(single, name)), name
    for name in ("converged", "polished", "termination", "iterations", "residual", "initial_residual", "levels"):
        assert getattr(first, name) == getattr(single, name), name
    assert [str(warning) for warning in first.warnings] == [str(warning) for warning in single.warnings]


@pytest.mark.parametrize("family", ["hemisphere", "unduloid", "linear_flux", "clothoid", "plane"])
def test_answers_do_not_depend_on_what_was_solved_before(family: str) -> None:
    patch = shapes.FAMILIES[family](SIZE)
    solver = solver_of(patch)
    vertices, normals = shapes.start_from_nothing(patch), patch.fixed_normals
    solver.solve(vertices, normals)
    for at, by in [(0, 0.01), (7, 0.02), (3, 0.001), (11, 0.04)]:
        vertices = dragged(patch, vertices, at, by)
        result, seen = stages(solver, vertices, normals)
        assert "globalisation" not in seen
        single = fair(patch, vertices, normals)
        assert np.abs(result.vertices - single.vertices).max() <= SAME * patch.diameter
        assert np.abs(result.mean_curvature - single.mean_curvature).max() <= 1e-4
        assert result.residual <= 1.0
    back = solver.solve(shapes.start_from_nothing(patch), normals)
    assert np.abs(back.vertices - fair(patch, shapes.start_from_nothing(patch), normals).vertices).max() <= (
        SAME * patch.diameter
    )


def test_a_boundary_that_jumps_is_solved_from_scratch() -> None:
    patch = shapes.cap(300)
    solver = solver_of(patch)
    solver.solve(patch.vertices, patch.fixed_normals)
    vertices = dragged(patch, patch.vertices, 5, 0.2)
    result, seen = stages(solver, vertices, patch.fixed_normals)
    assert "globalisation" in seen
    assert np.array_equal(result.vertices, fair(patch, vertices, patch.fixed_normals).vertices)


def test_same_input_gives_the_same_bits_again() -> None:
    patch = shapes.catenoid(SIZE)
    solver = solver_of(patch)
    first = solver.solve(patch.vertices, patch.fixed_normals)
    again = solver.solve(patch.vertices, patch.fixed_normals)
    assert np.array_equal(first.vertices, again.vertices)
    assert again.iterations == 1


PATCH = shapes.cap(300)


@pytest.mark.parametrize(
    ("vertices", "normals", "error"),
    [
        (np.where(np.arange(len(PATCH.vertices))[:, None] == 3, np.nan, PATCH.vertices), PATCH.fixed_normals, "NONFI"),
        (PATCH.vertices[:-1], PATCH.fixed_normals, "INDEX_RANGE"),
        (PATCH.vertices, PATCH.fixed_normals[:-1], "rows are needed"),
        (PATCH.vertices, np.zeros_like(PATCH.fixed_normals), "length zero"),
        (PATCH.vertices[:, :2], PATCH.fixed_normals, "vertices: shape"),
        (np.zeros_like(PATCH.vertices), PATCH.fixed_normals, "one point only"),
    ],
)
def test_what_is_refused_leaves_the_solver_as_it_was(vertices: Any, normals: Any, error: str) -> None:
    solver = solver_of(PATCH)
    for _ in range(2):
        with pytest.raises(ValueError, match=error):
            solver.solve(vertices, normals)
        result = solver.solve(PATCH.vertices, PATCH.fixed_normals)
        assert np.array_equal(result.vertices, fair(PATCH, PATCH.vertices, PATCH.fixed_normals).vertices)


def in_a_drag(patch: Patch) -> fairing.Solver:
    """A solver with an answer, and with what a move after it has taught."""
    solver = solver_of(patch)
    for vertices in (patch.vertices, dragged(patch, patch.vertices, 4, 0.005)):
        solver.solve(vertices, patch.fixed_normals)
    return solver


def test_cancelling_at_any_call_leaves_the_last_answer() -> None:
    """Then the next solve needs as few stages and gives the same bits as without the cancelled one."""
    moved = dragged(PATCH, PATCH.vertices, 4, 0.01)
    expected, calls = None, 0
    counted = in_a_drag(PATCH)

    def count(fraction: float, stage: str) -> None:
        nonlocal calls
        calls += 1

    expected = counted.solve(moved, PATCH.fixed_normals, progress=count)
    for last in range(1, calls):
        solver = in_a_drag(PATCH)
        left = last

        def stop(fraction: float, stage: str) -> bool:
            nonlocal left
            left -= 1
            return left > 0

        with pytest.raises(fairing.Cancelled):
            solver.solve(moved, PATCH.fixed_normals, progress=stop)
        result, seen = stages(solver, moved, PATCH.fixed_normals)
        assert seen == WITHOUT_FACTORISATION
        assert np.array_equal(result.vertices, expected.vertices)


def test_one_call_at_a_time() -> None:
    """From `progress` and from another thread the call is refused; the running one is not disturbed."""
    solver = solver_of(PATCH)
    refusals: list[str] = []

    def call() -> None:
        try:
            solver.solve(PATCH.vertices, PATCH.fixed_normals)
        except RuntimeError as error:
            refusals.append(str(error))

    def meanwhile(fraction: float, stage: str) -> None:
        if not refusals:
            call()
            thread = threading.Thread(target=call)
            thread.start()
            thread.join()

    result = solver.solve(PATCH.vertices, PATCH.fixed_normals, progress=meanwhile)
    assert len(refusals) == 2
    assert all("one call at a time" in text for text in refusals)
    assert np.array_equal(result.vertices, fair(PATCH, PATCH.vertices, PATCH.fixed_normals).vertices)


@pytest.mark.parametrize(
    "options",
    [
        {"equation": "constant", "load": 3.0},
        {"equation": "minimal_energy"},
        {"equation": "soap_film"},
        {"inner_fairness": "conformal"},
        {"method": "paper", "tolerance": 1e-6},
    ],
)
def test_changed_options_count_from_the_next_solve_on(options: dict[str, Any]) -> None:
    """They give the bits of a single call, whatever was solved before, and changed back the former answer again."""
    patch = shapes.cap(SIZE, half_angle=50)
    solver = solver_of(patch)
    first = solver.solve(patch.vertices, patch.fixed_normals)
    solver.change(**options)
    changed = solver.solve(patch.vertices, patch.fixed_normals)
    single = fair(patch, patch.vertices, patch.fixed_normals, **options)
    assert np.array_equal(changed.vertices, single.vertices)
    solver.change(equation="harmonic", load=0.0, inner_fairness="uniform", method="global", tolerance=TOLERANCE)
    back = solver.solve(patch.vertices, patch.fixed_normals)
    assert np.array_equal(back.vertices, first.vertices)


def test_what_cannot_be_changed_is_refused_and_changes_nothing() -> None:
    solver = solver_of(PATCH)
    first = solver.solve(PATCH.vertices, PATCH.fixed_normals)
    with pytest.raises(TypeError, match="'fixed' is no option"):
        solver.change(fixed=[1, 2])
    with pytest.raises(ValueError, match="tolerance"):
        solver.change(equation="soap_film", tolerance=-1.0)
    assert np.array_equal(solver.solve(PATCH.vertices, PATCH.fixed_normals).vertices, first.vertices)
