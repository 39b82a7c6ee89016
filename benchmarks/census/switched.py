"""Rows of limits.toml on calls of one kind: what each changes, loses and costs."""

from __future__ import annotations

import hashlib
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import fairing
from calls import Call, calls

ROWS = Path(__file__).parent / "limits.toml"


@dataclass(frozen=True)
class Ended:
    """What a call came to. `bits`: of the positions, or the error."""

    bits: str
    usable: bool
    equation: bool
    warnings: tuple[str, ...]
    distance: float
    seconds: float


def ended(call: Call) -> Ended:
    """Of one call."""
    _, solve, problem = call
    begun = time.process_time()
    try:
        result = solve()
    except (fairing.MeshError, fairing.SolverError, ValueError) as error:
        return Ended(str(error), False, False, (), 0.0, time.process_time() - begun)
    seconds = time.process_time() - begun
    bits = hashlib.sha256(np.ascontiguousarray(result.vertices).tobytes()).hexdigest()
    found = bool(result.converged)
    own = found and getattr(result, "provenance", "equation") in ("equation", "low_passed")
    away = 0.0
    if problem is not None and problem.surface is not None:
        away = float(np.abs(problem.surface.distance(result.vertices)).max() / problem.diameter)
    return Ended(bits, found, own, tuple(sorted(each.code for each in result.warnings)), away, seconds)


def report(core: Any, kind: str, count: int, seed: int) -> None:
    """Prints a line of the table for each row of that kind; `core`: the module with settable limits."""
    rows = [row for row in tomllib.loads(ROWS.read_text())["row"] if row["kind"] == kind]
    made = list(calls(kind, count, seed))
    before = [ended(call) for call in made]
    given: dict[str, float] = core.limits()
    usable = sum(each.usable for each in before)
    print(f"{kind}, seed {seed}: {len(made)} calls, {usable} usable, {sum(each.seconds for each in before):.1f} s")
    print("| row | changed | warnings | equation lost | gained | usable lost | gained | seconds | distance ÷ |")
    print("| --- | --: | --: | --: | --: | --: | --: | --: | --: |")
    for row in rows:
        _set(core, {name: value for name, value in row["set"].items() if name in given})
        after = [ended(call) for call in made]
        _set(core, {name: given[name] for name in row["set"] if name in given})
        unknown = [name for name in row["set"] if name not in given]
        print(_line(row["name"] + (f" (not reached: {', '.join(unknown)})" if unknown else ""), before, after))


def _set(core: Any, values: dict[str, float]) -> None:
    for name, value in values.items():
        core.set_limit(name, value)


def _line(name: str, before: list[Ended], after: list[Ended]) -> str:
    pairs = list(zip(before, after, strict=True))
    counts = [
        sum(a.bits != b.bits for a, b in pairs), sum(a.warnings != b.warnings for a, b in pairs),
        sum(a.equation > b.equation for a, b in pairs), sum(a.equation < b.equation for a, b in pairs),
        sum(a.usable > b.usable for a, b in pairs), sum(a.usable < b.usable for a, b in pairs),
    ]  # fmt: skip
    farther = max((b.distance / a.distance for a, b in pairs if a.distance > 0.0), default=1.0)
    seconds = sum(b.seconds for _, b in pairs)
    return f"| {name} | {' | '.join(map(str, counts))} | {seconds:.1f} | {farther:.2f} |"
