"""Six cylinders of radius 1 along the coordinate axes, both ways, blended in the middle: χ = −4.

Each octant is a hexagon: three quarter circles `reach` from the origin and three sides in the coordinate
planes, which it shares with its neighbours. It is triangulated flat, and the eight are glued.
"""

from collections.abc import Callable
from itertools import product

import numpy as np

from blend import Blend, between, sheet, triangulated
from curves import FloatArray
from meshing import IntArray
from shapes import membrane

QUARTER = 0.5 * np.pi


def six_arms(n_free: int, *, jitter: float = 0.6, seed: int = 0, reach: float = 2.5) -> Blend:
    """An irregular mesh with about n_free free vertices; jitter 0 gives the regular kind."""
    h = float(np.sqrt(8 * area(reach) / (0.5 * np.sqrt(3) * n_free)))
    for _ in range(8):
        made = _even_octants(h, jitter, seed, reach)
        count = len(made.vertices) - len(made.fixed)
        if abs(count - n_free) < 0.01 * n_free:
            break
        h *= float(np.sqrt(count / n_free))
    return made


def _side(reach: float) -> float:
    """Length of a side in space, roughly: the blend cuts the corner at distance 1 from both axes."""
    return 1.8 * (reach - 1.0)


def area(reach: float) -> float:
    """Of the equiangular hexagon whose sides are a quarter circle and `_side` in turn."""
    a, b = QUARTER, _side(reach)
    return float(0.25 * np.sqrt(3) * (a * a + 4 * a * b + b * b))


def _outline(reach: float, h: float) -> tuple[FloatArray, FloatArray, IntArray]:
    """The flat hexagon (k, 2), each point's place in the first octant (k, 3), and its rim's axis or −1.

    Places on the sides are straight stand-ins: neighbours recognise each other by them.
    """
    corner, flat, places, axes = np.zeros(2), [], [], []
    for axis in range(3):
        x, y, z = np.roll(np.eye(3), -axis, axis=0)
        for kind, length in ((axis, QUARTER), (-1, _side(reach))):
            turn = np.pi / 3 * (2 * axis + (kind < 0))
            ahead = corner + length * np.array([np.cos(turn), np.sin(turn)])
            points = np.vstack([corner, between(corner, ahead, h)])
            share = np.linspace(0, 1, len(points) + 1)[:-1, None]
            arc = reach * x + np.sin(QUARTER * share) * y + np.cos(QUARTER * share) * z
            line = (1 - share) * (reach * x + y) + share * (reach * y + x)
            flat.append(points)
            places.append(line if kind < 0 else arc)
            # A side begins at a corner, which is on the rim too.
            axes.append(np.where(np.arange(len(points)) == 0, axis, kind))
            corner = ahead
    return np.vstack(flat), np.vstack(places), np.concatenate(axes)


def _even_octants(h: float, jitter: float, seed: int, reach: float) -> Blend:
    rng = np.random.default_rng(seed)
    return of_octants(h, reach, lambda flat: sheet(flat, h, jitter, rng))


def of_octants(h: float, reach: float, make: Callable[[FloatArray], FloatArray]) -> Blend:
    """The blend whose outlines have edges of about h; `make` gives the points inside each flat octant in turn."""
    flat, places, axes = _outline(reach, h)
    # The first corner of a rim closes the side before it, which lies in another plane: both know it by its place.
    shared, triangles, owners = [], [], []
    count = 8 * len(flat)
    for octant, signs in enumerate(product((1.0, -1.0), repeat=3)):
        inside = make(flat)
        faces = triangulated(flat, inside)
        rows = np.concatenate([octant * len(flat) + np.arange(len(flat)), count + np.arange(len(inside))])
        count += len(inside)
        triangles.append(rows[faces if np.prod(signs) > 0 else faces[:, ::-1]])
        shared.append(places * np.array(signs))
        owners.append(axes)
    return _joined(np.vstack(shared), np.concatenate(owners), np.vstack(triangles), count)


def _joined(places: FloatArray, axes: IntArray, triangles: IntArray, count: int) -> Blend:
    """Outline points of the same place become one vertex; those on rims are fixed there."""
    _, first, number = np.unique(np.round(places, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    merged = np.concatenate([number.ravel(), len(first) + np.arange(count - len(places))])
    vertices = np.zeros((len(first) + count - len(places), 3))
    fixed = np.flatnonzero(axes[first] >= 0)
    vertices[fixed] = places[first][fixed]
    normals = vertices[fixed].copy()
    normals[np.arange(len(fixed)), axes[first][fixed]] = 0.0
    faces = merged[triangles]
    return Blend(membrane(vertices, faces, fixed), faces, fixed, normals)
