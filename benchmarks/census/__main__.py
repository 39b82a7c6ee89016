"""Which steps of a call are needed: problems by the hundred, each solved with one step switched off after the other.

    python benchmarks/census --module FOLDER --out FILE [--count N] [--seed S]
    python benchmarks/census --switches build/census [--count N] [--seed S] [NAME…]
    python benchmarks/census --table build/census
    python benchmarks/census --limits build/census --kind KIND [--count N] [--seed S]
    python benchmarks/census --reach build/census [--count N] [--seed S] [--most K]

The first form runs all problems with one built module (FOLDER/fairing) and writes a line of JSON each. The second does
so for the tree as it is and for each change of switches.toml (or those named), made in a copy of the tree and built
there; it needs an environment of scripts/setup on the PATH. The third writes the table. The fourth builds one module
whose named limits can be set, and prints limits.toml's rows for calls of a kind (calls.py; "patches": plain ones). The
fifth builds one, with clang++, that marks the branches that run, makes calls of all kinds, and prints the lines that
at most K of them reach.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests"), str(ROOT / "benchmarks/common")]


def solved(module: Path, count: int, seed: int, out: Path) -> None:
    """One line for each problem."""
    sys.path.insert(0, str(module))
    import numpy as np

    import fairing
    from problems import problems

    with out.open("w", encoding="utf-8") as file:
        for problem in problems(count, seed):
            row: dict[str, Any] = {
                "name": problem.name,
                "kind": problem.kind,
                "free": len(problem.vertices) - len(problem.fixed),
            }
            begun = time.process_time()
            try:
                result = fairing.fair(
                    problem.vertices, problem.triangles, fixed=problem.fixed, fixed_normals=problem.normals, threads=1,
                    **problem.options,
                )  # fmt: skip
            except (fairing.MeshError, fairing.SolverError) as error:
                row["error"] = str(error)
            else:
                row |= {
                    "converged": result.converged, "provenance": result.provenance,
                    "way": [name for name, _ in result.way],
                }  # fmt: skip
                if problem.surface is not None:
                    away = np.abs(problem.surface.distance(result.vertices)).max() / problem.diameter
                    row["distance"] = float(away)
            row["seconds"] = time.process_time() - begun
            file.write(json.dumps(row) + "\n")
            file.flush()


def run(folder: Path, names: list[str], count: int, seed: int) -> None:
    """The tree as it is, then each switch."""
    from variants import Tree

    tree = Tree(folder)
    for name in ["as it is", *(names or tree.switches)]:
        module = tree.built(name)
        out = folder / f"{name}, seed {seed}.jsonl"
        command = [sys.executable, __file__, "--module", str(module), "--out", str(out), "--count", str(count)]
        subprocess.run([*command, "--seed", str(seed)], check=True)
        print(name, flush=True)


def set_limits(folder: Path, kind: str, count: int, seed: int) -> None:
    """The rows of limits.toml of a kind, with the module built before where there is one."""
    package = folder.resolve() / "modules" / "limits"
    if not package.exists():
        from variants import Tree

        package = Tree(folder / "settable").built_with_limits()
        shutil.copytree(package, folder / "modules" / "limits")
    sys.path.insert(0, str(folder.resolve() / "modules" / "limits"))
    import switched
    from fairing import _core

    switched.report(_core, kind, count, seed)


def reach_lines(folder: Path, count: int, seed: int, most: int) -> None:
    """What hardly any call reaches, with the module built before where there is one."""
    package = folder.resolve() / "modules" / "marks"
    if not package.exists():
        from variants import Tree

        shutil.copytree(Tree(folder / "marked").built_with_marks(), package)
    sys.path.insert(0, str(package))
    import reach
    from fairing import _core

    reach.counted(_core, count, seed, folder / f"reached, seed {seed}")
    reach.report(folder, folder / "marked/tree/native", most)


def main() -> int:
    """By the options."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--module", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--switches", type=Path)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--limits", type=Path)
    parser.add_argument("--reach", type=Path)
    parser.add_argument("--most", type=int, default=2)
    parser.add_argument("--kind", default="patches")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    if options.module:
        solved(options.module, options.count, options.seed, options.out)
    elif options.switches:
        run(options.switches, options.names, options.count, options.seed)
    elif options.limits:
        set_limits(options.limits, options.kind, options.count, options.seed)
    elif options.reach:
        reach_lines(options.reach, options.count, options.seed, options.most)
    elif options.table:
        from table import table

        print(table(options.table))
    else:
        parser.print_help()
        return 2
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
