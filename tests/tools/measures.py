"""How far apart two surfaces are, and what a mesh is made of."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import fairing

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Surface = tuple[FloatArray, IntArray]


def observed_order(counts: tuple[int, int], errors: tuple[float, float]) -> float:
    """p in error ~ h^p from two meshes with these numbers of free vertices, h ~ count^(−1/2)."""
    return float(2 * np.log(errors[0] / errors[1]) / np.log(counts[1] / counts[0]))


def two_sided_distance(first: Surface, second: Surface, samples: int = 3) -> float:
    """Largest distance from a point of either mesh (vertices, triangles) to the other mesh.

    Points are a barycentric lattice with `samples` steps per edge in every triangle, corners
    included; distances from them to the triangles are exact.
    """
    forth = distance_to_mesh(sampled(*first, samples), *second)
    back = distance_to_mesh(sampled(*second, samples), *first)
    return float(max(forth.max(), back.max()))


def sampled(vertices: FloatArray, triangles: IntArray, steps: int) -> FloatArray:
    """Lattice points of all triangles, (m (steps + 1)(steps + 2)/2, 3)."""
    lattice = [(i, j, steps - i - j) for i in range(steps + 1) for j in range(steps + 1 - i)]
    corners = vertices[triangles]
    return np.asarray(np.einsum("lk,mkd->lmd", np.array(lattice) / steps, corners).reshape(-1, 3))


def distance_to_mesh(points: FloatArray, vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Exact distances (k,) from points (k, 3) to a triangle mesh."""
    return np.abs(fairing.deviation(points, vertices, triangles))


def directed_edges(triangles: IntArray) -> IntArray:
    """(3 m, 2) in winding order."""
    return triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def edges(triangles: IntArray) -> IntArray:
    """Every edge once, (e, 2), smaller index first."""
    return np.unique(np.sort(directed_edges(triangles), axis=1), axis=0)


def valences(triangles: IntArray, count: int) -> IntArray:
    """Edges per vertex, (count,)."""
    return np.bincount(edges(triangles).ravel(), minlength=count)


def beyond_rings(triangles: IntArray, start: IntArray, rings: int) -> NDArray[np.bool_]:
    """Mask of the vertices further than this many rings from the vertices `start`."""
    near = np.isin(np.arange(int(triangles.max()) + 1), start)
    for _ in range(rings):
        near[triangles[near[triangles].any(axis=1)].ravel()] = True
    return ~near


def border_edges(triangles: IntArray) -> IntArray:
    """Directed edges of exactly one triangle, (b, 2)."""
    directed = directed_edges(triangles)
    _, inverse, uses = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
    return np.asarray(directed[uses[inverse.ravel()] == 1])


def with_new(vertices: FloatArray, triangles: IntArray, result: Any) -> Surface:
    """The mesh with what a fill or a fillet has made."""
    kept = np.delete(np.asarray(triangles), getattr(result, "gone", []), axis=0)
    return np.concatenate([vertices, result.vertices]), np.concatenate([kept, result.triangles])


def areas(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def euler_number(triangles: IntArray) -> int:
    """χ = V − E + F of the vertices that triangles use."""
    return len(np.unique(triangles)) - len(edges(triangles)) + len(triangles)


def is_oriented_manifold(triangles: IntArray) -> bool:
    """Every directed edge once, and one fan of triangles round every vertex."""
    directed = directed_edges(triangles)
    if len(np.unique(directed, axis=0)) != len(directed):
        return False
    border = border_edges(triangles)
    return len(np.unique(border[:, 0])) == len(border) and _single_fans(triangles)


def _single_fans(triangles: IntArray) -> bool:
    """Whether the corners at each vertex are joined through shared edges: count by union."""
    corner = np.arange(3 * len(triangles))
    vertex = triangles.ravel()
    ahead = np.roll(triangles, -1, axis=1).ravel()
    behind = np.roll(triangles, 1, axis=1).ravel()
    size = int(triangles.max()) + 1
    forward, backward = vertex * size + ahead, vertex * size + behind
    order = np.argsort(forward)
    place = np.searchsorted(forward[order], backward)
    place = np.minimum(place, len(order) - 1)
    match = forward[order][place] == backward
    graph = coo_array((np.ones(match.sum()), (corner[match], order[place[match]])), shape=(len(corner),) * 2)
    return int(connected_components(graph)[0]) == len(np.unique(vertex))
