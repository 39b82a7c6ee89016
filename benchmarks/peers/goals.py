"""The figures to reach, each with what this run measured."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from statistics import median

from live_rows import GOALS as LIVE
from measured import Measured, Row
from real_rows import GOAL
from tools import BY_NAME, CHOLMOD, LDLT, OURS


@dataclass(frozen=True)
class Goal:
    """measured against `most`; None where this run doesn't say. `unsolved`: where no surface was found."""

    text: str
    most: float
    measured: float | None
    note: str = ""
    unit: str = ""
    unsolved: tuple[str, ...] = ()

    @property
    def verdict(self) -> str:
        """One or two words."""
        if self.measured is None:
            return "not measured"
        if self.unsolved:
            return f"**missed**: no surface ({', '.join(self.unsolved)})"
        return "met" if self.measured <= self.most else "**missed**"

    def line(self, notes: bool) -> str:
        """A row of the table, with its note or without."""
        value = "–" if self.measured is None else f"{self.measured:.3g}{self.unit}"
        return f"| {self.text} | ≤ {self.most:g}{self.unit} | {value} | {self.verdict} |" + (
            f" {self.note} |" if notes else ""
        )


def goals(done: Measured) -> list[Goal]:
    """In the order of the plan."""
    return [
        *_ratios(done), *_live(done), *_growth(done), *_memory(done),
        *_irregular(done), *_real(done), *_steps(done),
    ]  # fmt: skip


def table(done: Measured, notes: bool = False) -> str:
    """As Markdown; the notes name the worst shape."""
    head = "| | goal | measured | |" + " |" * notes + "\n| --- | --: | --: | --- |" + " --- |" * notes
    return "\n".join([head, *(goal.line(notes) for goal in goals(done))])


def _at(done: Measured, size: int) -> dict[str, dict[str, Row]]:
    """Timed rows of a size by shape, then tool."""
    found: dict[str, dict[str, Row]] = {}
    for row in done.times:
        if row["size"] == size and "wall" in row:
            found.setdefault(row["shape"], {})[row["tool"]] = row
    return found


def busy(done: Measured) -> bool:
    """Whether wall-clock times of this run can't be trusted: BLAS threads that wait for a core would flatter us."""
    return bool(done.machine["load"] > 0.5 * done.machine["cores"])


def _ratios(done: Measured) -> Iterator[Goal]:
    peers = tuple(name for name, tool in BY_NAME.items() if tool.kind == "peer")
    for names, text, goals_at in (
        (peers, "the fastest peer", {10_000: 1.0, 100_000: 0.5, 1_000_000: 0.05}),
        ((LDLT,), LDLT, {10_000: 1.0, 100_000: 0.25, 256_000: 0.1}),
        ((CHOLMOD,), CHOLMOD, {10_000: 1.0, 100_000: 0.5}),
    ):
        for size, ratio in goals_at.items():
            found = sorted(_compared(_at(done, size), names, busy(done)))
            title = f"whole call ÷ {text}, {_thousands(size)}"
            lost = _unsolved(_at(done, size))
            yield Goal(title, ratio, *_worst(found), unsolved=lost) if found else Goal(title, ratio, None)


def _compared(rows: dict[str, dict[str, Row]], names: tuple[str, ...], busy: bool) -> Iterator[tuple[float, str, str]]:
    """For each shape: our time over that of the fastest of `names`, the shape, details."""
    for shape, by_tool in rows.items():
        others = [by_tool[name] for name in names if name in by_tool]
        if others and OURS in by_tool:
            ratios = {clock: by_tool[OURS][clock] / min(row[clock] for row in others) for clock in ("wall", "cpu")}
            against = f" against {min(others, key=lambda row: row['wall'])['tool']}" if len(names) > 1 else ""
            note = f"{shape}{against}; by the wall {ratios['wall']:.2g}, by processor time {ratios['cpu']:.2g}"
            yield max(ratios.values()) if busy else ratios["wall"], shape, note


def _unsolved(rows: dict[str, dict[str, Row]]) -> tuple[str, ...]:
    """Shapes for which ours ended without a surface."""
    return tuple(
        shape for shape, tools in rows.items() if OURS in tools and not tools[OURS]["state"].startswith("converged")
    )


