"""Hard surfaces and fillets: docs/hard_surfaces.md and docs/fillet.md."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import bmesh
import bpy
import numpy as np

import demo_pictures as pictures
import letters
import tools
from rivals import SEAM
from rows import Chosen, Points, Row, moved, placed


def swept(profile: list[tuple[float, float]], rows: int, hole: Callable[[Any], bool]) -> Chosen:
    """A profile of (x, z) along y, without the faces whose middle is in the hole; the hole's rim is selected."""
    bm = bmesh.new()
    lines = [[bm.verts.new((x, y, z)) for y in np.linspace(-1.0, 1.0, rows + 1)] for x, z in profile]
    for a, b in pairwise(lines):
        for k in range(rows):
            bm.faces.new((a[k], b[k], b[k + 1], a[k + 1]))
    bmesh.ops.delete(bm, geom=[face for face in bm.faces if hole(face.calc_center_median())], context="FACES")
    mesh = bpy.data.meshes.new("Part")
    bm.to_mesh(mesh)
    bm.free()
    placed(mesh)
    pictures.add_camera((0.0, 0.0, -0.25), (0.9, -0.7, 0.9), 2.7)
    return lambda edge: bool(edge.is_boundary and all(v.co.length < 0.9 for v in edge.verts))


def box_edge() -> Chosen:
    """A hole over the edge of a box."""
    profile = [(-1 + k / 8, 0.0) for k in range(9)] + [(0.0, -k / 8) for k in range(1, 9)]
    return swept(profile, 16, lambda at: at.length < 0.55)


def bevelled_edge() -> Chosen:
    """A hole over a bevelled edge."""
    arc = [(-0.2 + 0.2 * np.sin(t), -0.2 + 0.2 * np.cos(t)) for t in np.linspace(0, np.pi / 2, 6)]
    profile = [(-1 + k / 10, 0.0) for k in range(8)] + arc + [(0.0, -0.3 - k / 10) for k in range(8)]
    return swept(profile, 16, lambda at: at.length < 0.55)


def lid() -> Chosen:
    """The top of a box, dented, all of it selected."""
    bpy.ops.mesh.primitive_cube_add(size=1.6)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=11)
    bpy.ops.object.mode_set(mode="OBJECT")

    def dented(points: Points) -> Points:
        top = points[:, 2] > 0.79
        away = np.hypot(points[:, 0] - 0.1, points[:, 1] + 0.1)
        points[top, 2] -= 0.25 * np.exp(-((away[top] / 0.2) ** 2))
        return points

    moved(dented)
    pictures.add_camera((0.0, 0.0, 0.0), (0.7, -0.9, 0.9), 2.7)
    return lambda face: bool(all(v.co.z > 0.3 for v in face.verts) and face.normal.z > 0.2)


def letter() -> Chosen:
    """A letter on a bent plate, joined by a boolean; where it meets the plate is selected."""
    bpy.context.view_layer.objects.active = letters.on_plate("R")
    pictures.add_camera((0.0, 0.0, 0.05), (0.35, -0.9, 0.9), 1.15)
    return letters.at_foot


TWO_TONES = 30.0  # stripes with which the two planes of the box differ
FILLS = {"Grid Fill": tools.grid_fill, "Fair Fill": tools.fair_fill}
SHEETS = {
    "hard_surfaces": [
        [Row("A hole over an edge", box_edge, "edges", FILLS, stripes=TWO_TONES)],
        [Row("A hole over a bevel", bevelled_edge, "edges", FILLS, stripes=TWO_TONES)],
        [Row(
            "A dented top", lid, "faces",
            {"Smooth Vertices × 60": tools.smooth_vertices(60), "Fair Region": tools.fair_region()},
        )],
    ],
    "fillets": [
        [SEAM],
        [Row("A letter", letter, "edges", {"Bevel": tools.bevel(0.03), "Fair Fillet": tools.fair_fillet(0.03)})],
    ],
}  # fmt: skip
