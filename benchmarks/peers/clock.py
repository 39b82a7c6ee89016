"""Side by side: every tool once, then every tool again, in one process; the least of each counts."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np

from problems import Problem
from tools import Answer, Tool

AT_LEAST = 3  # calls, however long they take together, up to
ENOUGH = 60.0  # seconds after which a tool isn't called again; a sixth of that after AT_LEAST calls


@dataclass
class Clocked:
    """Seconds of each call, by the wall and of the processor (all threads); the last answer, or why there is none."""

    wall: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)
    answer: Answer | None = None
    failure: str = ""

    def call(self, tool: Tool, problem: Problem) -> None:
        """Once more, unless that would take too long or is known to fail."""
        if self.failure or sum(self.wall) > (ENOUGH if len(self.wall) < AT_LEAST else ENOUGH / 6):
            return
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            self.answer = tool.call(problem)
        except (RuntimeError, ValueError, MemoryError) as error:
            self.failure = f"failed: {error}"
            return
        self.wall.append(time.perf_counter() - wall)
        self.cpu.append(time.process_time() - cpu)


def interleaved(problem: Problem, tools: list[Tool], calls: int) -> dict[str, Clocked]:
    """By name of the tool."""
    _ = problem.all_triangles, problem.all_vertices, problem.held, problem.free  # no tool pays for these
    clocked = {tool.name: Clocked() for tool in tools}
    for _ in range(calls):
        for tool in tools:
            clocked[tool.name].call(tool, problem)
    return clocked


def error(problem: Problem, answer: Answer) -> float:
    """Largest distance to the exact surface over D; NaN where that isn't known."""
    away = problem.distance(answer.vertices[problem.free])
    return float(np.nan if away is None else away.max())
