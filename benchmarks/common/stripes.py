"""Small software renderer: orthographic views with reflection stripes, for contact sheets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine import FloatArray
from meshing import IntArray, face_normals

STRIPES = 9.0  # light bands over half a turn of the normal


@dataclass(frozen=True)
class Layer:
    """Triangles (m, 3) of vertices (n, 3) in one colour (0 … 1), striped or plain, its edges drawn or not.

    halves: so many of the first triangles are halves of quads, whose side opposite the first corner is not drawn.
    """

    vertices: FloatArray
    triangles: IntArray
    colour: tuple[float, float, float]
    striped: bool = False
    wire: bool = False
    halves: int = 0


@dataclass(frozen=True)
class View:
    """Where from: unit vectors right, up and towards the eye; centre and half-width of the window; pixels."""

    right: FloatArray
    up: FloatArray
    eye: FloatArray
    centre: FloatArray
    reach: float
    size: int = 320


def facing(direction: FloatArray, centre: FloatArray, reach: float, size: int = 320) -> View:
    """A view against `direction`, z upwards as far as possible."""
    eye = direction / np.linalg.norm(direction)
    helper = np.array([0.0, 0.0, 1.0]) if abs(eye[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
    right = np.cross(helper, eye)
    right /= np.linalg.norm(right)
    return View(right, np.cross(eye, right), eye, centre, reach, size)


def vertex_normals(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Sums of the triangles' cross products, normalised, (n, 3)."""
    cross, sums = face_normals(vertices, triangles), np.zeros_like(vertices)
    for k in range(3):
        np.add.at(sums, triangles[:, k], cross)
    return np.asarray(sums / np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None])


def render(layers: list[Layer], view: View) -> FloatArray:
    """The picture, (size, size, 3) in 0 … 1, of all layers with one depth buffer."""
    image = np.ones((view.size, view.size, 3))
    depth = np.full((view.size, view.size), -np.inf)
    for layer in layers:
        _draw(layer, view, image, depth)
    return image


def _draw(layer: Layer, view: View, image: FloatArray, depth: FloatArray) -> None:
    moved = layer.vertices - view.centre
    scale = 0.5 * view.size / view.reach
    x = 0.5 * view.size + scale * moved @ view.right
    y = 0.5 * view.size - scale * moved @ view.up
    z = moved @ view.eye
    normals = vertex_normals(layer.vertices, layer.triangles)
    for number, triangle in enumerate(layer.triangles):
        corners = _Corners(x[triangle], y[triangle], z[triangle], normals[triangle], number < layer.halves)
        _fill(layer, view, corners, (image, depth))


@dataclass(frozen=True)
class _Corners:
    """Of one triangle: pixels, depth and normals, each (3, …)."""

    x: FloatArray
    y: FloatArray
    z: FloatArray
    normals: FloatArray
    half: bool  # of a quad


def _fill(layer: Layer, view: View, at: _Corners, buffers: tuple[FloatArray, FloatArray]) -> None:
    """One triangle: barycentric coordinates of the pixels of its bounding box."""
    image, depth = buffers
    x, y, z = at.x, at.y, at.z
    low = np.maximum(np.floor([x.min(), y.min()]).astype(int), 0)
    high = np.minimum(np.ceil([x.max(), y.max()]).astype(int) + 1, view.size)
    twice = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    if (high <= low).any() or abs(twice) < 1e-9:
        return
    px, py = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    b = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / twice
    c = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / twice
    share = np.stack([1 - b - c, b, c], axis=-1)
    window = depth[low[1] : high[1], low[0] : high[0]]
    height = share @ z
    seen = (share >= -1e-9).all(axis=-1) & (height > window)
    window[seen] = height[seen]
    colours = _shaded(layer, share[seen] @ at.normals, view)
    if layer.wire:
        sides = np.hypot(x - np.roll(x, 1), y - np.roll(y, 1))
        heights = abs(twice) / np.roll(sides, 1).clip(1e-9)
        heights[0] = np.inf if at.half else heights[0]
        colours[(share[seen].clip(1e-12) * heights).min(axis=-1) < 0.5] *= 0.6
    image[low[1] : high[1], low[0] : high[0]][seen] = colours


def _shaded(layer: Layer, normals: FloatArray, view: View) -> FloatArray:
    """Colours (k, 3) of pixels with these normals; back faces are dark red."""
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    front = unit @ view.eye
    light = 0.35 + 0.65 * np.abs(unit @ (0.8 * view.eye + 0.5 * view.up + 0.33 * view.right)).clip(0, 1)
    colour = np.where(front[:, None] < 0, np.array([0.55, 0.2, 0.2]), np.array(layer.colour))
    if layer.striped:
        band = np.sin(2 * STRIPES * np.arcsin(np.clip(unit @ view.up, -1, 1)))
        colour = colour * np.where(band > 0, 1.0, 0.45)[:, None]
    return np.asarray(colour * light[:, None])
