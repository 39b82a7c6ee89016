"""The measurements of one run, as plain rows that are kept in a file for the page."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

import clock
import fairing
import live_rows
import memory
import real_rows
from problems import BLEND, IRREGULAR, PATCHES, REGULAR, problem
from tools import BY_NAME, OURS, TOOLS, Tool

SHAPES = [name for name in PATCHES if name != "graded hemisphere"] + [BLEND]
UNEVEN = (1_000, 10_000)
REAL = (10_000, 30_000, 100_000)
LARGEST_FOR_ALL = 256_000  # beyond, ours and the peers alone: others take hours
Row = dict[str, Any]


@dataclass
class Measured:
    """Rows of dictionaries; `machine` in words."""

    machine: Row = field(default_factory=dict)
    times: list[Row] = field(default_factory=list)
    live: list[Row] = field(default_factory=list)
    memory: list[Row] = field(default_factory=list)
    quality: list[Row] = field(default_factory=list)
    real: list[Row] = field(default_factory=list)
    irregular: list[Row] = field(default_factory=list)

    def save(self, path: Path) -> None:
        """As JSON."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1, ensure_ascii=False))

    @staticmethod
    def load(path: Path) -> Measured:
        """What `save` wrote."""
        return Measured(**json.loads(path.read_text()))


@dataclass(frozen=True)
class Plan:
    """sizes: free vertices; limit: seconds that one call is expected to take at most; folder: of meshes; calls: of a
    tool at most; parts: what is measured, the rest being kept from the file of the run before."""

    sizes: list[int]
    limit: float
    folder: Path
    calls: int
    parts: tuple[str, ...]


def run(plan: Plan, path: Path) -> Measured:
    """Saved after each row."""
    done = Measured.load(path) if set(plan.parts) != set(PARTS) else Measured()
    done.machine = _machine()
    for part in plan.parts:
        rows: list[Row] = []
        setattr(done, part, rows)
        for row in PARTS[part](plan, done):
            rows.append(row)
            print(_shown(row), flush=True)
            done.save(path)
    return done


def _shown(row: Row) -> str:
    return "  ".join(f"{value:.4g}" if isinstance(value, float) else str(value) for value in row.values())


def _machine() -> Row:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.machine())
    names = ("libigl", "meshlib", "pymeshlab", "numpy", "scipy")
    return {
        "processor": model, "cores": sum(line.startswith("processor") for line in lines),
        "load": round(os.getloadavg()[0], 1),
        "fairing": fairing.__version__, **{name: version(name) for name in names},
    }  # fmt: skip


def shapes_at(size: int) -> list[str]:
    """All at 10k, two at 100k, the hemisphere above."""
    return SHAPES if size <= 10_000 else ["hemisphere", "catenoid"] if size <= 100_000 else ["hemisphere"]


def _times(plan: Plan, _done: Measured) -> Iterator[Row]:
    known: dict[str, tuple[int, float]] = {}
    for size in sorted(plan.sizes):
        for shape in shapes_at(size):
            made = problem(plan.folder, shape, size)
            free = len(made.free)
            wanted = [tool for tool in TOOLS if size <= LARGEST_FOR_ALL or tool.kind == "peer" or tool.name == OURS]
            possible = [tool for tool in wanted if _expected(tool, free, known) < plan.limit]
            clocked = clock.interleaved(made, possible, plan.calls)
            for tool in wanted:
                row = {"shape": shape, "size": size, "free": free, "tool": tool.name}
                if tool not in possible:
                    yield {**row, "failure": f"not run: {_expected(tool, free, known):.0f} s expected"}
                    continue
                yield {**row, **_clocked(made, clocked[tool.name])}
            known.update({name: (free, min(found.wall)) for name, found in clocked.items() if found.wall})


def _expected(tool: Tool, free: int, known: dict[str, tuple[int, float]]) -> float:
    """Seconds, from a smaller size."""
    before, seconds = known.get(tool.name, (free, 0.0))
    return float(seconds * (free / before) ** (1 + tool.growth))


def _clocked(made: Any, found: clock.Clocked) -> Row:
    if found.answer is None:
        return {"failure": found.failure}
    return {
        "wall": min(found.wall), "cpu": min(found.cpu), "calls": len(found.wall),
        "error": clock.error(made, found.answer), "steps": found.answer.steps, "state": found.answer.state,
    }  # fmt: skip


def _live(plan: Plan, _done: Measured) -> Iterator[Row]:
    """Ours on the sizes of an edit."""
    for size in live_rows.SIZES:
        for shape in live_rows.SHAPES:
            yield {"shape": shape, "size": size, **asdict(live_rows.timed(problem(plan.folder, shape, size)))}


def _irregular(plan: Plan, _done: Measured) -> Iterator[Row]:
    """Ours on irregular and regular meshes of a surface, the fast peers on the same irregular one."""
    peers = [tool for tool in TOOLS if tool.kind == "peer" and not tool.alike]
    for size in UNEVEN:
        for shape in ("hemisphere", "cylinder", "catenoid"):
            for style, tools in ((IRREGULAR, [BY_NAME[OURS], *peers]), (REGULAR, [BY_NAME[OURS]])):
                made = problem(plan.folder, shape, size, style)
                for name, clocked in clock.interleaved(made, tools, plan.calls).items():
                    kind = {"shape": shape, "size": size, "free": len(made.free), "regular": style == REGULAR}
                    yield {**kind, "tool": name, **_clocked(made, clocked)}


def _real(plan: Plan, _done: Measured) -> Iterator[Row]:
    """Up to the largest size of the run."""
    for size in (size for size in REAL if size <= max(plan.sizes)):
        for name in filter(real_rows.available, real_rows.MESHES):
            yield {"mesh": name, "size": size, **asdict(real_rows.timed(name, size, min(plan.calls, 3)))}


def _memory(plan: Plan, done: Measured) -> Iterator[Row]:
    """Of every tool that was timed at 100k; of ours at the largest size."""
    for size in sorted({100_000, max(plan.sizes)} & set(plan.sizes)):
        timed = {row["tool"] for row in done.times if row["size"] == size and "wall" in row}
        for tool in TOOLS:
            if tool.name in timed and (size <= LARGEST_FOR_ALL or tool.name == OURS):
                used = memory.above_input(plan.folder, "hemisphere", size, tool.name)
                yield {"size": size, "tool": tool.name, "megabytes": used}


def _quality(plan: Plan, _done: Measured) -> Iterator[Row]:
    size = min(plan.sizes)
    for shape in SHAPES:
        made = problem(plan.folder, shape, size)
        for tool in TOOLS:
            if not tool.alike:
                yield {"shape": shape, "tool": tool.name, "error": clock.error(made, tool.call(made))}


PARTS: dict[str, Callable[[Plan, Measured], Iterator[Row]]] = {
    "times": _times,
    "live": _live,
    "real": _real,
    "irregular": _irregular,
    "memory": _memory,
    "quality": _quality,
}
