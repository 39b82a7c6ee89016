"""Random surfaces with hard edges, bevels and rolled edges: extruded, turned, built of blocks."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fairing

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mesh = tuple[FloatArray, IntArray]  # vertices (n, 3), triangles (m, 3)


def profile(rng: Any, edge: float) -> tuple[FloatArray, NDArray[np.bool_]]:
    """(k, 2) points of a polyline that turns by 15° to 110°, corners sharp or rounded in one to eight steps, and which
    of its points are corners or ends of arcs."""
    heading, place = 0.0, np.zeros(2)
    points, corners = [place], [True]
    for k in range(int(rng.integers(2, 5))):
        if k:
            turn = np.radians(rng.uniform(15, 110)) * rng.choice([1, 1, 1, -1])
            steps = int(rng.integers(1, 9)) if rng.random() < 0.5 else 0
            chord = rng.uniform(0.4, 1.2) * edge
            for _ in range(steps):
                heading += 0.5 * turn / steps
                place = place + chord * np.array([np.cos(heading), np.sin(heading)])
                points.append(place)
                corners.append(True)
                heading += 0.5 * turn / steps
            heading += 0.0 if steps else turn
        length = rng.uniform(0.5, 1.0)
        steps = max(2, round(length / edge))
        for _ in range(steps):
            place = place + length / steps * np.array([np.cos(heading), np.sin(heading)])
            points.append(place)
            corners.append(False)
        corners[-1] = True
    return np.array(points), np.array(corners)


def swept(rng: Any) -> Mesh:
    """A profile extruded along a straight line, an arc, or all around an axis; jittered, with random diagonals."""
    edge = 1.0 / rng.integers(7, 15)
    points, corners = profile(rng, edge)
    rows = int(rng.integers(10, 20))
    kind = rng.choice(["straight", "arc", "turned"])
    along = np.arange(rows + (kind != "turned")) * edge
    i, j = (a.ravel() for a in np.meshgrid(np.arange(len(points)), np.arange(len(along)), indexing="ij"))
    y = along[j] + 0.25 * edge * rng.uniform(-1, 1, len(j)) * ((j > 0) & (j < len(along) - 1))
    xz = points[i]
    before, after = points[np.maximum(i - 1, 0)], points[np.minimum(i + 1, len(points) - 1)]
    shift = 0.25 * rng.uniform(-1, 1, len(i)) * ~corners[i]
    xz = (
        xz
        + np.where(shift > 0, shift, 0)[:, None] * (after - xz)
        - np.where(shift < 0, shift, 0)[:, None] * (before - xz)
    )
    if kind == "straight":
        vertices = np.column_stack([xz[:, 0], y, xz[:, 1]])
    else:
        whole = rows * edge
        radius = whole / (2 * np.pi) if kind == "turned" else whole / rng.uniform(0.3, 1.5)
        out = radius - xz[:, 1].min() + xz[:, 1] if kind == "turned" else radius + xz[:, 1]
        vertices = np.column_stack([xz[:, 0], out * np.sin(y / radius), out * np.cos(y / radius)])
    number = np.arange(len(i)).reshape(len(points), len(along))
    if kind == "turned":
        number = np.column_stack([number, number[:, 0]])
    return vertices, cut_quads(number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:], rng)


def cut_quads(a: Any, b: Any, c: Any, d: Any, rng: Any) -> IntArray:
    """Two triangles for each quad, along either diagonal."""
    a, b, c, d = (np.ravel(x) for x in (a, b, c, d))
    one = rng.random(len(a)) < 0.5
    return np.concatenate([
        np.column_stack([a, b, np.where(one, c, d)]), np.column_stack([np.where(one, a, b), c, d]),
    ])  # fmt: skip


def blocks(rng: Any) -> Mesh:
    """The surface of up to six blocks of a cube that are joined by faces: convex and concave edges, corners; sheared,
    and bent a little. Without edges and vertices at which two parts touch."""
    while True:
        vertices, triangles = _blocks(rng)
        try:
            fairing.boundary_loops(triangles)
        except fairing.MeshError:
            continue
        return vertices, triangles


def _blocks(rng: Any) -> Mesh:
    filled = {(0, 0, 0)}
    for _ in range(int(rng.integers(0, 6))):
        beside = [cell for cell in product(range(2), repeat=3) if cell not in filled and _steps(cell, filled) == 1]
        filled.add(beside[int(rng.integers(len(beside)))])
    n = int(rng.integers(5, 10))
    corners = []
    for cell, axis, sign in product(sorted(filled), range(3), (0, 1)):
        other = tuple(cell[k] + (2 * sign - 1) * (k == axis) for k in range(3))
        if other in filled:
            continue
        i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
        quad = np.empty((len(i), 4, 3), dtype=np.int64)
        quad[..., axis] = n * (cell[axis] + sign)
        quad[..., (axis + 1) % 3] = n * cell[(axis + 1) % 3] + i[:, None] + (0, 1, 1, 0)
        quad[..., (axis + 2) % 3] = n * cell[(axis + 2) % 3] + j[:, None] + (0, 0, 1, 1)
        corners.append(quad if sign else quad[:, ::-1])
    places, index = np.unique(np.concatenate(corners).reshape(-1, 3), axis=0, return_inverse=True)
    triangles = cut_quads(*index.reshape(-1, 4).T, rng)
    free = np.mod(places, n) != 0  # a vertex moves along no axis on which it lies in a side of a block
    vertices = (places + 0.2 * rng.uniform(-1, 1, places.shape) * free) / n
    shear = np.eye(3) + rng.uniform(-0.25, 0.25, (3, 3))
    bend = rng.uniform(-0.15, 0.15)
    vertices[:, 2] += bend * (vertices[:, 0] - 1) ** 2
    return vertices @ shear, triangles


def _steps(cell: tuple[int, ...], filled: set[tuple[int, int, int]]) -> int:
    return min(sum(abs(a - b) for a, b in zip(cell, other, strict=True)) for other in filled)
