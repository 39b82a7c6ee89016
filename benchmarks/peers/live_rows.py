"""Whole calls of ours on small patches, as Live and redo make them."""

from __future__ import annotations

import time
from dataclasses import dataclass

import tools
from problems import Problem

SIZES = (800, 2_000)
SHAPES = ("hemisphere", "cylinder", "catenoid")
CALLS = 15
GOALS = {800: 15.0, 2_000: 30.0}  # ms


@dataclass(frozen=True)
class Timed:
    """Seconds, the least of CALLS, by the wall and of the processor; outer steps of the finest level."""

    free: int
    wall: float
    cpu: float
    steps: int


def timed(problem: Problem) -> Timed:
    """One call after the other."""
    calls = [_clocked(problem) for _ in range(CALLS)]
    return Timed(len(problem.free), min(wall for wall, _, _ in calls), min(cpu for _, cpu, _ in calls), calls[0][2])


def _clocked(problem: Problem) -> tuple[float, float, int]:
    wall, cpu = time.perf_counter(), time.process_time()
    steps = tools.fair(problem).iterations
    return time.perf_counter() - wall, time.process_time() - cpu, steps
