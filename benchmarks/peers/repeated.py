"""Dragging the outline: `fairing.Solver` after small moves, and a linear back-substitution beside it."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import peers_driver

import fairing
import tools
from problems import FloatArray, Problem

STEPS = 8  # moves that are measured
STRETCH = 0.01  # of each move
RUNS = 3
Timed = tuple[float, Any]


@dataclass(frozen=True)
class Repeated:
    """Wall seconds, each the least of RUNS: the first solve; median and longest of the solves after a move; median of
    whole calls of `fair` and least of linear back-substitutions for the same outlines. steps: most outer steps after a
    move; apart: largest distance over D between the last two of solver and whole call."""

    first: float
    median: float
    longest: float
    whole: float
    linear: float
    steps: int
    apart: float


def available() -> bool:
    """Whether this engine has the solver."""
    return hasattr(fairing, "Solver")


def dragged(problem: Problem) -> Repeated:
    """The outline stretched a little further each time; the interior stays as it was given."""
    moves = [_moved(problem, k * STRETCH) for k in range(STEPS + 1)]
    runs = [_solved(problem, moves) for _ in range(RUNS)]
    whole = [[_timed(lambda at=at: tools.fair(at)) for at in moves] for _ in range(RUNS)]
    first, *after = _least(runs)
    last, anew = (run[-1][1].vertices for run in (runs[-1], whole[-1]))
    return Repeated(
        first, float(np.median(after)), max(after), float(np.median(_least(whole))), substitution(moves),
        max(result.iterations for _, result in runs[-1][1:]),
        float(np.linalg.norm(last - anew, axis=1).max() / moves[-1].diameter),
    )  # fmt: skip


def _solved(problem: Problem, moves: list[Problem]) -> list[Timed]:
    """One drag with a new solver."""
    solver = fairing.Solver(problem.triangles, fixed=problem.fixed)  # type: ignore[attr-defined]
    return [_timed(lambda at=at: solver.solve(at.vertices, fixed_normals=at.normals)) for at in moves]


def _least(runs: list[list[Timed]]) -> list[float]:
    """For each move."""
    return [min(seconds for seconds, _ in calls) for calls in zip(*runs, strict=True)]


def substitution(moves: list[Problem]) -> float:
    """Least seconds to solve for a new right-hand side with a factorisation that is kept (SimplicialLDLT)."""
    made = [peers_driver.bilaplacian_system(at.all_vertices, at.all_triangles, at.free) for at in moves]
    factor = made[0].factorised(peers_driver.Method.ldlt)
    return min(_timed(lambda system=system: factor.solve(system.load))[0] for system in made)


def _timed(call: Any) -> Timed:
    start = time.perf_counter()
    result = call()
    return time.perf_counter() - start, result


def _moved(problem: Problem, amount: float) -> Problem:
    """The outline, the ring outside and their normals after an affine map."""
    stretch = np.eye(3) + amount * np.array([[1.0, 0.0, 0.5], [0.0, -1.0, 0.0], [0.5, 0.0, 0.0]])
    normals = problem.normals @ np.linalg.inv(stretch)
    vertices: FloatArray = problem.vertices.copy()
    vertices[problem.fixed] = vertices[problem.fixed] @ stretch.T
    return replace(
        problem, vertices=vertices, normals=normals / np.linalg.norm(normals, axis=1)[:, None],
        ghosts=problem.ghosts @ stretch.T,
    )  # fmt: skip
