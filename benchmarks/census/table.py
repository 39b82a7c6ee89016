"""The census as a table: what each switch loses, and what it costs."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

Row = dict[str, Any]


def rows_of(path: Path) -> dict[str, Row]:
    """By name."""
    lines = (json.loads(line) for line in path.read_text().splitlines())
    return {row["name"] + row["kind"]: row for row in lines}


def is_equation(row: Row) -> bool:
    """Whether the equation asked for has a surface."""
    return bool(row.get("converged")) and row["provenance"] in ("equation", "low_passed")


def usable(row: Row) -> bool:
    """Whether anything accepted came back."""
    return bool(row.get("converged"))


def ran(row: Row) -> Counter[str]:
    """How often each strategy was the last one, and ran at all."""
    way = row.get("way", [])
    return Counter({f"{name} ran" for name in way} | ({f"{way[-1]} decided"} if way else set()))


def table(folder: Path) -> str:
    """Of all runs in the folder, by seed."""
    text = []
    for base_path in sorted(folder.glob("as it is, seed *.jsonl")):
        seed = base_path.stem.split()[-1]
        base = rows_of(base_path)
        text.append(f"Seed {seed}, {len(base)} problems: {_strategies(base)}\n")
        text.append("| switch | equation lost | gained | usable lost | gained | seconds | p99 | worst exact |")
        text.append("| --- | --: | --: | --: | --: | --: | --: | --: |")
        paths = [base_path, *sorted(p for p in folder.glob(f"*, seed {seed}.jsonl") if p != base_path)]
        text += [_line(path.stem.rsplit(",", 1)[0], base, rows_of(path)) for path in paths]
        text.append("")
    return "\n".join(text)


def _strategies(rows: dict[str, Row]) -> str:
    count: Counter[str] = sum((ran(row) for row in rows.values()), Counter())
    names = sorted({key.rsplit(" ", 1)[0] for key in count})
    return ", ".join(f"{name} decides {count[f'{name} decided']} of {count[f'{name} ran']}" for name in names)


def _line(name: str, base: dict[str, Row], other: dict[str, Row]) -> str:
    both = [(base[key], row) for key, row in other.items() if key in base]
    counts = [
        sum(test(before) > test(after) for before, after in both) if lost else
        sum(test(before) < test(after) for before, after in both)
        for test in (is_equation, usable) for lost in (True, False)
    ]  # fmt: skip
    seconds = [row["seconds"] for _, row in both]
    worst = max((row["distance"] for _, row in both if "distance" in row), default=0.0)
    cells = [*map(str, counts), f"{sum(seconds):.1f}", f"{np.quantile(seconds, 0.99):.2f}", f"{worst:.1e}"]
    return f"| {name} | {' | '.join(cells)} |"
