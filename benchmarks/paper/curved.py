"""Curved PN triangles (Vlachos, Peters, Boyd, Mitchell 2001): the smooth surface that a coarse mesh stands for.

Distances between meshes of different size would otherwise measure their facets.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import measures
from cases import Case
from polygon_mesh import FloatArray, IntArray


def refined(vertices: FloatArray, triangles: IntArray, normals: FloatArray, steps: int) -> tuple[FloatArray, IntArray]:
    """Each triangle as steps² flat ones on its cubic patch; vertices are not shared between triangles."""
    lattice, pieces = _lattice(steps)
    powers = _bernstein(lattice)
    points = np.einsum("lk,mkd->mld", powers, _control_points(vertices, triangles, normals))
    count = len(lattice)
    faces = (np.arange(len(triangles)) * count)[:, None, None] + pieces
    return points.reshape(-1, 3), faces.reshape(-1, 3)


def _control_points(vertices: FloatArray, triangles: IntArray, normals: FloatArray) -> FloatArray:
    """(m, 10, 3): corners, two on each directed side, the centre."""
    corners = [vertices[triangles[:, k]] for k in range(3)]
    at = [normals[triangles[:, k]] for k in range(3)]
    sides = []
    for k in range(3):
        for p, q, n in ((k, (k + 1) % 3, at[k]), ((k + 1) % 3, k, at[(k + 1) % 3])):
            height = ((corners[q] - corners[p]) * n).sum(axis=1)[:, None]
            sides.append((2 * corners[p] + corners[q] - height * n) / 3)
    mean, flat = sum(sides) / 6, sum(corners) / 3
    return np.stack([*corners, *sides, mean + 0.5 * (mean - flat)], axis=1)


def _bernstein(weights: FloatArray) -> FloatArray:
    """Cubic weights (l, 10) in the order of the control points."""
    u, v, w = weights.T
    sides = [3 * p * p * q for p, q in ((u, v), (v, u), (v, w), (w, v), (w, u), (u, w))]
    return np.column_stack([u**3, v**3, w**3, *sides, 6 * u * v * w])


def _lattice(steps: int) -> tuple[FloatArray, IntArray]:
    """Barycentric coordinates (l, 3) and the small triangles between them (steps², 3)."""
    places = [(i, j) for i in range(steps + 1) for j in range(steps + 1 - i)]
    index = {place: k for k, place in enumerate(places)}
    faces = []
    for i, j in places:
        if i + j < steps:
            faces.append((index[i, j], index[i + 1, j], index[i, j + 1]))
        if i + j < steps - 1:
            faces.append((index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]))
    ij = np.array(places) / steps
    return np.column_stack([1 - ij.sum(axis=1), ij[:, 0], ij[:, 1]]), np.array(faces)


def distance(one: Case, first: FloatArray, other: Case, second: FloatArray) -> float:
    """Two-sided distance over D between two results as curved surfaces.

    From some 4000 points of each to some 30000 small triangles of the other: their facets count for less than 1e-4 D.
    """
    far = [
        measures.distance_to_mesh(np.unique(_surface(a, p, 7e3)[0], axis=0), *_surface(b, q, 3e4)).max()
        for a, p, b, q in ((one, first, other, second), (other, second, one, first))
    ]
    return float(max(far) / one.diameter)


def asymmetry(case: Case, points: FloatArray) -> float:
    """Distance over D between a result and its image in the plane z = 0, in which the boundary is symmetric."""
    mirror = np.array([1.0, 1.0, -1.0])
    image = replace(case, triangles=case.triangles[:, ::-1], normals=case.normals * mirror)
    return distance(case, points, image, points * mirror)


def _surface(case: Case, points: FloatArray, count: float) -> tuple[FloatArray, IntArray]:
    """The curved surface as about this many triangles."""
    steps = round((count / len(case.triangles)) ** 0.5)
    return refined(points, case.triangles, case.surface_normals(points), max(1, steps))
