"""Meshes of the three-cylinder blend: with a regular patch inside (Fig. 1a), and with subdivision connectivity."""

from __future__ import annotations

import numpy as np

import blend
from polygon_mesh import FloatArray, IntArray
from tetrathing import refined, trousers

REACH = 2.0
RECTANGLE = blend.Rectangle(17, 17, np.pi / 32, (0.0, 0.5))


def with_rectangle() -> blend.Blend:
    """Fig. 1a: 920 vertices, 96 of them on the circles; the regular patch is twice as fine as the rest."""
    return blend.blend_with_rectangle(824, RECTANGLE, rim=32)


def rounded(made: blend.Blend) -> FloatArray:
    """The flat Y as a pillow of thickness 2, (n, 3): half circles along its sides, nearly isometric, exact on the rims.

    A point at the distance δ from its nearest side goes to 1 − cos δ and sin δ, measured from where that side is now.
    """
    notch = blend.HALF_WIDTH / np.sin(np.pi / 3)
    corners = [notch * np.array([np.cos(a), np.sin(a)]) for a in blend.DIRECTIONS + np.pi / 3]
    flat, side = made.flat[:, :2], made.flat[:, 2]
    away = np.full(len(flat), np.inf)
    foot = np.zeros_like(flat)
    for corner, before, after in zip(corners, blend.DIRECTIONS, np.roll(blend.DIRECTIONS, -1), strict=True):
        for direction in (before, after):
            at = _on_ray(flat, corner, np.array([np.cos(direction), np.sin(direction)]))
            distance = np.linalg.norm(flat - at, axis=1)
            nearer = distance < away
            away[nearer], foot[nearer] = distance[nearer], at[nearer]
    inward = flat - foot
    length = np.linalg.norm(inward, axis=1)
    inward[length < 1e-9] = _inward_at(foot[length < 1e-9])
    inward /= np.linalg.norm(inward, axis=1)[:, None]
    depth = np.minimum(away, blend.HALF_WIDTH)
    place = foot + (blend.HALF_WIDTH - np.cos(depth) + away - depth)[:, None] * inward
    result = np.column_stack([place, side * np.sin(depth)])
    result[made.fixed] = made.vertices[made.fixed]
    return np.asarray(result)


def _on_ray(points: FloatArray, start: FloatArray, direction: FloatArray) -> FloatArray:
    """Nearest points (n, 2) of a ray."""
    along = np.maximum((points - start) @ direction, 0.0)
    return np.asarray(start + along[:, None] * direction)


def _inward_at(points: FloatArray) -> FloatArray:
    """Across the nearest arm's side, at points on the sides of the Y; towards the centre at its corners."""
    axes = np.column_stack([np.cos(blend.DIRECTIONS), np.sin(blend.DIRECTIONS)])
    along = points @ axes.T
    arm = axes[along.argmax(axis=1)]
    across = (points * arm).sum(axis=1)[:, None] * arm - points
    at_corner = np.diff(np.sort(along, axis=1)[:, 1:], axis=1)[:, 0] < 1e-6
    across[at_corner] = -points[at_corner]
    return np.asarray(across)


def subdivided_corner(times: int) -> tuple[FloatArray, IntArray, IntArray, FloatArray]:
    """Vertices, triangles, fixed vertices and their normals: one pair of trousers, 26 triangles subdivided."""
    axes = [np.array([np.cos(a), np.sin(a), 0.0]) for a in blend.DIRECTIONS]
    up = np.array([0.0, 0.0, 1.0])
    nodes = np.array([up, *(up + 9 * axis for axis in axes)])
    rings = {(0, k + 1): 4 * k for k in range(3)}
    triangles, loops, angles, count = refined(trousers(0, nodes, rings, 12), list(rings.values()), 18, times)
    vertices = np.zeros((count, 3))
    normals = []
    for loop, turn, axis in zip(loops, angles, axes, strict=True):
        radial = np.cos(turn)[:, None] * up + np.sin(turn)[:, None] * np.cross(axis, up)
        vertices[loop] = REACH * axis + radial
        normals.append(radial)
    return vertices, triangles, np.concatenate(loops), np.vstack(normals)
