"""The faces around a patch: what normals are fitted to, and what the result is compared with."""

from __future__ import annotations

import numpy as np

from .outline import outline_edges, two_sided_edges
from .region import MeshArrays, Patch, vertices_of
from .types import Ints, Mask

RINGS = 4  # of outside faces handed to the engine's fit, which uses the nearest of them


def outside_triangles(mesh: MeshArrays, patch: Patch) -> Ints:
    """Return the (o, 3) triangles outside the patch within RINGS of its fixed vertices, in the mesh's numbers.

    Left out are those with a corner that is not finite.
    """
    outside = _usable(mesh)
    start = np.zeros(len(mesh.positions), dtype=bool)
    start[patch.vertices[patch.fixed]] = True
    return nearby(outside, start)


def wide_outside(mesh: MeshArrays, patch: Patch, feather: float = 0.0) -> Ints:
    """Return those within a patch's size of it, which say what its surroundings are without their detail.

    feather: width of a band around the patch, a share of its size; that much is added. What may go a part of the way
    counts as part of the patch.
    """
    outside = _usable(mesh)
    ends = np.union1d(patch.vertices[patch.fixed], np.flatnonzero(joined_by_weight(mesh, patch)))
    rim = mesh.positions[ends]
    low, high = rim.min(axis=0), rim.max(axis=0)
    # No island is larger than twice the diagonal, as the engine measures its size.
    around = (high - low).max() + feather * 2.0 * np.linalg.norm(high - low)
    near = ((mesh.positions >= low - around) & (mesh.positions <= high + around)).all(axis=1)
    found: Ints = outside[near[outside].all(axis=1)]
    return found


def joined_by_weight(mesh: MeshArrays, patch: Patch) -> Mask:
    """Return the (n,) mask of the vertices to which edges lead from the patch over vertices that may go some way."""
    reached = np.zeros(len(mesh.positions), dtype=bool)
    if mesh.parts is None:
        return reached
    may_go = (mesh.parts > 0.0) & ~staying(mesh)
    reached[patch.vertices] = may_go[patch.vertices]
    edges = mesh.edges[may_go[mesh.edges].all(axis=1)]
    count = -1
    while count != (count := np.count_nonzero(reached)):
        reached[edges[reached[edges].any(axis=1)]] = True
    return reached


def staying(mesh: MeshArrays) -> Mask:
    """Return the (n,) mask of what no band moves: pinned vertices and those of hidden faces."""
    return mesh.pinned if mesh.hidden is None else mesh.pinned | vertices_of(mesh, mesh.hidden)


def _usable(mesh: MeshArrays) -> Ints:
    """Return the triangles outside the selection whose corners are finite."""
    finite = np.isfinite(mesh.positions).all(axis=1)
    outside = mesh.triangles[~mesh.in_patch[mesh.triangle_faces]]
    if finite.all():
        return outside
    usable: Ints = outside[finite[outside].all(axis=1)]
    return usable


def nearby(triangles: Ints, start: Mask, rings: int = RINGS) -> Ints:
    """Return the triangles within so many steps of the vertices in `start`."""
    reached = start.copy()
    near = np.zeros(len(triangles), dtype=bool)
    for _ in range(rings):
        near = reached[triangles].any(axis=1)
        reached[triangles[near]] = True
    found: Ints = triangles[near]
    return found


def wound_alike(mesh: MeshArrays, outside: Ints) -> Ints:
    """Return the triangles (o, 3), turned round where the patch is wound against most of what surrounds it."""
    alike = two_sided_edges(mesh, outline_edges(mesh)).alike
    return outside[:, ::-1] if 2 * np.count_nonzero(alike) > len(alike) else outside


def numbered(patch: Patch, *triangles: Ints) -> tuple[Ints, ...]:
    """Return (q,) mesh vertices, the patch's first, then those of the triangles alone; and these in their numbers."""
    others = np.setdiff1d(np.concatenate(triangles), patch.vertices)
    vertices = np.concatenate([patch.vertices, others])
    number = np.zeros(int(vertices.max(initial=-1)) + 1, dtype=np.int64)
    number[vertices] = np.arange(len(vertices))
    return vertices, *(number[part] for part in triangles)
