"""Ours on meshes as users have them, each in turns with a clean patch of the same size."""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1] / "common"))

import fairing
import shapes
import solids
from graded_disc import graded_disc
from real_meshes import DATA
from scan_regions import scan_region
from shapes import Style

NOISE = 0.1  # edges
GOAL = 2.0  # times a clean patch
Input = tuple[Any, Any, dict[str, Any]]  # vertices, triangles, the rest


@dataclass(frozen=True)
class Timed:
    """Seconds of the processor, medians, and how the solve ended; `clean`: of the clean patch."""

    free: int
    cpu: float
    clean: float
    state: str
    converged: bool


def head(size: int) -> Input:
    """A region of a head, subdivided, with noise on all vertices."""
    made = scan_region("ict_head", NOISE, size)
    return made.vertices, made.triangles, {"fixed": made.fixed, "fixed_normals": made.normals}


def graded(size: int) -> Input:
    """The hemisphere of an edge ratio of 40."""
    return _of(graded_disc(size, Style()))


def quads(size: int) -> Input:
    """A grid of quads on a hemisphere, each cut in two."""
    vertices, triangles, fixed = solids.cube_cap(2 * round(0.5 * (size / 3.0) ** 0.5))  # 3 quads² vertices
    return vertices, triangles, {"fixed": fixed, "fixed_normals": vertices[fixed]}


MESHES: dict[str, Callable[[int], Input]] = {
    f"head, subdivided, noise of {NOISE} edges": head, "graded hemisphere": graded, "quads": quads,
}  # fmt: skip


def available(name: str) -> bool:
    """The head needs the meshes of shared/data."""
    return MESHES[name] is not head or DATA.exists()


def timed(name: str, size: int, calls: int) -> Timed:
    """One thread, in turns: the processor's seconds hold on a busy machine, too."""
    made = MESHES[name](size)
    free = len(made[0]) - len(made[2]["fixed"])
    clean = _of(shapes.cap(free))
    pairs = [(_clocked(made), _clocked(clean)) for _ in range(calls)]
    result = pairs[0][0][0]
    cpu, cpu_clean = (statistics.median(pair[k][1] for pair in pairs) for k in (0, 1))
    state = ", ".join(name for name, _ in result.way)
    ended = state if result.converged else f"{state}: {result.termination}"
    return Timed(free, cpu, cpu_clean, ended, result.converged)


def _of(patch: shapes.Patch) -> Input:
    return patch.vertices, patch.triangles, {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals}


def _clocked(made: Input) -> tuple[fairing.FairResult, float]:
    vertices, triangles, options = made
    start = time.process_time()
    result = fairing.fair(vertices, triangles, threads=1, **options)
    return result, time.process_time() - start
