"""Residual and distance to the converged surface against steps and seconds, for both methods, as a plot."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

import fairing
from cases import Case

matplotlib.use("Agg")
from matplotlib import pyplot

MOST = 13  # doublings of the number of updates


@dataclass(frozen=True)
class Course:
    """A method's way: after `steps` of the finest mesh, seconds, residual and largest distance over D."""

    name: str
    steps: list[int]
    seconds: list[float]
    residual: list[float]
    distance: list[float]


def course(name: str, case: Case, stops: list[dict[str, Any]], **options: Any) -> Course:
    """Runs that are stopped ever later, against the last of them."""
    runs = [min((case.fair(**options, **stop) for _ in range(2)), key=_total) for stop in stops]
    runs = [run for k, run in enumerate(runs) if k == 0 or run.iterations > runs[k - 1].iterations]
    return Course(
        name,
        [run.iterations for run in runs],
        [_total(run) for run in runs],
        [run.residual for run in runs],
        [_distance(case, run, runs[-1]) for run in runs],
    )


def _total(run: fairing.FairResult) -> float:
    return run.seconds["total"]


def _distance(case: Case, one: fairing.FairResult, other: fairing.FairResult) -> float:
    return float(np.linalg.norm(one.vertices - other.vertices, axis=1).max() / case.diameter)


def convergence_plot(case: Case, path: Path) -> str:
    """Two rows (residual, distance) by two columns (steps, seconds)."""
    updates = [{"max_iterations": 2**power} for power in range(MOST)]
    changes = [{"tolerance": 10.0**-power} for power in range(1, 13)]
    plain = {"method": "paper", "paper": fairing.PaperOptions(epsilon=1e-8, acceleration="none")}
    quick = {"method": "paper", "paper": fairing.PaperOptions(epsilon=1e-8)}
    courses = [
        course("paper as published", case, updates, **plain),
        course("paper as published, one level", case, updates, levels=1, **plain),
        course("paper, accelerated (default)", case, updates, **quick),
        course("global, averaged normals", case, changes, normals="averaged"),
        course("global (default)", case, changes),
    ]
    figure, axes = pyplot.subplots(2, 2, figsize=(10, 6.4), sharey="row", sharex="col", layout="constrained")
    for found in courses:
        for row, values in enumerate((found.residual, found.distance)):
            for column, where in enumerate((found.steps, found.seconds)):
                shown = np.array(values) > 0
                axes[row, column].loglog(
                    np.array(where)[shown], np.array(values)[shown], "o-", markersize=3, label=found.name
                )
    axes[0, 0].set_ylabel("max |Δ_B H| D³")
    axes[1, 0].set_ylabel("distance to its converged surface / D")
    axes[1, 0].set_xlabel("updates (paper), steps (global) of the finest mesh")
    axes[1, 1].set_xlabel("seconds, start and hierarchy included")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=120, pil_kwargs={"optimize": True})
    pyplot.close(figure)
    ends = [f"{found.name} {found.steps[-1]} in {found.seconds[-1]:.2f} s" for found in courses]
    return f"Steps of the finest mesh to the last mark: {'; '.join(ends)}."
