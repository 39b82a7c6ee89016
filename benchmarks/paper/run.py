"""Makes docs/paper.md and its pictures: every table and figure of the paper with ours.

    benchmarks/paper/run                       # on a bare Debian 12: installs what it needs, then this
    python benchmarks/paper/run.py [--data FOLDER] [--out FOLDER] [PART …]

Needs fairing, numpy, scipy and matplotlib. The ear is cut out of ict_head.obj and the face out of
demosthenes-low-res.obj in the data folder, by default `../shared/data` beside the checkout. PARTs (names of the
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
DATA = ROOT.parent / "shared" / "data"
sys.path[:0] = [*(str(ROOT / "tests" / part) for part in ("meshes", "tools")), str(ROOT / "benchmarks" / "common")]


def missing(data: Path) -> list[str]:
    """What has to be there first."""
    files = [str(data / name) for name in ("ict_head.obj", "demosthenes-low-res.obj") if not (data / name).exists()]
    return [name for name in ("fairing", "numpy", "scipy", "matplotlib") if find_spec(name) is None] + files


def parts(data: Path, pictures: Path) -> dict[str, Callable[[], str]]:
    """What fills each placeholder of page.md."""
    import blend_study
    import cases
    import figures
    import tables

    all_cases = cache(lambda: cases.all_cases(data))
    return {
        "table_one": lambda: tables.table_one(all_cases()),
        "figure_1": lambda: figures.figure_1(pictures),
        "figure_2": lambda: figures.figure_2(pictures),
        "sensitivity": blend_study.sensitivity_table,
        "figure_7": lambda: figures.figure_7(pictures),
        "figure_8": lambda: figures.figure_8(pictures),
        "figure_9": lambda: figures.figure_9(pictures, all_cases()[2]),
        "figure_10": lambda: figures.figure_10(pictures, all_cases()[1]),
        "accuracy": lambda: tables.accuracy_table((1000, 16000)),
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
    parser.add_argument("--data", type=Path, default=DATA, help="folder of the two heads")
    parser.add_argument("--out", type=Path, default=ROOT / "docs", help="folder of paper.md and pictures/")
    parser.add_argument("part", nargs="*", help="only these placeholders, printed")
    options = parser.parse_args()
    if lacking := missing(options.data):
        print(f"missing: {' '.join(lacking)}   (fairing: pip install . in {ROOT.name})", file=sys.stderr)
        return 2
    made = parts(options.data, options.out / "pictures")
    for name in options.part:
        print(made[name]())
    if not options.part:
        page = (Path(__file__).parent / "page.md").read_text()
        (options.out / "paper.md").write_text(filled(page, made))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
