"""Polygon meshes: closing holes, Catmull–Clark subdivision."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Mask = NDArray[np.bool_]
Polygons = list[list[int]]


def closed(polygons: Polygons) -> Polygons:
    """The polygons and one more over each border loop."""
    directed = {(int(a), int(b)) for a, b in _ends(polygons)}
    following = {b: a for a, b in directed if (b, a) not in directed}
    loops = []
    while following:
        loop = [next(iter(following))]
        while (after := following.pop(loop[-1])) != loop[0]:
            loop.append(after)
        loops.append(loop)
    return polygons + loops


def _ends(polygons: Polygons) -> IntArray:
    """Directed edges (e, 2), polygon after polygon."""
    return np.array([(a, b) for p in polygons for a, b in zip(p, p[1:] + p[:1], strict=True)])


def catmull_clark(vertices: FloatArray, polygons: Polygons) -> tuple[FloatArray, Polygons]:
    """One step on a closed mesh; the old vertices come first, then edges, then faces."""
    count, faces = len(vertices), len(polygons)
    sizes = np.array([len(p) for p in polygons])
    directed = _ends(polygons)
    face = np.repeat(np.arange(faces), sizes)
    ends, edge = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True)
    edge = edge.ravel()
    centre = _sums(vertices[directed[:, 0]], face, faces) / sizes[:, None]
    middle = 0.5 * (vertices[ends[:, 0]] + vertices[ends[:, 1]])
    on_edge = 0.5 * (middle + 0.5 * _sums(centre[face], edge, len(ends)))
    valence = np.bincount(directed[:, 0], minlength=count)[:, None]
    around = _sums(centre[face], directed[:, 0], count) / valence
    spokes = (_sums(middle, ends[:, 0], count) + _sums(middle, ends[:, 1], count)) / valence
    moved = (around + 2 * spokes + (valence - 3) * vertices) / valence
    before = np.arange(len(directed)) - 1
    first = np.cumsum(sizes) - sizes
    before[first] = first + sizes - 1
    quads = np.column_stack([directed[:, 0], count + edge, count + len(ends) + face, count + edge[before]])
    return np.vstack([moved, on_edge, centre]), quads.tolist()


def _sums(values: FloatArray, index: IntArray, count: int) -> FloatArray:
    """Rows of values (k, 3) added up by index, (count, 3)."""
    return np.column_stack([np.bincount(index, values[:, k], minlength=count) for k in range(values.shape[1])])


def triangulated(vertices: FloatArray, polygons: Polygons) -> IntArray:
    """Quads cut along their shorter diagonal, other polygons as fans."""
    triangles = []
    for p in polygons:
        turn = len(p) == 4 and _square(vertices, p[1], p[3]) < _square(vertices, p[0], p[2])
        q = p[1:] + p[:1] if turn else p
        triangles += [(q[0], q[k], q[k + 1]) for k in range(1, len(q) - 1)]
    return np.array(triangles)


def _square(vertices: FloatArray, a: int, b: int) -> float:
    return float(((vertices[a] - vertices[b]) ** 2).sum())
