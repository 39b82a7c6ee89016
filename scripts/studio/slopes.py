"""Creases, and joins that continue the curvature: docs/curves.md and docs/joins.md."""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes
import tools
from rows import Chosen, Points, Row, moved, placed


def roughened(amount: float, where: Callable[[Points], Any]) -> None:
    """Move the active mesh's vertices in a region by noise along each axis."""
    random = np.random.default_rng(2)

    def rough(points: Points) -> Points:
        inside = where(points)
        points[inside] += random.normal(0.0, amount, (int(np.count_nonzero(inside)), 3))
        return points

    moved(rough)


def marked_sharp(on_edge: Callable[[Points], Any]) -> None:
    """Mark the active mesh's edges between vertices of a region as sharp."""
    mesh = bpy.context.object.data
    chosen = on_edge(scenes.positions(mesh))
    for edge in mesh.edges:
        edge.use_edge_sharp = bool(chosen[list(edge.vertices)].all())


def noisy_edge() -> Chosen:
    """The edge of a box, marked sharp, its surroundings noisy."""
    bpy.ops.mesh.primitive_cube_add(size=1.6)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=23)
    bpy.ops.object.mode_set(mode="OBJECT")
    marked_sharp(lambda points: (np.abs(points) > 0.799).sum(axis=1) > 1)
    edge = np.array([0.8, 0.0, 0.8])
    roughened(
        0.015,
        lambda points: (np.linalg.norm(points - edge, axis=1) < 0.5) & ((np.abs(points) > 0.799).sum(axis=1) < 2),
    )
    pictures.add_camera((0.0, 0.0, 0.0), (1.0, -0.7, 0.8), 2.6)
    return lambda face: bool(np.linalg.norm((np.array(face.calc_center_median()) - edge) * (1.0, 0.9, 1.0)) < 0.64)


def on_rim(points: Points) -> Any:
    """Which vertices of noisy_rim's lid are on its rim."""
    return (np.hypot(points[:, 0], points[:, 1]) > 0.799) & (points[:, 2] > 0.399)


def noisy_rim() -> Chosen:
    """The lid of a cylinder and its rim, marked sharp, noisy."""
    rings = [(0.08 * k, 0.4) for k in range(1, 10)] + [(0.8, 0.4 - 0.08 * k) for k in range(12)]
    count = 64
    angles = 2.0 * np.pi * np.arange(count) / count
    points = [(0.0, 0.0, 0.4)] + [(r * np.cos(a), r * np.sin(a), z) for r, z in rings for a in angles]
    faces: list[Any] = [(0, 1 + j, 1 + (j + 1) % count) for j in range(count)]
    for k in range(len(rings) - 1):
        a, b = 1 + k * count, 1 + (k + 1) * count
        faces += [(a + j, b + j, b + (j + 1) % count, a + (j + 1) % count) for j in range(count)]
    mesh = bpy.data.meshes.new("Lid")
    mesh.from_pydata(points, [], faces)
    placed(mesh)
    marked_sharp(on_rim)
    roughened(0.012, lambda at: (at[:, 2] > -0.05) & ~on_rim(at))
    pictures.add_camera((0.0, 0.0, 0.0), (0.6, -1.0, 0.8), 2.2)
    return lambda face: bool(face.calc_center_median().z > -0.2)


def crown() -> Chosen:
    """A panel that bends more and more towards its sides, its middle dented."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=80, y_subdivisions=80, size=2.0)

    def dented(points: Points) -> Points:
        x, y = points[:, 0], points[:, 1]
        points[:, 2] = 0.5 - 0.55 * np.abs(x) ** 3 - 0.1 * y**2 - 0.1 * np.exp(-((x / 0.2) ** 2) - (y / 0.2) ** 2)
        return points

    moved(dented)
    pictures.add_camera((0.0, 0.0, 0.25), (0.4, -0.8, 1.0), 2.1)
    return lambda face: bool(np.hypot(*face.calc_center_median().xy) < 0.62)


SLOPES = {
    name: tools.fair_region(pin_edges="SHARP", pin_slope=slope, fair_pinned_edges=False)
    for name, slope in (("Averaged", "AVERAGE"), ("Crease", "CREASE"))
}
FINE = 40.0  # stripes: they show a jump of the curvature
JOINS = {"Tangent": tools.fair_region(), "Curvature": tools.fair_region(continuity="G2")}
SHEETS = {
    "curves": [
        [Row("A box's edge", noisy_edge, "faces", SLOPES)],
        [Row("A lid's rim", noisy_rim, "faces", SLOPES)],
    ],
    "joins": [
        [Row("A crowned panel", crown, "faces", JOINS, stripes=FINE)],
    ],
}
