"""Polygon meshes as the add-on reads them: grids, and whatever is listed face by face."""

from collections.abc import Callable, Sequence

import numpy as np
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats, Ints, Mask

Polygons = Sequence[Sequence[int]]


def polygon_mesh(positions: Floats, polygons: Polygons, selected: Mask | Sequence[bool]) -> MeshArrays:
    """Number edges as they come, split faces into fans round their first corner."""
    sides = [(a, b) for loop in polygons for a, b in zip(loop, (*loop[1:], loop[0]), strict=True)]
    edges, corner_edges = np.unique(np.sort(np.array(sides), axis=1), axis=0, return_inverse=True)
    sizes = [len(loop) for loop in polygons]
    fans = [(loop[0], loop[k], loop[k + 1]) for loop in polygons for k in range(1, len(loop) - 1)]
    return MeshArrays(
        positions=np.asarray(positions, dtype=np.float64),
        edges=edges,
        corner_vertices=np.concatenate([np.array(loop) for loop in polygons]),
        corner_edges=corner_edges.reshape(-1),
        corner_faces=np.repeat(np.arange(len(polygons)), sizes),
        triangles=np.array(fans),
        triangle_faces=np.repeat(np.arange(len(polygons)), np.array(sizes) - 2),
        in_patch=np.asarray(selected, dtype=bool),
        pinned=np.zeros(len(positions), dtype=bool),
    )


def grid_points(size: int) -> Floats:
    """The ((size + 1)², 3) points of a grid from −1 to 1 in the plane z = 0; vertex row · (size + 1) + column."""
    steps = np.linspace(-1.0, 1.0, size + 1)
    x, y = np.meshgrid(steps, steps)
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])


def grid_quads(size: int) -> list[list[int]]:
    """Its size² quads, seen counter-clockwise from above; face row · size + column."""
    rows = size + 1
    return [
        [rows * row + column, rows * row + column + 1, rows * (row + 1) + column + 1, rows * (row + 1) + column]
        for row in range(size)
        for column in range(size)
    ]


def grid(size: int, half: float, shape: Callable[[Floats], Floats] = lambda points: points) -> MeshArrays:
    """A grid of quads, of which those with a centre within `half` of the middle (largest norm) are selected."""
    flat = grid_points(size)
    quads = grid_quads(size)
    centres = flat[np.array(quads)].mean(axis=1)
    return polygon_mesh(shape(flat), quads, np.abs(centres).max(axis=1) < half)


def tube(sides: int, heights: Sequence[float]) -> tuple[Floats, list[list[int]]]:
    """Circles of radius 1 around the z-axis, from below, and a row of quads between each and the next."""
    turn = 2.0 * np.pi * np.arange(sides) / sides
    points = np.array([(x, y, z) for z in heights for x, y in zip(np.cos(turn), np.sin(turn), strict=True)])
    quads = [
        [sides * row + k, sides * row + (k + 1) % sides, sides * (row + 1) + (k + 1) % sides, sides * (row + 1) + k]
        for row in range(len(heights) - 1)
        for k in range(sides)
    ]
    return points, quads


def hexagon(rings: int) -> tuple[Floats, Ints]:
    """A flat hexagon of equilateral triangles, its rim first and counter-clockwise from the positive x-axis."""
    span = range(-rings, rings + 1)
    places = [(i, j) for i in span for j in span if abs(i + j) <= rings]
    flat = np.array([(i + 0.5 * j, np.sqrt(0.75) * j, 0.0) for i, j in places])
    ring = np.array([max(abs(i), abs(j), abs(i + j)) for i, j in places])
    order = np.lexsort([np.arctan2(flat[:, 1], flat[:, 0]) % (2 * np.pi), -ring])
    number = {places[old]: k for k, old in enumerate(order.tolist())}
    triangles = [
        [number[(i, j)], number[b], number[c]]
        for i, j in places
        for b, c in (((i + 1, j), (i, j + 1)), ((i + 1, j - 1), (i + 1, j)))
        if b in number and c in number
    ]
    return flat[order], np.array(triangles)


def on_sphere(points: Floats) -> Floats:
    """The points over the plane z = 0, from −1 to 1, on the unit sphere around the origin: a cube's upper side."""
    lifted = points + np.array([0.0, 0.0, 1.0])
    return lifted / np.linalg.norm(lifted, axis=1, keepdims=True)
