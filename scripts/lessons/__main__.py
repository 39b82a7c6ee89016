"""Writes the tutorial's files: one .blend for each lesson of docs/tutorial.md, its selection made.

usage: python scripts/lessons FOLDER
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1]))
sys.path.append(str(Path(__file__).parents[1] / "studio"))
sys.path.append(str(Path(__file__).parents[2] / "tests" / "blender"))

import bpy

from lesson_scenes import SCENES, begin


def save(name: str, folder: Path) -> Path:
    """Make one lesson's scene in an empty file, and save that."""
    bpy.ops.wm.read_homefile(use_empty=True)
    begin(name)
    path = folder / f"{name}.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    return path


if __name__ == "__main__":
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for each in SCENES:
        print(f"{save(each, out).name}: {(out / f'{each}.blend').stat().st_size / 1e6:.1f} MB")
