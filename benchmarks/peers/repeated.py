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


@dataclass(frozen=True)
class Repeated:
    """Wall seconds: the first solve; least and median of the solves after a move; least of a whole call of `fair` and
    of a linear back-substitution for the same outlines. steps: most outer steps after a move; apart: largest distance
    over D between the last two of solver and whole call."""

    first: float
    least: float
    median: float
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
    solver = fairing.Solver(problem.triangles, fixed=problem.fixed)  # type: ignore[attr-defined]
    solved = [_timed(lambda at=at: solver.solve(at.vertices, fixed_normals=at.normals)) for at in moves]
    whole = [_timed(lambda at=at: tools.fair(at)) for at in moves[1:]]
    after = [seconds for seconds, _ in solved[1:]]
    away = np.linalg.norm(solved[-1][1].vertices - whole[-1][1].vertices, axis=1).max() / moves[-1].diameter
    return Repeated(
        solved[0][0], min(after), float(np.median(after)), min(seconds for seconds, _ in whole), substitution(moves),
        max(result.iterations for _, result in solved[1:]), float(away),
    )  # fmt: skip


def substitution(moves: list[Problem]) -> float:
    """Least seconds to solve for a new right-hand side with a factorisation that is kept (SimplicialLDLT)."""
    made = [peers_driver.bilaplacian_system(at.all_vertices, at.all_triangles, at.free) for at in moves]
    factor = made[0].factorised(peers_driver.Method.ldlt)
    return min(_timed(lambda system=system: factor.solve(system.load))[0] for system in made)


def _timed(call: Any) -> tuple[float, Any]:
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
