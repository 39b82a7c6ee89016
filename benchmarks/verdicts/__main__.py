"""Jobs on meshes of every kind, judged by eye before their verdicts were read, and what the verdicts make of them.

    python benchmarks/verdicts run --parts first,second  # in bpy, with the zip of scripts/package; into build/verdicts
    python benchmarks/verdicts sheets                    # contact sheets without verdicts, to judge by; needs Pillow
    python benchmarks/verdicts table --parts second      # counts, and the jobs whose verdict and judgement differ

`judged.txt` has a line for each job: keep, doubt or undo, and what is wrong. It was written from the sheets alone.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
for place in ("tests/meshes", "tests/tools", "tests/blender", "benchmarks/common"):
    sys.path.append(str(ROOT / place))
os.environ.setdefault("BLENDER_USER_RESOURCES", tempfile.mkdtemp(prefix="verdicts-"))  # before bpy is there


def main() -> None:
    """Run jobs, draw them, or compare."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("task", choices=("run", "sheets", "table"))
    parser.add_argument("jobs", nargs="*", help="names; default: those of --parts")
    parser.add_argument("--parts", default="first", help="of the jobs: first to fifth; separated by commas")
    parser.add_argument(
        "--tree", action="store_true", help="the tree's add-on and build/native's module, not the zip's"
    )
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "verdicts")
    options = parser.parse_intermixed_args()  # jobs may come last
    import bpy  # noqa: F401 - bmesh comes with it

    import jobs

    chosen = options.jobs or list(jobs.names(*options.parts.split(",")))
    if options.task == "run":
        from running import sweep

        sweep(chosen, options.folder / "results", options.tree)
    elif options.task == "sheets":
        import sheets

        sheets.save(chosen, options.folder / "results", options.folder / "sheets")
    else:
        import table

        print(table.text(chosen, options.folder / "results"))


if __name__ == "__main__":
    main()
