"""How soon a run can be cancelled and how evenly its progress moves, as Markdown.

    python benchmarks/cancel.py [--size 100000] [--even] [--ways global:uniform,paper:uniform]

The longest stretches without a call of `progress` (goal: 0.3 s), by the wall, from the call's beginning to its end;
the largest difference between the fraction told and the share of the time. A graded irregular hemisphere, or with
--even a jittered one.
"""

from __future__ import annotations

import argparse
import sys
import time
from itertools import pairwise
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parent / "peers"))

import fairing
import hard_inputs
import shapes
from graded_disc import graded_disc
from hard_inputs import KINDS, Input
from shapes import Style

WAYS = [("global", kind) for kind in KINDS] + [("paper", "uniform")]
GOAL = 0.3  # seconds


def calls(item: Input, method: str, kind: str) -> list[tuple[float, float, str]]:
    """When `progress` was called, with which fraction and stage; first and last are the beginning and the end."""
    found = [(time.perf_counter(), 0.0, "arguments")]

    def ask(fraction: float, stage: str) -> None:
        found.append((time.perf_counter(), fraction, stage))

    fairing.fair(
        item.vertices, item.triangles, fixed=item.fixed, fixed_normals=item.normals, reference=item.reference,
        method=method, inner_fairness=kind, progress=ask,
    )  # fmt: skip
    found.append((time.perf_counter(), 1.0, "result"))
    return found


def row(item: Input, method: str, kind: str) -> tuple[str, float]:
    """A line of the table and the longest stretch."""
    found = calls(item, method, kind)
    begin, total = found[0][0], found[-1][0] - found[0][0]
    stretches = sorted(((after[0] - before[0], before[2]) for before, after in pairwise(found)), reverse=True)
    lag = max(abs((when - begin) / total - fraction) for when, fraction, _ in found)
    told = ", ".join(f"{seconds:.2f} after “{stage}”" for seconds, stage in stretches[:3])
    return f"| {method} | {kind} | {total:.1f} | {len(found) - 2} | {lag:.2f} | {told} |", stretches[0][0]


def main() -> None:
    """Prints the table; the status is 1 where the goal is missed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=100_000, help="free vertices")
    parser.add_argument("--even", action="store_true", help="a jittered mesh instead of a graded one")
    parser.add_argument("--ways", default=",".join(":".join(way) for way in WAYS), help="method:inner fairness, …")
    options = parser.parse_args()
    patch = shapes.cap(options.size) if options.even else graded_disc(options.size, Style(seed=1))
    item = hard_inputs.of_patch(patch)
    print(f"{len(item.vertices) - len(item.fixed)} free vertices\n")
    print("| method | inner fairness | s | calls | off the time | longest stretches, s |")
    print("| --- | --- | --: | --: | --: | --- |")
    longest = 0.0
    for way in options.ways.split(","):
        method, kind = way.split(":")
        line, stretch = row(item, method, kind)
        print(line, flush=True)
        longest = max(longest, stretch)
    sys.exit(longest > GOAL)


if __name__ == "__main__":
    main()
