"""What the Quality Overlay shows, rendered: reflection lines and mean curvature of a panel before and after."""

from pathlib import Path

import bpy
import numpy as np

import demo_pictures as pictures
import rivals
import sheet
import tools

NAME = "guide_quality"
LOW, MIDDLE, HIGH = np.array([(0.10, 0.30, 0.85), (0.96, 0.96, 0.96), (0.85, 0.12, 0.10)])  # addon/show/legend.py
FULL = 1.0  # curvature with the full colour: the overlay's Range


def curvature(path: Path) -> None:
    """Red where the surface bulges out, blue where it caves in; by the add-on's own attribute."""
    bpy.ops.mesh.fair_curvature()
    mesh = bpy.context.object.data
    values = np.empty(len(mesh.vertices), dtype=np.float32)
    mesh.attributes["mean_curvature"].data.foreach_get("value", values)
    shares = np.clip(-values / FULL, -1.0, 1.0)[:, None]
    tones = MIDDLE + np.abs(shares) * (np.where(shares < 0.0, LOW, HIGH) - MIDDLE)
    colours = mesh.color_attributes.new("Curvature", "FLOAT_COLOR", "POINT")
    colours.data.foreach_set("color", np.column_stack([tones**2.2, np.ones(len(tones))]).astype(np.float32).ravel())
    mesh.color_attributes.active_color = colours
    pictures.shaded(path, "VERTEX")


def tiles(out: Path, size: int) -> list[sheet.Tile]:
    """Four pictures of this many pixels."""
    pictures.SIZE = size
    made = []
    for mode, picture in (("Reflection Lines", pictures.striped), ("Mean Curvature", curvature)):
        for when in ("before", "after"):
            bpy.ops.wm.read_homefile(use_empty=True)
            tools.select("faces", rivals.panel())
            if when == "after":
                bpy.ops.mesh.fair_region("EXEC_DEFAULT")
            bpy.ops.object.mode_set(mode="OBJECT")
            bpy.context.object.data.shade_smooth()
            made.append(sheet.Tile([out / f"{NAME}_{len(made)}.png"], [f"{mode}: {when}"]))
            picture(made[-1].pictures[0])
    return made
