"""Pictures of the docs that Blender renders: what was there, other tools or options, and ours, each with stripes."""

import sys
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.append(str(Path(__file__).parents[2] / "tests" / "blender"))
import demo  # before bpy: it sets Blender's scratch folder

# isort: split
import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes
import hard
import lesson_sheets  # before more: it adds the folder of the lessons' scenes
import more
import moving
import options
import rivals
import sheet
import tools
from rows import Row, smooth

WIDTH = 1200  # pixels of a sheet at least
LEAST = 300  # of one picture
MODULES = (rivals, hard, options, more)
SHEETS: dict[str, list[list[Row]]] = {name: lines for module in MODULES for name, lines in module.SHEETS.items()}


def begun(row: Row) -> Any:
    """Build the scene and select; returns the positions before."""
    bpy.ops.wm.read_homefile(use_empty=True)
    chosen = row.scene()
    before = scenes.positions(bpy.context.object.data)
    tools.select(row.kind, chosen)
    return before


def pictured(row: Row, path: Path, selected: bool) -> list[Path]:
    """Clay, selected faces coloured if asked for; and stripes, smooth but for hard edges."""
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.context.object.data
    chosen = np.zeros(len(mesh.polygons), dtype=bool)
    if selected and row.kind == "faces":
        mesh.polygons.foreach_get("select", chosen)
    if row.striped:
        smooth()
    textured = bool(mesh.materials)
    if not textured:
        pictures.tint(mesh, chosen)
    found = [path.with_name(f"{path.stem}_clay.png")]
    pictures.shaded(found[0], "TEXTURE" if textured else "MATERIAL")
    if row.striped:
        found.append(path.with_name(f"{path.stem}_stripes.png"))
        pictures.STRIPES = row.stripes
        pictures.striped(found[1])
    return found


def measured(row: Row, before: Any) -> str:
    """How far what changed is from the right answer, where that is known."""
    if row.away is None:
        return ""
    after = scenes.positions(bpy.context.object.data)
    same = len(after) == len(before)
    changed = np.any(after != before, axis=1) if same else np.arange(len(after)) >= len(before)
    if not changed.any():
        return "no new vertex"
    off = 100.0 * row.away(after[changed]).max() / row.size
    return f"off by {off:.2g} %" if off > 0.001 else "off by < 0.001 %"


def tile(row: Row, name: str, path: Path) -> sheet.Tile:
    """The result of one run."""
    run = row.runs[name]
    begun(row)
    run()  # the first call of a tool pays for what it loads
    before = begun(row)
    at = time.process_time()
    run()
    seconds = f"{time.process_time() - at:.2f} s" if row.timed else ""
    bpy.ops.object.mode_set(mode="OBJECT")
    words = ", ".join(part for part in (measured(row, before), seconds) if part)
    print(f"{row.title} | {name} | {words}", flush=True)
    return sheet.Tile(pictured(row, path, not row.striped), [name, words] if words else [name])


def tiles(row: Row, path: Path) -> list[sheet.Tile]:
    """What was there, then each run."""
    begun(row)
    count = f"{len(bpy.context.object.data.vertices):,} vertices"
    first = sheet.Tile(pictured(row, path.with_name(f"{path.name}_0"), True), [row.title, count])
    return [first, *(tile(row, name, path.with_name(f"{path.name}_{k}")) for k, name in enumerate(row.runs, 1))]


def main() -> None:
    """Usage: studio ZIP OUTPUT_FOLDER [SHEET…]."""
    package, out = Path(sys.argv[1]), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    demo.install(package)
    for name in sys.argv[3:] or [*SHEETS, *lesson_sheets.LESSONS, *moving.MOVING]:
        if name in moving.MOVING:
            moving.write(name, out)
        else:
            sheet.sheet(lines_of(name, out), out / f"{name}.webp")


def lines_of(name: str, out: Path) -> list[list[sheet.Tile]]:
    """The pictures of a sheet, line by line."""
    if name in lesson_sheets.LESSONS:
        return [lesson_sheets.tiles(name, out)]
    lines = SHEETS[name]
    pictures.SIZE = max(LEAST, WIDTH // max(sum(len(row.runs) + 1 for row in line) for line in lines))
    return [
        [each for k, row in enumerate(line) for each in tiles(row, out / f"{name}_{number}_{k}")]
        for number, line in enumerate(lines)
    ]


if __name__ == "__main__":
    main()