def _worst(found: list[tuple[float, str, str]]) -> tuple[float, str]:
    """The largest ratio with its note, and the best shape's."""
    best = f"; best {found[0][0]:.2g} ({found[0][1]})" if len(found) > 1 else ""
    return found[-1][0], found[-1][2] + best


def _thousands(size: int) -> str:
    return f"{size // 1000}k" if size < 1_000_000 else f"{size // 1_000_000}M"


def _steps(done: Measured) -> Iterator[Goal]:
    rows = [row for row in done.times if row["tool"] == OURS and "steps" in row]
    steps = {f"{row['shape']}, {_thousands(row['size'])}": row["steps"] for row in rows}
    if steps:
        worst = max(steps, key=lambda name: steps[name])
        yield Goal(
            "outer steps on the finest level, median of all rows", 4, median(steps.values()), f"{len(steps)} rows"
        )
        yield Goal("outer steps on the finest level, worst", 8, steps[worst], worst)


def _live(done: Measured) -> Iterator[Goal]:
    for size, most in LIVE.items():
        found = {row["shape"]: 1000 * row["wall"] for row in done.live if row["size"] == size}
        note = ", ".join(f"{shape} {milliseconds:.3g}" for shape, milliseconds in found.items())
        yield Goal(f"whole call, {size:,}", most, max(found.values(), default=None), note, unit=" ms")


def _growth(done: Measured) -> Iterator[Goal]:
    text = "time per vertex from 10k to 1M, ± around the middle"
    rows = {
        size: _at(done, size).get("hemisphere", {}).get(OURS) for size in sorted({row["size"] for row in done.times})
    }
    each = {size: 1e6 * row["wall"] / row["free"] for size, row in rows.items() if row}
    if 10_000 not in each or 1_000_000 not in each:
        yield Goal(text, 20, None, unit=" %")
        return
    least, most = min(each.values()), max(each.values())
    note = "µs: " + ", ".join(f"{_thousands(size)} {microseconds:.3g}" for size, microseconds in each.items())
    yield Goal(text, 20, 100 * (most - least) / (most + least), note, unit=" %")


def _memory(done: Measured) -> Iterator[Goal]:
    used = [row["megabytes"] for row in done.memory if row["tool"] == OURS and row["size"] == 1_000_000]
    yield Goal("memory above the input, 1M", 1.2, used[0] / 1000 if used else None, unit=" GB")


def _irregular(done: Measured) -> Iterator[Goal]:
    ours = [row for row in done.irregular if row["tool"] == OURS and "cpu" in row]
    for size in sorted({row["size"] for row in ours}):
        each = {(row["shape"], row["regular"]): row for row in ours if row["size"] == size}
        shapes = [shape for shape, regular in each if regular and (shape, False) in each]
        ratios = {shape: _each(each[shape, False]) / _each(each[shape, True]) for shape in shapes}
        note = ", ".join(f"{shape} {ratio:.2g}" for shape, ratio in ratios.items())
        lost = tuple(shape for shape in shapes if not each[shape, False]["state"].startswith("converged"))
        yield Goal(f"irregular ÷ regular, {_thousands(size)}", 3, max(ratios.values()), note, unsolved=lost)


def _each(row: Row) -> float:
    """Seconds of the processor for each free vertex."""
    return float(row["cpu"] / row["free"])


def _real(done: Measured) -> Iterator[Goal]:
    for name in dict.fromkeys(row["mesh"] for row in done.real):
        ratios = {_thousands(row["size"]): row["cpu"] / row["clean"] for row in done.real if row["mesh"] == name}
        worst = max(ratios, key=lambda size: ratios[size])
        note = ", ".join(f"{size} {ratio:.2g}" for size, ratio in ratios.items())
        # How fast the engine gives up is no figure.
        lost = tuple(_thousands(row["size"]) for row in done.real if row["mesh"] == name and not row["converged"])
        yield Goal(f"{name} ÷ a clean patch of its size", GOAL, ratios[worst], note, unsolved=lost)
