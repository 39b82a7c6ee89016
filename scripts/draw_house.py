"""Draws the rooms of native/ and addon/ with the arrows between them, as includes and imports have them.

    draw_house.py            # writes docs/pictures/house.svg
    draw_house.py --check    # 1 where that picture is not what the sources say

An arrow points from a room to one that it includes or imports. An arrow that others lead to as well is left out. Rooms
stand above all that they need. A circle is an error.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs/pictures/house.svg"
INCLUDE = re.compile(r'^\s*#\s*include\s*"(\w+)/', re.MULTILINE)
WIDTH, HEIGHT, LANE, GAP, FLOOR, MARGIN = 104, 28, 4, 18, 58, 10  # pixels
COLOURS = {"addon": "#f6e3c5", "native": "#cfe2f3"}

Arrows = dict[str, set[str]]


def native_arrows() -> Arrows:
    """Rooms of the engine and its Python package, each with those that it needs."""
    folder = ROOT / "native"
    arrows: Arrows = {"native/python": {"native/bindings"}}  # the package imports the compiled module
    for path in sorted([*folder.glob("*/*.h"), *folder.glob("*/*.cpp")]):
        room = f"native/{path.parent.name}"
        names = {f"native/{name}" for name in INCLUDE.findall(path.read_text(encoding="utf-8"))}
        arrows.setdefault(room, set()).update(names - {room})
    return arrows


def imports(path: Path) -> Iterator[tuple[int, str]]:
    """Level and first name of each import of a file, those within functions too; `from .. import x` gives x."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((0, alias.name.split(".")[0]) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from ((node.level, name.split(".")[0]) for name in names)


def addon_arrows() -> Arrows:
    """Rooms of the add-on. Of the modules beside them the door opens rooms, and the ground needs none."""
    folder = ROOT / "addon"
    rooms = {path.parent.name for path in folder.glob("*/__init__.py")}
    beside = {path.stem: {name for level, name in imports(path) if level} for path in folder.glob("*.py")}
    door = {stem for stem, needed in beside.items() if needed & rooms}

    def place(name: str) -> str:
        return name if name in rooms else "door" if name in door else "ground"

    arrows: Arrows = {}
    for path in sorted(folder.rglob("*.py")):
        parts = path.relative_to(folder).parts
        room = f"addon/{place(parts[0] if len(parts) > 1 else path.stem)}"
        found = arrows.setdefault(room, set())
        for level, name in imports(path):
            if level == len(parts):  # from the add-on itself
                found.add(f"addon/{place(name)}")
            elif (level, name) == (0, "fairing"):
                found.add("native/python")
        found.discard(room)
    return arrows


def reached(arrows: Arrows, room: str) -> set[str]:
    """All rooms that a room needs, by way of others too."""
    found: set[str] = set()
    waiting = set(arrows[room])
    while waiting:
        name = waiting.pop()
        found.add(name)
        waiting |= arrows[name] - found
    return found


def needed_arrows(arrows: Arrows) -> Arrows:
    """Without those that others lead to."""
    below = {room: reached(arrows, room) for room in arrows}
    for room in arrows:
        if room in below[room]:
            raise SystemExit(f"{room} needs itself, by way of {sorted(r for r in below[room] if room in below[r])}")
    return {
        room: {name for name in needed if not any(name in below[other] for other in needed)}
        for room, needed in arrows.items()
    }


def floors(arrows: Arrows) -> dict[str, int]:
    """From the top, 0: each room one floor below the lowest of those that need it."""
    floor = dict.fromkeys(sorted(arrows), 0)
    for _ in arrows:
        for room, needed in arrows.items():
            for name in needed:
                floor[name] = max(floor[name], floor[room] + 1)
    return floor


def routes(arrows: Arrows, floor: dict[str, int]) -> list[list[str]]:
    """Each arrow as the names of what it passes: a lane on every floor between its ends, so that it crosses no room."""
    return [
        [room, *(f"{room} > {name} {k}" for k in range(floor[room] + 1, floor[name])), name]
        for room in sorted(arrows)
        for name in sorted(arrows[room])
    ]


def places(arrows: Arrows, ways: list[list[str]], floor: dict[str, int]) -> dict[str, tuple[float, float]]:
    """Middle of the upper edge of each room and lane; on its floor each stands near the middle of what leads to it."""
    level = {name: floor[way[0]] + k for way in ways for k, name in enumerate(way)} | floor
    rows = [sorted(name for name in level if level[name] == k) for k in range(max(level.values()) + 1)]
    width = {name: WIDTH if name in arrows else LANE for name in level}
    total = max(sum(width[name] + GAP for name in row) for row in rows)
    steps = {step for way in ways for step in pairwise(way)}
    found: dict[str, tuple[float, float]] = {}
    for k, row in enumerate(rows):
        above = {name: [found[upper] for upper, lower in sorted(steps) if lower == name] for name in row}
        middle = {name: sum(x for x, _ in from_) / len(from_) if from_ else total / 2 for name, from_ in above.items()}
        x = (total - sum(width[name] + GAP for name in row) + GAP) / 2
        for name in sorted(row, key=lambda name: (middle[name], name)):
            found[name] = (x + width[name] / 2 + MARGIN, MARGIN + k * FLOOR)
            x += width[name] + GAP
    return found


def curve(way: list[str], where: dict[str, tuple[float, float]]) -> str:
    """A path from the lower edge of the first room through its lanes to the upper edge of the last."""
    x, y = where[way[0]]
    y += HEIGHT
    path = f"M{x:.0f} {y:.0f}"
    for name in way[1:]:
        u, v = where[name]
        path += f"C{x:.0f} {(y + v) / 2:.0f} {u:.0f} {(y + v) / 2:.0f} {u:.0f} {v:.0f}"
        x, y = u, v
        if name != way[-1]:
            y += HEIGHT
            path += f"V{y:.0f}"
    return path


def drawn(arrows: Arrows) -> str:
    """The picture."""
    floor = floors(arrows)
    ways = routes(arrows, floor)
    where = places(arrows, ways, floor)
    right = max(x for x, _ in where.values()) + WIDTH / 2 + MARGIN
    bottom = max(y for _, y in where.values()) + HEIGHT + MARGIN
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{right:.0f}" height="{bottom:.0f}" '
        'font-family="sans-serif" font-size="12">',
        '<marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0L8 4L0 8z" fill="#555"/></marker>',
        '<rect width="100%" height="100%" fill="#fff"/>',
    ]
    lines += [f'<path d="{curve(way, where)}" fill="none" stroke="#555" marker-end="url(#head)"/>' for way in ways]
    for room in sorted(arrows):
        x, y = where[room]
        lines.append(
            f'<rect x="{x - WIDTH / 2:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="4" '
            f'fill="{COLOURS[room.split("/")[0]]}" stroke="#555"/>'
            f'<text x="{x:.0f}" y="{y + 18:.0f}" text-anchor="middle">{room}</text>'
        )
    return "\n".join([*lines, "</svg>", ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--check", action="store_true", help="1 where the picture is out of date")
    check = parser.parse_args().check
    picture = drawn(needed_arrows({**native_arrows(), **addon_arrows()}))
    if check:
        old = PICTURE.read_text(encoding="utf-8") if PICTURE.is_file() else ""
        if old != picture:
            print(f"{PICTURE.relative_to(ROOT)} is out of date: run scripts/draw_house.py", file=sys.stderr)
        return int(old != picture)
    PICTURE.write_text(picture, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
