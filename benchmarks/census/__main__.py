"""Random problems by the hundred, solved with one built module, so that two modules can be compared.

    python benchmarks/census --module FOLDER --out FILE [--count N] [--seed S]
    python benchmarks/census --compare FILE OTHER

The first form solves random patches of real meshes and exact surfaces with FOLDER/fairing and writes a line of JSON
each. The second says what OTHER lost, gained and took beside FILE.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path += [*(str(ROOT / "tests" / part) for part in ("meshes", "tools")), str(ROOT / "benchmarks/common")]
Row = dict[str, Any]


def solved(module: Path, count: int, seed: int, out: Path) -> None:
    """One line for each problem."""
    sys.path.insert(0, str(module))
    import numpy as np

    import fairing
    from problems import problems

    with out.open("w", encoding="utf-8") as file:
        for problem in problems(count, seed):
            row: Row = {
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


def compared(paths: list[Path]) -> str:
    """Answers lost and gained, the equation's and any, and warnings and seconds."""
    before, after = ({row["name"] + row["kind"]: row for row in map(json.loads, path.open())} for path in paths)
    pairs = [(before[key], row) for key, row in after.items() if key in before]
    lines = [f"{len(pairs)} problems"]
    for title, test in (("the equation's answer", is_equation), ("any answer", lambda row: bool(row.get("converged")))):
        lost = [row["name"] for old, row in pairs if test(old) and not test(row)]
        gained = [row["name"] for old, row in pairs if test(row) and not test(old)]
        lines.append(f"{title}: lost {len(lost)} {lost}, gained {len(gained)} {gained}")
    seconds = [sum(row["seconds"] for row in side) for side in zip(*pairs, strict=True)]
    lines.append("seconds: " + ", ".join(f"{each:.1f}" for each in seconds))
    return "\n".join(lines)


def is_equation(row: Row) -> bool:
    """Whether the equation asked for has a surface."""
    return bool(row.get("converged")) and row["provenance"] in ("equation", "low_passed")


def main() -> None:
    """By the options."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    form = parser.add_mutually_exclusive_group(required=True)
    form.add_argument("--module", type=Path)
    form.add_argument("--compare", type=Path, nargs=2)
    parser.add_argument("--out", type=Path, default=Path("census.jsonl"))
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.compare:
        print(compared(options.compare))
    else:
        solved(options.module, options.count, options.seed, options.out)


if __name__ == "__main__":
    main()
