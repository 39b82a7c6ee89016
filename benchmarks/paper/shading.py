"""Pictures of meshes: flat clay as in the paper, mirrored stripes, a checkerboard."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rasteriser import FloatArray, Fragments, IntArray, Mask, View, averaged, edge_distances, rasterise

SUPERSAMPLING = 3
BACKGROUND = np.array([0.93, 0.94, 0.95])
CLAY = np.array([0.70, 0.70, 0.70])
FAIRED = np.array([0.86, 0.66, 0.45])
OUTLINE = np.array([0.75, 0.10, 0.10])
LIGHTS = ((-0.5, 0.7, 0.75, 0.75), (0.8, 0.1, 0.5, 0.30))  # x, y, z towards the light, strength


@dataclass(frozen=True)
class Look:
    """What is shown: kind "flat", "stripes" or "checker"; wire: strength of the edges drawn over it.

    stripes: radians of the stripes' phase per radian of the mirrored ray.
    """

    kind: str
    wire: float = 0.0
    stripes: float = 14.0


@dataclass(frozen=True)
class Model:
    """A mesh to be shown.

    vertices (n, 3); triangles (m, 3); normals (n, 3) for stripes; `own` (k,): the triangles that were faired;
    uv (n, 2) for the checkerboard, one square per unit; marked (k,): vertices of curves to be drawn.
    """

    vertices: FloatArray
    triangles: IntArray
    normals: FloatArray
    own: IntArray
    uv: FloatArray | None = None
    marked: IntArray | None = None


def draw(model: Model, view: View, pixels: int, look: Look) -> FloatArray:
    """A picture (h, pixels, 3) in [0, 1]."""
    large = pixels * SUPERSAMPLING
    shape = (round(large * view.aspect), large)
    projected = view.project(model.vertices, large)
    fragments = rasterise(projected, model.triangles, shape)
    picture = np.broadcast_to(BACKGROUND, (*shape, 3)).copy()
    seen = fragments.covered
    picture[seen] = _colours(model, view, fragments, look)
    picture[seen] *= 1 - look.wire * _lines(projected, model.triangles, fragments, None, 0.5)[:, None]
    if model.marked is not None:
        on_curve = np.isin(model.triangles, model.marked)
        chosen = np.roll(on_curve, -1, axis=1) & np.roll(on_curve, 1, axis=1)
        share = _lines(projected, model.triangles, fragments, chosen, 1.2)[:, None]
        picture[seen] = (1 - share) * picture[seen] + share * OUTLINE
    return averaged(picture, SUPERSAMPLING)


def _colours(model: Model, view: View, fragments: Fragments, look: Look) -> FloatArray:
    """(k, 3) of the covered pixels."""
    seen = fragments.covered
    triangle, weights = fragments.triangle[seen], fragments.weights[seen]
    normals = _flat(model)[triangle] if look.kind == "flat" else _smooth(model, triangle, weights)
    normals = normals @ view.axes.T
    behind = (_flat(model)[triangle] @ view.axes[2] < 0)[:, None]
    normals *= np.where(normals[:, 2] < 0, -1.0, 1.0)[:, None]
    if look.kind == "stripes":
        return np.where(behind, 0.55 * CLAY, _mirrored(normals, look.stripes))
    base = np.where(np.isin(triangle, model.own)[:, None], FAIRED, CLAY)
    if look.kind == "checker" and model.uv is not None:
        at = np.einsum("kc,kcd->kd", weights, model.uv[model.triangles[triangle]])
        dark = np.floor(at).sum(axis=1) % 2 > 0
        base = np.where(dark[:, None], 0.62 * base, base)
    return _lit(np.where(behind, 0.8 * CLAY, base), normals)


def _flat(model: Model) -> FloatArray:
    a, b, c = (model.vertices[model.triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    return np.asarray(cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-300)[:, None])


def _smooth(model: Model, triangle: IntArray, weights: FloatArray) -> FloatArray:
    normals = np.einsum("kc,kcd->kd", weights, model.normals[model.triangles[triangle]])
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None])


def _lit(base: FloatArray, normals: FloatArray) -> FloatArray:
    light = np.full(len(normals), 0.22)
    for x, y, z, strength in LIGHTS:
        towards = np.array([x, y, z]) / np.linalg.norm([x, y, z])
        light += strength * np.clip(normals @ towards, 0, None)
    return np.asarray(np.clip(base * light[:, None] * 1.15, 0, 1))


def _mirrored(normals: FloatArray, frequency: float) -> FloatArray:
    """Stripes around a tilted axis as a mirror shows them: a kink breaks them, a curvature jump bends them."""
    ray = 2 * normals[:, 2:] * normals - np.array([0.0, 0.0, 1.0])
    tilt = np.array([0.25, 0.95, 0.18])
    height = np.arcsin(np.clip(ray @ (tilt / np.linalg.norm(tilt)), -1, 1))
    wave = np.clip(0.5 + np.sin(frequency * height) / 0.5, 0, 1)
    tone = (0.10 + 0.85 * wave) * (0.55 + 0.45 * normals[:, 2])
    return np.asarray(tone[:, None] * np.array([1.0, 0.99, 0.97]))


def _lines(
    projected: FloatArray, triangles: IntArray, fragments: Fragments, chosen: Mask | None, reach: float
) -> FloatArray:
    """1 on edges of the covered pixels' triangles, 0 further off than `reach` final pixels.

    chosen (m, 3): whether the edge opposite each corner counts; all without it.
    """
    away = edge_distances(projected, triangles, fragments)
    if chosen is not None:
        away = np.where(chosen[fragments.triangle[fragments.covered]], away, np.inf)
    return np.asarray(np.clip(1.5 - away.min(axis=1) / (reach * SUPERSAMPLING), 0, 1))
