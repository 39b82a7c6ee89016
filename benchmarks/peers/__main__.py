"""Ours beside the tools that are used instead: time, memory and quality on the same inputs in one run.

    benchmarks/peers/run                         # on a bare Debian 12: installs the peers, then this
    python benchmarks/peers [--sizes 10000,100000,256000] [--million]
    python benchmarks/peers --parts memory,quality | --page

Needs fairing, igl, meshlib, pymeshlab, numpy, scipy, matplotlib and the driver that `run` builds. Measurements go to
build/peers/measured.json, the page with its plots to docs/performance.md. --parts measures some tables anew and keeps
the others, --page only writes the page.
"""

from __future__ import annotations

import argparse
import sys
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "peers"
sys.path += [*(str(ROOT / "tests" / part) for part in ("meshes", "tools")), str(BUILD / "driver")]
PARTS = "times,live,real,irregular,memory,quality"
NEEDED = ("fairing", "igl", "meshlib", "pymeshlab", "peers_driver", "numpy", "scipy", "matplotlib")


def arguments() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--sizes", default="10000,100000,256000", help="numbers of free vertices")
    parser.add_argument("--million", action="store_true", help="a million as well: some 15 minutes and 12 GB")
    parser.add_argument("--limit", type=float, default=300.0, help="leave out calls expected to take longer, s")
    parser.add_argument("--calls", type=int, default=7, help="of each tool at most")
    parser.add_argument("--parts", default=PARTS, help="measure only these anew")
    parser.add_argument("--page", action="store_true", help="measure nothing, write the page from the last run")
    parser.add_argument("--measured", type=Path, default=BUILD / "measured.json", help="file of the measurements")
    parser.add_argument("--out", type=Path, default=ROOT / "docs", help="folder of performance.md and pictures/")
    return parser.parse_args()


def write_page(path: Path, out: Path) -> None:
    """Fills the placeholders of page.md and draws the plots."""
    import charts
    import goals
    import tables
    from measured import Measured

    done = Measured.load(path)
    made = {"goals": goals.table, **tables.BY_NAME}
    page = (Path(__file__).parent / "page.md").read_text()
    for placeholder, make in made.items():
        page = page.replace("{{" + placeholder + "}}", make(done))
    (out / "performance.md").write_text(page)
    charts.save(done, out / "pictures")
    print(goals.table(done, notes=True))


def main() -> int:
    """Measures, then writes the page."""
    options = arguments()
    if missing := [name for name in NEEDED if find_spec(name) is None]:
        print(f"missing: {', '.join(missing)}; benchmarks/peers/run installs and builds them", file=sys.stderr)
        return 2
    if not options.page:
        from measured import Plan, run

        sizes = [int(word) for word in options.sizes.split(",")] + [1_000_000] * options.million
        parts = tuple(options.parts.split(","))
        run(Plan(sizes, options.limit, BUILD / "inputs", options.calls, parts), options.measured)
    write_page(options.measured, options.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
