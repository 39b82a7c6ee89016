"""Makes docs/paper.md and its pictures: every table and figure of the paper with ours.

    benchmarks/paper/run                       # on a bare Debian 12: installs what it needs, then this
    python benchmarks/paper/run.py [--head FILE] [--out FOLDER] [PART …]

Needs fairing, numpy, scipy and matplotlib. Ear and face are cut out of the head in FILE, by default
`../shared/data/ict_head.obj` beside the checkout; without it out of Suzanne, which needs bpy. PARTs (names of the
placeholders in page.md) are printed instead of the page. Takes some minutes.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HEAD = ROOT.parent / "shared" / "data" / "ict_head.obj"
sys.path.insert(0, str(ROOT / "tests"))


def missing_modules(head: Path | None) -> list[str]:
    """What has to be installed first."""
    wanted = ["fairing", "numpy", "scipy", "matplotlib"] + ([] if head else ["bpy"])
    return [name for name in wanted if find_spec(name) is None]


def parts(head: Path | None, pictures: Path) -> dict[str, Callable[[], str]]:
    """What fills each placeholder of page.md."""
    import blend_study
    import cases
    import convergence
    import figures
    import tables

    all_cases = cache(lambda: cases.all_cases(head))
    return {
        "table_one": lambda: tables.table_one(all_cases()),
        "figure_1": lambda: figures.figure_1(pictures),
        "figure_2": lambda: figures.figure_2(pictures),
        "sensitivity": blend_study.sensitivity_table,
        "figure_7": lambda: figures.figure_7(pictures),
        "figure_8": lambda: figures.figure_8(pictures),
        "figure_9": lambda: figures.figure_9(pictures, all_cases()[2]),
        "figure_10": lambda: figures.figure_10(pictures, all_cases()[1]),
        "methods": lambda: tables.methods_table(all_cases()),
        "accuracy": lambda: tables.accuracy_table((1000, 4000, 16000)),
        "convergence": lambda: convergence.convergence_plot(all_cases()[0], pictures / "paper_convergence.png"),
        "head": lambda: "the ICT head (MIT, USC Institute for Creative Technologies)" if head else "Blender's Suzanne",
    }


def filled(page: str, made: dict[str, Callable[[], str]]) -> str:
    """The page with each `{{name}}` replaced."""
    for name, make in made.items():
        start = time.perf_counter()
        page = page.replace("{{" + name + "}}", make())
        print(f"{name}: {time.perf_counter() - start:.0f} s", flush=True)
    return page


def main() -> int:
    """Writes the page, or prints parts of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--head", type=Path, default=HEAD if HEAD.exists() else None, help="OBJ file of a head")
    parser.add_argument("--out", type=Path, default=ROOT / "docs", help="folder of paper.md and pictures/")
    parser.add_argument("part", nargs="*", help="only these placeholders, printed")
    options = parser.parse_args()
    if missing := missing_modules(options.head):
        print(f"first: pip install {' '.join(missing)}   (fairing: pip install . in {ROOT.name})", file=sys.stderr)
        return 2
    made = parts(options.head, options.out / "pictures")
    for name in options.part:
        print(made[name]())
    if not options.part:
        page = (Path(__file__).parent / "page.md").read_text()
        (options.out / "paper.md").write_text(filled(page, made))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
