"""Rounded seams with their wires, for docs/fillet.md: Blender's Bevel above, Fair Fillet with quads below."""

from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

import demo_pictures as pictures
import lesson_sheets
import sheet
import tools
from rivals import SEAM
from rows import Chosen, Run

NAME = "along_seams"


def block() -> Chosen:
    """A cube of three by three faces a side."""
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=2)
    bpy.ops.object.mode_set(mode="OBJECT")
    pictures.add_camera((0.0, 0.0, 0.0), (0.75, -1.0, 0.75), 3.3)
    return lambda edge: bool(edge.calc_face_angle(0.0) > 1.0)


SCENES: tuple[tuple[str, Callable[[], Chosen], float], ...] = (
    ("A block", block, 0.3),
    ("A cylinder on a block", SEAM.scene, 0.2),
)


def picture(scene: Callable[[], Chosen], run: Run, path: Path) -> Path:
    """The mesh as it comes out, with all its edges."""
    bpy.ops.wm.read_homefile(use_empty=True)
    chosen = scene()
    tools.select("edges", chosen)
    run()
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.context.object.data
    mesh.polygons.foreach_set("material_index", [0] * len(mesh.polygons))
    pictures.tint(mesh, np.zeros(len(mesh.polygons), dtype=bool))
    lesson_sheets.draw(list(mesh.edges), 0.0018)
    pictures.shaded(path)
    return path


COUNT = len(SCENES)


def tiles(out: Path, size: int) -> list[sheet.Tile]:
    """One for each scene, of this many pixels."""
    pictures.SIZE = size
    found = []
    for k, (title, scene, width) in enumerate(SCENES):
        runs = (tools.bevel(width), tools.fair_fillet(width, quads=True))
        found.append(sheet.Tile(
            [picture(scene, run, out / f"{NAME}_{k}_{n}.png") for n, run in enumerate(runs)], [title],
        ))  # fmt: skip
    return found
