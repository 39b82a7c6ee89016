"""A zoo of real patches: which converge to the same surface from every start, and what the others say.

    python benchmarks/zoo                          # 27 listed patches, 500 random ones; writes zoo.csv, zoo_worst.webp
    python benchmarks/zoo --patches 60 --weights conformal
    python benchmarks/zoo --seed 1 --outlines 2  # several outlines; zoo_lofts.webp: those whose surface no equation has

Each patch is solved from its interior as given, flattened and noisy. *Same*: all converged, within 0.5 % of the patch's
radius. *Told*: not the same, but no two that say that they converged differ. *Silent*: two such differ. *Folded*,
*crossing*: starts that say that they converged, with triangles that are turned over or pass through others. *Slowest*:
CPU seconds of one start, of those with up to 1,500 free vertices. A second table, of those that are the same: which
equation holds, *torn*: triangles pass through others that did not before, *bent*: the largest |H| inside is beyond
twice that on the outline; *slowest* of all. Seed 0 was used for tuning. Each call has one thread,
a process of its own and a time limit. Needs the meshes of shared/data beside the checkout.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))

import contact_sheet
from engine import Engine
from real_meshes import DATA, listed_patches, random_patches
from specimens import LIMIT, Record, sweep, worst

ROOT = Path(__file__).resolve().parents[2]
GOAL = 0.99  # of a set's patches
HEADER = (
    "| patches | number | same | told | silent | refused | share | folded | crossing | lofts | CPU s | slowest |\n"
    + "| --- "
    + "| --: " * 11 + "|"
)  # fmt: skip
SMALL = 1500  # free vertices
SURFACES = ("harmonic", "least_variation", "loft", "smoothed")
ANSWERS = f"| patches | number | {' | '.join(SURFACES)} | none | torn | bent | slowest |\n| --- {'| --: ' * 9}|"
MOST_BENT = 2.0


def arguments() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--patches", type=int, default=500, help="number of random patches")
    parser.add_argument("--weights", default="uniform", help="inner fairness, comma-separated")
    parser.add_argument("--seed", type=int, default=0, help="of the random patches; accuracy's are the first of seed 0")
    parser.add_argument("--outlines", type=int, default=1, help="only patches with at least as many outlines")
    parser.add_argument("--limit", type=float, default=LIMIT, help="seconds of wall-clock time for one call")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "zoo", help="folder for the CSV and the picture")
    return parser.parse_args()


def line(title: str, records: list[Record]) -> str:
    """One row of the table."""
    same = sum(record.good for record in records)
    silent = sum(not record.honest for record in records)
    refused = sum(bool(record.refused) for record in records)
    cells = [
        title, len(records), same, len(records) - same - silent - refused, silent, refused,
        f"{same / max(len(records), 1):.1%}", sum(record.folded for record in records),
        sum(record.crossing for record in records),
        sum(record.good and record.equation == "loft" for record in records),
        f"{sum(record.cpu for record in records):.0f}",
        f"{max((record.slowest for record in records if record.free <= SMALL), default=0.0):.1f}",
    ]  # fmt: skip
    return f"| {' | '.join(map(str, cells))} |"


def answers(title: str, records: list[Record]) -> str:
    """One row of the table of what holds."""
    good = [record for record in records if record.good]
    cells = [
        title, len(records), *(sum(record.equation == name for record in good) for name in SURFACES),
        len(records) - len(good), sum(record.torn > 0 for record in good),
        sum(record.bend > MOST_BENT for record in good), f"{max((r.slowest for r in records), default=0.0):.1f}",
    ]  # fmt: skip
    return f"| {' | '.join(map(str, cells))} |"


def table(records: list[Record], listed: set[str]) -> list[str]:
    """Rows for both sets, and by the number of outlines and by how much their normals turn along an edge."""
    groups = {
        "27 listed": [r for r in records if r.name in listed],
        "random": [r for r in records if r.name not in listed],
        "all, disks": [r for r in records if r.loops == 1],
        "all, two outlines": [r for r in records if r.loops == 2],
        "all, more outlines": [r for r in records if r.loops > 2],
        "all, normals turn less than 45° per edge": [r for r in records if r.turn < 45],
        "all, 45° or more": [r for r in records if r.turn >= 45],
        "all": records,
    }
    return [line(title, group) for title, group in groups.items() if group]


def main() -> int:
    """Print the table; 1 if fewer than the goal converge to the same surface or any is silent, 2 without meshes."""
    options = arguments()
    if not DATA.exists():
        print("the meshes of shared/data are missing", file=sys.stderr)
        return 2
    listed = list(listed_patches())
    engine = Engine(options.limit)
    chosen = [*listed, *random_patches(options.patches, options.seed)]
    chosen = [patch for patch in chosen if patch.loops >= options.outlines]
    specimens = sweep(engine, chosen, options.weights.split(","), options.out / "zoo.csv")
    engine.close()
    records = [specimen.record for specimen in specimens]
    print("\n".join([HEADER, *table(records, {patch.name for patch in listed})]))
    print("\n".join(["", ANSWERS, answers("several outlines", [r for r in records if r.loops > 1])]))
    contact_sheet.save(worst(specimens, 10), options.out / "zoo_worst.webp")
    lofts = [specimen for specimen in specimens if specimen.record.equation in ("loft", "smoothed")]
    contact_sheet.save(lofts[:10], options.out / "zoo_lofts.webp")
    return int(sum(r.good for r in records) < GOAL * len(records) or not all(r.honest for r in records))


if __name__ == "__main__":
    raise SystemExit(main())
