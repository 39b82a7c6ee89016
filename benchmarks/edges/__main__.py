"""Limits of hard edges on problems by the hundred whose answer is known: what each decides, and whether it is right.

    python benchmarks/edges [--settable build/census] [--count N] [--seed S] [--list] [WORD…]

Every limit of limits.toml, or those whose names hold one of the words, is set to its other values in turn. A line of
the table counts the problems whose answer changes, and those in which it comes nearer to the truth, or goes away from
it, by more than a tenth and more than 1e-4 of the size. Without `--settable` the limits of the Python package alone are
tried: with it, the engine is built once in that folder with limits that can be set. `--list` prints all distances.
"""

from __future__ import annotations

import argparse
import sys
import time
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / part) for part in ("tests", "benchmarks/common", "benchmarks/census")]
FILES = (
    "geometry/hard_edges.h", "geometry/hard_edges.cpp",
)  # fmt: skip


def set_limit(name: str, value: float) -> bool:
    """Whether there is one of that name."""
    import importlib

    from fairing import _core

    if ":" not in name:
        module, attribute = name.split(".")
        setattr(importlib.import_module(f"fairing.{module}"), attribute, value)
        return True
    if name not in getattr(_core, "limits", dict)():
        return False
    _core.set_limit(name, value)
    return True


def compared(before: list[float], after: list[float]) -> str:
    """Changed, better, worse, and the mean distance with the other value over that with the limit's own."""
    pairs = list(zip(before, after, strict=True))
    changed = sum(a != b for a, b in pairs)
    better, worse = (sum(q < 0.9 * p and p - q > 1e-4 for p, q in each) for each in (pairs, [(b, a) for a, b in pairs]))
    return f"{changed} | {better} | {worse} | {sum(after) / sum(before):.3f}"


def run(count: int, seed: int, listed: bool, words: list[str]) -> None:
    """Print the table; words: see above."""
    import numpy as np

    from answers import Answers
    from problems import problems

    begun = time.process_time()
    made = [Answers(problem) for problem in problems(count, seed)]
    before = [each.distance() for each in made]
    print(f"seed {seed}: {len(made)} problems, {time.process_time() - begun:.0f} s", flush=True)
    kinds = [f"{each.problem.kind}, {'hole' if each.problem.is_hole else 'selection'}" for each in made]
    for kind in sorted(set(kinds)):
        mine = np.array([away for away, own in zip(before, kinds, strict=True) if own == kind])
        print(f"{kind}: {len(mine)}, median {np.median(mine):.1e}, mean {mine.mean():.1e}, worst {mine.max():.1e}")
    if listed:
        for each, away in zip(made, before, strict=True):
            print(f"{each.problem.name} {each.problem.kind} {away:.2e}")
    print("| limit | value | changed | better | worse | mean distance, times |\n| --- | --- | --: | --: | --: | --: |")
    rows = tomllib.loads((Path(__file__).parent / "limits.toml").read_text())["limit"]
    chosen = [row for row in rows if not words or any(word in row["name"] for word in words)]
    for row in sorted(chosen, key=lambda row: any(":" in name for name in row["at"])):  # those of Python first
        for other in row["others"]:
            known = [set_limit(*each) for each in zip(row["at"], other, strict=True)]
            if all(known):
                in_python = not any(":" in name for name in row["at"])
                after = [each.distance(in_python) for each in made]
                print(f"| {row['name']} | {row['value'][0]:g} → {other[0]:g} | {compared(before, after)} |", flush=True)
            for each in zip(row["at"], row["value"], strict=True):
                set_limit(*each)


def built(folder: Path) -> Path:
    """The package with an engine whose limits can be set; built where it is not there yet."""
    package = folder.resolve() / "modules" / "edges"
    if not package.exists():
        import shutil

        from variants import Tree

        shutil.copytree(Tree(folder / "edges").built_with_limits(FILES), package)
    return package


def main() -> int:
    """By the options."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--settable", type=Path)
    parser.add_argument("--count", type=int, default=320)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("words", nargs="*")
    options: Any = parser.parse_args()
    if options.settable:
        sys.path.insert(0, str(built(options.settable)))
    run(options.count, options.seed, options.list, options.words)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
