"""The fairing that the paper sets itself against: Δ²q = 0 with a Laplacian of fixed weights (Fig. 1).

C1 boundary data the usual way: one more row of vertices continues the mesh beyond its boundary, along the prescribed
tangent planes, and both rows are held.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.linalg import splu

import fairing
import measures
import shapes
from cases import Case
from polygon_mesh import FloatArray, IntArray


def linear_bilaplacian(case: Case, weights: str) -> FloatArray:
    """Positions (n, 3); weights "uniform", or "conformal" to the case's M0. The case must be a mesh with a border."""
    ghosts, strip = _continuation(case)
    count = len(case.vertices)
    triangles = np.vstack([case.triangles, strip])
    points = np.vstack([case.vertices, ghosts])
    matrix = _laplacian(np.vstack([case.reference, ghosts]), triangles, weights)
    scaled = (diags_array(1.0 / matrix.diagonal()) @ matrix).tocsr()
    free = case.free
    held = np.setdiff1d(np.arange(len(points)), free)
    squared = (scaled[free][:, :count] @ scaled[:count]).tocsr()
    result = case.vertices.copy()
    result[free] = splu(squared[:, free].tocsc()).solve(-(squared[:, held] @ points[held]))
    return result


def _laplacian(points: FloatArray, triangles: IntArray, weights: str) -> csr_array:
    """Unnormalised, positive diagonal, (n, n)."""
    uniform = shapes.uniform_laplacian(triangles, len(points)).tocsr()
    if weights == "uniform":
        return uniform
    rows, columns, values = fairing.cotan_laplacian(points, triangles)
    return coo_array((values, (rows, columns)), shape=uniform.shape).tocsr()


def _continuation(case: Case) -> tuple[FloatArray, IntArray]:
    """A ghost (k, 3) beyond every border vertex, numbered from n on, and the strip of triangles between."""
    edges = measures.border_edges(case.triangles)
    count = len(case.vertices)
    following, before = np.full(count, -1), np.full(count, -1)
    following[edges[:, 0]], before[edges[:, 1]] = edges[:, 1], edges[:, 0]
    rim = edges[:, 0]
    normals = np.zeros((count, 3))
    normals[case.fixed] = case.normals
    ahead = case.vertices[following[rim]] - case.vertices[rim]
    behind = case.vertices[rim] - case.vertices[before[rim]]
    outward = np.cross(ahead + behind, normals[rim])
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    spacing = 0.5 * (np.linalg.norm(ahead, axis=1) + np.linalg.norm(behind, axis=1))
    ghosts = case.vertices[rim] + 0.5 * np.sqrt(3) * spacing[:, None] * outward
    ghost_of = np.full(count, -1)
    ghost_of[rim] = count + np.arange(len(rim))
    a, b = edges.T
    strip = np.vstack([np.column_stack([b, a, ghost_of[a]]), np.column_stack([b, ghost_of[a], ghost_of[b]])])
    return ghosts, strip
