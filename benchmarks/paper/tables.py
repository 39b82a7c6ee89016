"""The numbers of docs/paper.md: Table 1, distances to exact surfaces."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Any

import fairing
import shapes
from cases import Case
from shapes import Patch, Style

REPEATS = 3  # runs of which the fastest counts
ENOUGH = 4000  # updates that let method "paper" converge, where it does


def timed(case: Case, **options: Any) -> tuple[fairing.FairResult, float]:
    """The run that took the processor the least time, and that time in seconds."""
    runs = []
    for _ in range(REPEATS):
        start = time.process_time()
        result = case.fair(**options)
        runs.append((result, time.process_time() - start))
    return min(runs, key=lambda run: run[1])


def table_one(cases: list[Case]) -> str:
    """Table 1 with ours beside it; method "paper" at two tolerances."""
    lines = [
        "| case | vertices | base mesh (theirs) | paper, s | global, s | 2001, s "
        "| largest boundary angle: paper, global |",
        "| --- " * 7 + "|",
    ]
    for case in cases:
        rough, paper = (timed(case, method="paper", tolerance=t) for t in (1e-4, 1e-6))
        quick, brief = timed(case)
        lines.append(
            f"| {case.name} | {len(case.vertices)} | {paper[0].levels[0]} ({case.base}) "
            f"| {_solving(*rough):.2f}, {_solving(*paper):.2f} | {brief:.2f} | {case.seconds:g} "
            f"| {paper[0].boundary_angle.max():.1f}°, {quick.boundary_angle.max():.1f}° |"
        )
    return "\n".join(lines)


def _solving(run: fairing.FairResult, seconds: float) -> float:
    """The seconds without the hierarchy's share."""
    return seconds * (1 - run.seconds["hierarchy"] / run.seconds["total"])


EXACT: dict[str, Callable[[int], Patch]] = {
    "sphere (60° cap)": partial(shapes.cap, half_angle=60.0),
    "cylinder": shapes.cylinder,
    "cylinder with valence 3": partial(shapes.cylinder, style=Style(valence3=0.1)),
    "catenoid": shapes.catenoid,
    "unduloid": shapes.unduloid,
    "unduloid, triangles 4:1": partial(shapes.unduloid, style=Style(aspect=4.0)),
    "r H′ = c": shapes.linear_flux,
    "clothoid": shapes.clothoid,
}


def accuracy_table(sizes: tuple[int, ...]) -> str:
    """Largest distance to exact surfaces over D on jittered meshes of these sizes."""
    lines = [
        f"| surface, jittered | method paper, {sizes[0]} free (updates) "
        f"| averaged normals, {_list(sizes)} | fitted normals, {_list(sizes)} |",
        "| --- " * 4 + "|",
    ]
    for name, family in EXACT.items():
        patches = [family(size) for size in sizes]
        own = _fair(patches[0], method="paper", max_iterations=ENOUGH)
        cells = [f"{patches[0].error(own.vertices):.1e} ({own.iterations}{_star(own)})"]
        for normals in ("averaged", "fitted"):
            runs = [_fair(patch, normals=normals, tolerance=1e-9) for patch in patches]
            cells.append(" / ".join(f"{p.error(r.vertices):.1e}{_star(r)}" for p, r in zip(patches, runs, strict=True)))
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _star(run: fairing.FairResult) -> str:
    """Marks runs that did not converge, and those that hold on the proxy mesh only."""
    return "" if run.converged and run.polished else "†" if run.converged else "\\*"


def _list(sizes: tuple[int, ...]) -> str:
    return " / ".join(str(size) for size in sizes)


def _fair(patch: Patch, **options: Any) -> fairing.FairResult:
    """From the boundary alone."""
    return fairing.fair(
        shapes.start_from_nothing(patch), patch.triangles,
        fixed=patch.fixed, fixed_normals=patch.fixed_normals, **options,
    )  # fmt: skip
