"""What the options of Fair Region do: the rows of docs/user_guide.md."""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes
import tools
from rows import Chosen, Row, marked


def ball() -> Chosen:
    """A sphere whose upper half is pressed flat."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    obj = bpy.context.object
    obj.data.shade_smooth()
    upper = np.array([polygon.center.z > 0.0 for polygon in obj.data.polygons])
    points = scenes.positions(obj.data)
    above = points[:, 2] > 1e-4
    points[above, 2] *= -0.4 + 0.2 * np.cos(9.0 * points[above, 0])
    obj.data.vertices.foreach_set("co", points.ravel().astype(np.float32))
    obj.data.update()
    pictures.add_camera((0.0, 0.0, 0.15), (1.0, -1.0, 0.5), 2.9)
    return marked(upper)


def hill() -> Chosen:
    """A plain with a hill on it, selected with some of the plain; groups "Top" and "Ring"."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=64, y_subdivisions=64, size=2.0)
    obj = bpy.context.object
    obj.data.shade_smooth()
    points = scenes.positions(obj.data)
    radius = np.linalg.norm(points[:, :2], axis=1)
    points[:, 2] = 0.5 * np.exp(-6.0 * radius**2) - 0.15 * points[:, 0] ** 2
    obj.data.vertices.foreach_set("co", points.ravel().astype(np.float32))
    top = [int(radius.argmin())]
    ring = np.isclose(np.abs(points[:, :2]).max(axis=1), 0.25, atol=1e-3)
    obj.vertex_groups.new(name="Top").add(top, 1.0, "REPLACE")
    obj.vertex_groups.new(name="Ring").add(np.flatnonzero(ring).tolist(), 1.0, "REPLACE")
    pictures.add_camera((0.0, 0.0, 0.1), (0.6, -1.0, 0.6), 2.3)
    centres = np.array([polygon.center for polygon in obj.data.polygons])
    return marked(np.linalg.norm(centres[:, :2], axis=1) < 0.6)


def ear() -> Chosen:
    """Suzanne's ear."""
    monkey = scenes.suzanne()
    pictures.add_camera((0.85, 0.0, 0.2), (1.0, -0.6, 0.2), 1.7)
    return marked(scenes.ear_faces(monkey.data))


def faired(scene: Callable[[], Chosen], runs: dict[str, dict[str, Any]]) -> list[list[Row]]:
    """The scene, then results with options, by their captions."""
    made = {name: tools.fair_region(allow_folds=True, **options) for name, options in runs.items()}
    return [[Row("Before", scene, "faces", made, striped=False)]]


SHEETS = {
    "guide_factor": faired(ear, {"Factor .5": {"factor": 0.5}, "Factor 1": {}}),
    "guide_shape": faired(
        ball,
        {
            "Harmonic": {"shape": "HARMONIC"},
            "Minimal Energy": {"shape": "MINIMAL_ENERGY"},
            "Continuity: Position": {"continuity": "G0"},
        },
    ),
    "guide_bulge": faired(hill, {f"Bulge {bulge:g}": {"bulge": bulge} for bulge in (-0.5, 0.0, 0.3, 0.6)}),
    "guide_pins": faired(hill, {"No pin": {}, "A point": {"pin_group": "Top"}, "A ring": {"pin_group": "Ring"}}),
}
