"""Rows of the tables: a goal, what was measured, whether it was met, and how the solve ended."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from engine import Outcome

WEIGHTS = ("uniform", "conformal", "inverse_distance")


@dataclass(frozen=True)
class Row:
    """One line. `measured` is compared with `goal` (smaller is better); nan where there was nothing to measure.

    converged: whether the solve converged, without which no goal is met; size: free vertices.
    """

    case: str
    size: int
    options: str
    goal: float
    measured: float
    state: str
    converged: bool
    cpu: float
    note: str = ""

    @property
    def met(self) -> bool:
        return self.converged and self.measured <= self.goal

    def line(self) -> str:
        """The Markdown of the row."""
        measured = "–" if np.isnan(self.measured) else f"{self.measured:.2e}"
        met = "yes" if self.met else "**no**"
        seconds = "" if np.isnan(self.cpu) else f"{self.cpu:.2f}"
        size = str(self.size) if self.size else ""
        cells = (self.case, size, self.options, f"{self.goal:.0e}", measured, met, self.state, seconds, self.note)
        return f"| {' | '.join(cells)} |"


HEADER = (
    "| case | free | λ | goal | measured | met | ended | CPU s | note |\n"
    "| --- | --: | --- | --: | --: | --- | --- | --: | --- |"
)


def solved_row(case: str, size: int, options: str, goal: float, measured: float, outcome: Outcome) -> Row:
    """The row of a single solve; the note names warnings and the reason of a refusal."""
    note = outcome.refused if outcome.refused else ", ".join(sorted(set(outcome.codes)))
    return Row(
        case, size, options, goal, measured, outcome.state, outcome.converged, outcome.cpu, note.replace("\n", " ")[:90]
    )


def summary(rows: Iterable[Row]) -> str:
    """How many of the rows met their goal."""
    listed = list(rows)
    return f"{sum(row.met for row in listed)} of {len(listed)} rows met"
