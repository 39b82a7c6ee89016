"""The figures to reach, each with what this run measured."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from statistics import median

from measured import Measured, Row
from real_rows import GOAL
from tools import BY_NAME, CHOLMOD, LDLT, OURS


@dataclass(frozen=True)
class Goal:
    """measured against `most`; None where this run doesn't say. strict: equality misses."""

    text: str
    most: float
    measured: float | None
    note: str = ""
    strict: bool = False
    unit: str = ""

    @property
    def verdict(self) -> str:
        """One or two words."""
        if self.measured is None:
            return "not measured"
        met = self.measured < self.most if self.strict else self.measured <= self.most
        return "met" if met else "**missed**"

    def line(self) -> str:
        """A row of the table."""
        value = "–" if self.measured is None else f"{self.measured:.3g}{self.unit}"
        sign = "<" if self.strict else "≤"
        return f"| {self.text} | {sign} {self.most:g}{self.unit} | {value} | {self.verdict} | {self.note} |"


def goals(done: Measured) -> list[Goal]:
    """In the order of the plan."""
    return [
        *_ratios(done), *_steps(done), *_growth(done), *_memory(done), *_repeated(done), *_graded(done), *_real(done),
    ]  # fmt: skip


def table(done: Measured) -> str:
    """As Markdown."""
    head = "| | goal | measured | | |\n| --- | --: | --: | --- | --- |\n"
    return head + "\n".join(goal.line() for goal in goals(done))


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
    against_ldlt = {10_000: 1.0, 100_000: 0.25, 256_000: 0.1}
    against_peers = {10_000: 1.0, 100_000: 0.5, 1_000_000: 0.1}
    peers = tuple(name for name, tool in BY_NAME.items() if tool.kind == "peer")
    for names, text, most in (
        ((LDLT,), LDLT, against_ldlt),
        (peers, "the fastest peer", against_peers),
        ((CHOLMOD,), CHOLMOD, against_peers),
    ):
        for size, ratio in most.items():
            found = sorted(_compared(_at(done, size), names, busy(done)))
            title = f"whole call ÷ {text}, {_thousands(size)}"
            strict = ratio == 1.0 and len(names) > 1
            yield Goal(title, ratio, *_worst(found), strict) if found else Goal(title, ratio, None)


def _compared(rows: dict[str, dict[str, Row]], names: tuple[str, ...], busy: bool) -> Iterator[tuple[float, str, str]]:
    """For each shape: our time over that of the fastest of `names`, the shape, details."""
    for shape, by_tool in rows.items():
        others = [by_tool[name] for name in names if name in by_tool]
        if others and OURS in by_tool:
            ratios = {clock: by_tool[OURS][clock] / min(row[clock] for row in others) for clock in ("wall", "cpu")}
            against = f" against {min(others, key=lambda row: row['wall'])['tool']}" if len(names) > 1 else ""
            note = f"{shape}{against}; by the wall {ratios['wall']:.2g}, by processor time {ratios['cpu']:.2g}"
            yield max(ratios.values()) if busy else ratios["wall"], shape, note


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


def _growth(done: Measured) -> Iterator[Goal]:
    text = "time per vertex, 1M ÷ 100k"
    rows = [_at(done, size).get("hemisphere", {}).get(OURS) for size in (100_000, 1_000_000)]
    if rows[0] is None or rows[1] is None:
        yield Goal(text, 1.3, None)
        return
    each = [1e6 * row["wall"] / row["free"] for row in rows if row]
    yield Goal(text, 1.3, each[1] / each[0], f"{each[0]:.1f} and {each[1]:.1f} µs")


def _memory(done: Measured) -> Iterator[Goal]:
    used = [row["megabytes"] for row in done.memory if row["tool"] == OURS and row["size"] == 1_000_000]
    yield Goal("memory above the input, 1M", 1.2, used[0] / 1000 if used else None, unit=" GB")


def _repeated(done: Measured) -> Iterator[Goal]:
    for size, most in ((2_000, 33.0), (10_000, 150.0)):
        rows = [row for row in done.repeated if row["size"] == size]
        slowest = max((1000 * row["median"] for row in rows), default=None)
        note = "; ".join(f"{row['shape']}: linear back-substitution {1000 * row['linear']:.2g} ms" for row in rows)
        text = f"`Solver.solve` after a small boundary move, {_thousands(size)}"
        yield Goal(text, most, slowest, note or "this engine has no `fairing.Solver`", unit=" ms")


def _graded(done: Measured) -> Iterator[Goal]:
    text = "graded irregular 100k (edge ratio 40) ÷ regular 100k"
    walls = {row["kind"]: row["wall"] / row["free"] for row in done.graded if "wall" in row}
    ratio = walls["graded irregular"] / walls["regular"] if len(walls) == 2 else None
    yield Goal(text, 2, ratio, "per vertex")


def _real(done: Measured) -> Iterator[Goal]:
    for name in dict.fromkeys(row["mesh"] for row in done.real):
        ratios = {_thousands(row["size"]): row["cpu"] / row["clean"] for row in done.real if row["mesh"] == name}
        worst = max(ratios, key=lambda size: ratios[size])
        note = ", ".join(f"{size} {ratio:.2g}" for size, ratio in ratios.items())
        yield Goal(f"{name} ÷ a clean patch of its size", GOAL, ratios[worst], note)
