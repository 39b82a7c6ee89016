"""Pictures of the tables: error against h, goals beside it."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report import WEIGHTS, Row

matplotlib.use("Agg")
import matplotlib.pyplot as plt

TABLES = ("graded", "jittered", "strong")
MARKERS = "osv^"  # of the λ in the order of WEIGHTS


def save(tables: dict[str, list[Row]], folder: Path) -> None:
    """accuracy_convergence.png: the tables that have several sizes side by side; accuracy_goals.png: all rows."""
    folder.mkdir(parents=True, exist_ok=True)
    chosen = [name for name in TABLES if tables.get(name)]
    if chosen:
        figure, axes = plt.subplots(1, len(chosen), figsize=(4.4 * len(chosen), 5.4), squeeze=False, sharey=True)
        for axis, name in zip(axes[0], chosen, strict=True):
            _convergence(axis, name, tables[name])
        axes[0, 0].set_ylabel("largest distance to the exact surface / D")
        _finished(figure, folder / "accuracy_convergence.png")
    if tables:
        _goals(tables, folder / "accuracy_goals.png")


def _finished(figure: Figure, path: Path) -> None:
    figure.tight_layout()
    figure.savefig(path, dpi=135)
    plt.close(figure)


def _convergence(axis: Axes, name: str, rows: list[Row]) -> None:
    """One line for each case and λ; goals as grey bars."""
    lines: dict[tuple[str, str], list[Row]] = defaultdict(list)
    for row in rows:
        if row.size and np.isfinite(row.measured):
            lines[row.case, row.options].append(row)
    cases = list(dict.fromkeys(case for case, _ in lines))
    for (case, weights), points in lines.items():
        h = [row.size**-0.5 for row in points]
        axis.plot(h, [row.goal for row in points], "_", color="0.6", markersize=16, markeredgewidth=2)
        error = [max(row.measured, 1e-12) for row in points]
        colour, marker = f"C{cases.index(case)}", MARKERS[WEIGHTS.index(weights)]
        label = f"{case.removeprefix('strongly ').removeprefix(name).removeprefix('jittered').strip()}, {weights}"
        axis.plot(h, error, marker=marker, color=colour, label=label, linewidth=1, markersize=5, alpha=0.8)
    axis.set_xscale("log")
    axis.set_yscale("log")
    sizes = sorted({round(row.size, -3) for row in rows if row.size})
    axis.set_xticks([size**-0.5 for size in sizes], [f"{size // 1000}k" for size in sizes])
    axis.minorticks_off()
    axis.set_title(name)
    axis.set_xlabel("free vertices, placed by h ∼ $n^{-1/2}$;  grey: goals")
    axis.grid(True, which="major", linewidth=0.3)
    axis.legend(fontsize=6, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2, frameon=False)


def _goals(tables: dict[str, list[Row]], path: Path) -> None:
    """Measured over goal of every row, a strip for each table; right of 1 is missed."""
    figure, axis = plt.subplots(figsize=(9, 0.42 * len(tables) + 1.2))
    for height, (_, rows) in enumerate(tables.items()):
        ratios = [row.measured / row.goal if row.goal else np.nan for row in rows]
        for row, ratio in zip(rows, ratios, strict=True):
            shown = max(ratio, 1e-4) if np.isfinite(ratio) else 1e3
            axis.plot(shown, height, "o" if row.met else "x", color="tab:green" if row.met else "tab:red", alpha=0.6)
    axis.axvline(1.0, color="0.4", linewidth=1)
    axis.set_xscale("log")
    axis.set_yticks(range(len(tables)), list(tables))
    axis.invert_yaxis()
    axis.set_xlabel("measured / goal (left of the line: met; cross: missed or not converged; at 1000: refused)")
    _finished(figure, path)
