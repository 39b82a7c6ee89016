"""Small software renderer: orthographic views with reflection stripes, for contact sheets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshing import face_normals
from rasteriser import FloatArray, IntArray, View, averaged, edge_distances, rasterise

STRIPES = 9.0  # light bands over half a turn of the normal
FINER = 2  # pixels drawn for one of the picture, each way


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


def facing(direction: FloatArray, centre: FloatArray, reach: float) -> View:
    """A view against `direction`, z upwards as far as possible; reach: half the window's width."""
    eye = direction / np.linalg.norm(direction)
    return View(tuple(centre), tuple(eye), 2.0 * reach, (0.0, 0.0, 1.0) if abs(eye[2]) < 0.9 else (0.0, 1.0, 0.0))


def vertex_normals(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Sums of the triangles' cross products, normalised, (n, 3)."""
    cross, sums = face_normals(vertices, triangles), np.zeros_like(vertices)
    for k in range(3):
        np.add.at(sums, triangles[:, k], cross)
    return np.asarray(sums / np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None])


def render(layers: list[Layer], view: View, size: int = 320) -> FloatArray:
    """The picture, (size, size, 3) in 0 … 1, of all layers with one depth buffer."""
    large = FINER * size
    starts = np.cumsum([0] + [len(layer.vertices) for layer in layers])
    projected = np.concatenate([view.project(layer.vertices, large) for layer in layers])
    triangles = np.concatenate([layer.triangles + start for layer, start in zip(layers, starts, strict=False)])
    normals = np.concatenate([vertex_normals(layer.vertices, layer.triangles) for layer in layers])
    seen = rasterise(projected, triangles, (large, large))
    which = seen.triangle[seen.covered]
    turned = np.einsum("kc,kcd->kd", seen.weights[seen.covered], normals[triangles[which]]) @ view.axes.T
    away = edge_distances(projected, triangles, seen)
    colours, first = np.ones((len(which), 3)), 0
    for layer in layers:
        mine = (which >= first) & (which < first + len(layer.triangles))
        colours[mine] = _shaded(layer, turned[mine])
        if layer.wire:
            away[(which >= first) & (which < first + layer.halves), 0] = np.inf
            colours[mine & (away.min(axis=1) < 0.5 * FINER)] *= 0.6
        first += len(layer.triangles)
    picture = np.ones((large, large, 3))
    picture[seen.covered] = colours
    return averaged(picture, FINER)


def _shaded(layer: Layer, normals: FloatArray) -> FloatArray:
    """Colours (k, 3) of pixels with these normals, right, up and towards the eye; back faces are dark red."""
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    light = 0.35 + 0.65 * np.abs(unit @ np.array([0.33, 0.5, 0.8])).clip(0, 1)
    colour = np.where(unit[:, 2:] < 0, np.array([0.55, 0.2, 0.2]), np.array(layer.colour))
    if layer.striped:
        band = np.sin(2 * STRIPES * np.arcsin(np.clip(unit[:, 1], -1, 1)))
        colour = colour * np.where(band > 0, 1.0, 0.45)[:, None]
    return np.asarray(colour * light[:, None])
