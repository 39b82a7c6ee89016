"""The tables of docs/performance.md."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import tools
from measured import Measured, Row
from problems import CAPS
from tools import OURS, SMOOTHING_STEPS


def _table(head: list[str], rows: Iterable[list[str]]) -> str:
    lines = [head, ["---"] + ["--:"] * (len(head) - 1), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def machine(done: Measured) -> str:
    """A sentence."""
    words = dict(done.machine)
    processor, cores, load = (words.pop(name) for name in ("processor", "cores", "load"))
    return f"{processor}, {cores} cores, load {load} before the start; " + ", ".join(
        f"{name} {number}" for name, number in words.items()
    )


def times(done: Measured) -> str:
    """Wall and processor seconds of the first shape that has several sizes, a column for each size."""
    shapes = dict.fromkeys(row["shape"] for row in done.times)
    shape = next(shape for shape in shapes if len(_sizes(done, shape)) > 1)
    return f"**{shape}**\n\n{_times_of(done, shape)}"


def _sizes(done: Measured, shape: str) -> list[int]:
    return sorted({row["free"] for row in done.times if row["shape"] == shape})


def _times_of(done: Measured, shape: str) -> str:
    sizes = _sizes(done, shape)
    cells = {(row["tool"], row["free"]): _seconds(row) for row in done.times if row["shape"] == shape}
    rows = [
        [name, tool.threads, *(cells.get((name, free), "–") for free in sizes)] for name, tool in tools.BY_NAME.items()
    ]  # fmt: skip
    return _table(
        ["tool, seconds by the wall (of the processor)", "threads", *(f"{free:,} free" for free in sizes)], rows
    )


def _seconds(row: Row) -> str:
    return f"{row['wall']:.3g} ({row['cpu']:.3g})" if "wall" in row else row["failure"]


def errors(done: Measured) -> str:
    """A row for each shape whose exact surface is known: ours beside the nearest of the linear tools."""
    rows = []
    for shape in _judged_shapes(done):
        found = {row["tool"]: row["error"] for row in done.quality if row["shape"] == shape}
        peers = {name: error for name, error in found.items() if tools.BY_NAME[name].kind == "peer"}
        nearest = min(peers, key=lambda name: peers[name])
        if found[OURS] == found[OURS]:  # not nan
            rows.append([shape, f"{found[OURS]:.1e}", f"{peers[nearest]:.1e}, {nearest}"])
    return _table(["patch", "ours", "nearest linear tool"], rows)


def _judged_shapes(done: Measured) -> list[str]:
    shapes = list(dict.fromkeys(row["shape"] for row in done.quality))
    return [*CAPS, *(shape for shape in shapes if shape not in CAPS)]


def steps(_: Measured) -> str:
    """Of PyMeshLab's smoothing."""
    return str(SMOOTHING_STEPS)


def quality_size(done: Measured) -> str:
    """Free vertices wanted in the table of errors."""
    return f"{min(row['size'] for row in done.times):,}"


BY_NAME: dict[str, Callable[[Measured], str]] = {
    "machine": machine, "times": times,
    "errors": errors, "quality_size": quality_size, "steps": steps,
}  # fmt: skip
