"""The plots of docs/performance.md: time against size, error against time, error against the size of the cap."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib

from measured import Measured, Row
from problems import CAPS
from tools import BY_NAME, OURS

matplotlib.use("Agg")
from matplotlib import pyplot

SHAPE = "hemisphere"
ANGLES = (20, 60, 90)


def save(done: Measured, folder: Path) -> None:
    """Writes performance_peers.png."""
    figure, axes = pyplot.subplots(1, 3, figsize=(14, 4.6), layout="constrained")
    _time_against_size(axes[0], done)
    _error_against_time(axes[1], done)
    _error_against_cap(axes[2], done)
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=5, fontsize="small")
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / "performance_peers.png", dpi=90, pil_kwargs={"optimize": True})
    pyplot.close(figure)


def _of(done: Measured, tool: str) -> list[Row]:
    rows = [row for row in done.times if row["tool"] == tool and row["shape"] == SHAPE and "wall" in row]
    return sorted(rows, key=lambda row: row["free"])


def _style(name: str) -> dict[str, Any]:
    marks = {"ours": "o", "peer": "s", "reference": "^", "smoothing": "x"}
    return {
        "marker": marks[BY_NAME[name].kind],
        "linewidth": 2.4 if name == OURS else 1.0,
        "markersize": 5,
        "label": name,
    }


def _time_against_size(axis: Any, done: Measured) -> None:
    for name in BY_NAME:
        rows = _of(done, name)
        axis.loglog([row["free"] for row in rows], [row["wall"] for row in rows], **_style(name))
    axis.set(xlabel="free vertices", ylabel="seconds, whole call", title=f"{SHAPE}: time against size")


def _error_against_time(axis: Any, done: Measured) -> None:
    for name in BY_NAME:
        rows = _of(done, name)
        axis.loglog([row["wall"] for row in rows], [row["error"] for row in rows], **_style(name))
    axis.set(xlabel="seconds, whole call", ylabel="largest distance / D", title=f"{SHAPE}: error against time")


def _error_against_cap(axis: Any, done: Measured) -> None:
    found = {(row["tool"], row["shape"]): row["error"] for row in done.quality}
    for name in BY_NAME:
        errors = [found.get((name, cap)) for cap in CAPS]
        axis.semilogy(ANGLES, [float("nan") if error is None else error for error in errors], **_style(name))
    axis.set(
        xlabel="half angle of the spherical cap, degrees",
        ylabel="largest distance / D",
        title="error against curvature",
    )
