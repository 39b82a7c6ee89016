"""What the story's later chapters play on: boundaries in a bad state, half a sphere, face sets."""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

import scenes


def centres() -> Any:
    """(f, 3): the middles of the active object's polygons."""
    return np.array([polygon.center for polygon in bpy.context.object.data.polygons])


def move(change: Callable[[Any], Any]) -> None:
    """Move the active object's vertices (n, 3) in object mode."""
    mesh = bpy.context.object.data
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    mesh.vertices.foreach_set("co", np.asarray(change(flat.reshape(-1, 3)), dtype=np.float32).ravel())
    mesh.update()


def object_positions() -> Any:
    """The positions (n, 3) of the active object's mesh outside edit mode."""
    mesh = bpy.context.object.data
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def mask() -> Any:
    """The mask (n,) of the active object; zeros where there is none."""
    mesh = bpy.context.object.data
    values = np.zeros(len(mesh.vertices), dtype=np.float32)
    if ".sculpt_mask" in mesh.attributes:
        mesh.attributes[".sculpt_mask"].data.foreach_get("value", values)
    return values


def _hills(points: Any) -> Any:
    points[:, 2] = 0.25 * np.cos(1.6 * points[:, 0]) * np.cos(1.3 * points[:, 1])
    return points


def spoilt_rim(size: int = 48) -> int:
    """A gentle hill, its top selected; on one side the faces around the boundary are crumpled."""
    scenes.clear()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=size, y_subdivisions=size, size=3.0)
    random = np.random.default_rng(4)

    def crumple(points: Any) -> Any:
        points = _hills(points)
        band = (np.abs(np.linalg.norm(points[:, :2], axis=1) - 0.85) < 0.12) & (points[:, 0] > 0.3)
        points[band] += random.normal(0.0, 0.03, (np.count_nonzero(band), 3))
        return points

    move(crumple)
    return scenes.start(np.linalg.norm(centres()[:, :2], axis=1) < 0.8)


def _ball() -> None:
    scenes.clear()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)


def dome() -> int:
    """A sphere, its upper half selected: no surface with a bulge of 0.3 fits."""
    _ball()
    return scenes.start(centres()[:, 2] > 0.0)


def _squashed_ball() -> Any:
    """Add a sphere with a shaken upper half; return its faces (f,) of that half."""
    _ball()
    random = np.random.default_rng(0)

    def squashed(points: Any) -> Any:
        upper = points[:, 2] > 0.01
        points[upper, 2] *= 0.3
        points[upper] += random.normal(0.0, 0.01, (np.count_nonzero(upper), 3))
        return points

    upper = centres()[:, 2] > 0.0
    move(squashed)
    bpy.context.object.data.shade_smooth()
    return upper


def face_sets() -> int:
    """A sphere in object mode, its squashed upper half one face set, the rest another; return the first one's size."""
    upper = _squashed_ball()
    layer = bpy.context.object.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    layer.data.foreach_set("value", np.where(upper, 7, 3).astype(np.int32))
    return int(np.count_nonzero(upper))


def dented() -> None:
    """A sphere in object mode with a dent in front."""
    scenes.clear()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6)
    towards = np.array([0.5, -0.7, 0.5]) / np.linalg.norm([0.5, -0.7, 0.5])

    def pushed(points: Any) -> Any:
        return points * (1.0 - 0.2 * np.exp(-60.0 * (1.0 - points @ towards))[:, None])

    move(pushed)
    bpy.context.object.data.shade_smooth()
