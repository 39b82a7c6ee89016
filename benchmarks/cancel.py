"""How soon a run can be cancelled, as Markdown: the longest stretches without a call of `progress`; the goal is 0.3 s.

    python benchmarks/cancel.py [--size 100000]

Wall-clock time from the call's beginning to the first call of `progress`, between calls, and from the last one to the
end. The mesh is a graded irregular hemisphere.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parent / "peers"))

import fairing
import hard_inputs
from graded_disc import graded_disc
from hard_inputs import KINDS, Input
from shapes import Style

WAYS = [("global", kind) for kind in KINDS] + [("paper", "uniform")]
GOAL = 0.3  # seconds


def stretches(item: Input, method: str, kind: str) -> list[tuple[float, str]]:
    """Seconds between two calls of `progress`, and the stage before."""
    found: list[tuple[float, str]] = []
    last = time.perf_counter(), "arguments"

    def ask(_fraction: float, stage: str) -> None:
        nonlocal last
        now = time.perf_counter()
        found.append((now - last[0], last[1]))
        last = now, stage

    fairing.fair(
        item.vertices, item.triangles, fixed=item.fixed, fixed_normals=item.normals, reference=item.reference,
        method=method, inner_fairness=kind, progress=ask,
    )  # fmt: skip
    found.append((time.perf_counter() - last[0], last[1]))
    return found


def main() -> None:
    """Prints the table; the status is 1 where the goal is missed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=100_000, help="free vertices")
    item = hard_inputs.of_patch(graded_disc(parser.parse_args().size, Style(seed=1)))
    print(f"{len(item.vertices) - len(item.fixed)} free vertices\n")
    print("| method | inner fairness | s | calls | longest stretches, s |\n| --- | --- | --: | --: | --- |")
    missed = False
    for method, kind in WAYS:
        found = stretches(item, method, kind)
        worst = sorted(found, reverse=True)[:4]
        told = ", ".join(f"{seconds:.2f} after “{stage}”" for seconds, stage in worst)
        print(f"| {method} | {kind} | {sum(seconds for seconds, _ in found):.1f} | {len(found)} | {told} |", flush=True)
        missed = missed or worst[0][0] > GOAL
    sys.exit(missed)


if __name__ == "__main__":
    main()
