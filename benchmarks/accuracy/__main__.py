"""Measured accuracy beside its goals, as Markdown, with plots.

    python benchmarks/accuracy                          # everything
    python benchmarks/accuracy --quick                  # at most 4000 free vertices, 30 random patches
    python benchmarks/accuracy --only graded,pipe       # tables whose name contains one of these words
    python benchmarks/accuracy --only patches --patches 100

Distances are over D (twice the largest distance of the fixed vertices from their centroid), starts
are membranes, λ other than uniform belong to the exact mesh, `tolerance=1e-10`; each call has one
thread, a process of its own and a time limit.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

sys.path += [str(Path(__file__).resolve().parents[2] / "tests" / part) for part in ("meshes", "tools")]
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import cost
import exact
import pairs
import patches
import plots
import starts
from engine import Engine
from exact import Scope
from report import HEADER, Row, summary

ROOT = Path(__file__).resolve().parents[2]
TABLES: dict[str, Callable[[Scope], Iterator[Row]]] = {
    "graded": exact.graded_rows,
    "jittered": exact.jittered_rows,
    "strong": exact.strong_rows,
    "pipe": exact.pipe_rows,
    "special": exact.special_rows,
    "noisy-normals": exact.noisy_normal_rows,
    "pairs": pairs.rows,
    "starts": starts.rows,
    "cost": cost.rows,
    "patches": patches.rows,
}


def arguments() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--only", default="", help=f"words, comma-separated; tables: {', '.join(TABLES)}")
    parser.add_argument("--quick", action="store_true", help="up to 4000 free vertices, 30 random patches")
    parser.add_argument("--patches", type=int, help="number of random patches (300)")
    parser.add_argument("--seed", type=int, default=0, help="of the random patches; 0 was used for tuning")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds of wall-clock time for one call")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "accuracy", help="folder for plots and CSV files")
    return parser.parse_args()


def main() -> int:
    """Print the tables; 1 if a goal is missed."""
    options = arguments()
    words = options.only.split(",")
    engine = Engine(options.limit)
    count = options.patches if options.patches is not None else (30 if options.quick else 300)
    scope = Scope(engine, 4000 if options.quick else 16000, count, options.seed, options.out)
    done: dict[str, list[Row]] = {}
    for name, table in TABLES.items():
        if any(word in name for word in words):
            done[name] = _printed(name, table(scope))
    engine.close()
    plots.save(done, options.out)
    return int(any(not row.met for rows in done.values() for row in rows))


def _printed(name: str, rows: Iterator[Row]) -> list[Row]:
    start = time.perf_counter()
    print(f"\n## {name}\n\n{HEADER}")
    listed = []
    for row in rows:
        print(row.line(), flush=True)
        listed.append(row)
    print(f"\n{summary(listed)}; {time.perf_counter() - start:.0f} s", flush=True)
    return listed


if __name__ == "__main__":
    raise SystemExit(main())
