"""Surfaces over wires, for docs/curves.md: the wires, what Fair From Curves makes of them, and its reflections."""

import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "tests"))

import bpy
import numpy as np

import demo_pictures as pictures
import lesson_sheets
import sheet
import tools
import wire_networks as networks
from rows import placed

NAME = "from_curves"
FINE = 0.4  # of the wires' edges: reflections show no faces then


def arch() -> networks.Wires:
    """A panel with half of a wheel's opening, whose lip stands out."""

    def at(x: float, z: float) -> list[float]:
        lip = 0.10 * np.exp(-(((np.hypot(x, z) - 0.5) / 0.22) ** 2))
        return [x, -0.2 * np.cos(0.9 * x) * np.cos(0.9 * z) - lip, z]

    drawing = networks.Drawing()
    for radius, steps in ((0.5, 32), (0.75, 40)):
        drawing.line([at(radius * np.cos(a), radius * np.sin(a)) for a in np.linspace(0.0, np.pi, steps + 1)])
    for x, z in ((1.5, 0.0), (1.1, 1.1), (0.0, 1.1), (-1.1, 1.1), (-1.5, 0.0)):
        way = np.array([x, z]) / np.hypot(x, z)
        inner = [at(*(r * way)) for r in np.linspace(0.5, 0.75, 6)]
        drawing.line([*inner, *(at(*p) for p in np.linspace(0.75 * way, (x, z), 13)[1:])])
    corners = [(1.5, 0.0), (1.5, 1.1), (1.1, 1.1), (0.0, 1.1), (-1.1, 1.1), (-1.5, 1.1), (-1.5, 0.0)]
    for a, b in pairwise(corners):
        steps = max(4, round(16 * np.hypot(a[0] - b[0], a[1] - b[1])))
        drawing.line([at(*p) for p in np.linspace(a, b, steps + 1)])
    return drawing.wires


Scene = tuple[str, Callable[[], networks.Wires], tuple[float, float, float], tuple[float, float, float], float]
SCENES: tuple[Scene, ...] = (
    ("Three circles", lambda: networks.circles([1.0, 1.0, 1.0], 48), (0.0, 0.0, 0.0), (1.0, -0.6, 0.5), 2.6),
    ("A bottle", lambda: networks.bottle(1.0, 0.36, 3.0), (0.0, 0.0, 1.5), (1.0, -0.55, 0.35), 3.8),
    ("A hull", lambda: networks.hull(6.0, 1.0, 0.9, 0.35), (0.0, 0.0, -0.25), (0.6, -1.0, 0.45), 5.8),
    ("A wheel arch", arch, (0.0, 0.0, 0.5), (0.35, -1.0, 0.3), 3.2),
)

COUNT = len(SCENES)


def begun(scene: Scene) -> bpy.types.Object:
    """The wires alone, with a camera."""
    _, wires, target, direction, width = scene
    bpy.ops.wm.read_homefile(use_empty=True)
    points, edges = wires()
    mesh = bpy.data.meshes.new("Wires")
    mesh.from_pydata(points.tolist(), edges.tolist(), [])
    obj = placed(mesh)
    pictures.add_camera(target, direction, width)
    pictures.tint(mesh, np.empty(0, dtype=bool))
    return obj


def tile(scene: Scene, path: Path) -> sheet.Tile:
    """Three pictures, one above the other."""
    names = [path.with_name(f"{path.name}_{k}.png") for k in range(3)]
    obj = begun(scene)
    count = len(obj.data.edges)
    lesson_sheets.draw(list(obj.data.edges))
    pictures.shaded(names[0])
    obj = begun(scene)
    tools.select("edges", lambda edge: True)
    bpy.ops.mesh.fair_from_curves("EXEC_DEFAULT", spacing=FINE)
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.data.polygons.foreach_set("material_index", [0] * len(obj.data.polygons))
    pictures.striped(names[2])
    lesson_sheets.draw(list(obj.data.edges)[:count])
    pictures.shaded(names[1])
    return sheet.Tile(names, [scene[0]])


def tiles(out: Path, size: int) -> list[sheet.Tile]:
    """One for each scene, of this many pixels."""
    pictures.SIZE = size
    return [tile(scene, out / f"{NAME}_{k}") for k, scene in enumerate(SCENES)]
