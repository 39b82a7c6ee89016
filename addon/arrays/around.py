"""The faces around a patch, which normals are fitted to and results compared with; keys that bend these."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .boundary import boundary_edges, two_sided_edges
from .places import numbers_in
from .region import MeshArrays, Patch, vertices_of
from .types import Floats, Ints, Mask

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

    feather: width of a band around the patch, a share of its size; that much is added. What may follow in part
    counts as part of the patch.
    """
    outside = _usable(mesh)
    ends = np.union1d(patch.vertices[patch.fixed], np.flatnonzero(joined_by_weight(mesh, patch)))
    if not len(ends):  # a closed piece: nothing holds it, as its solve says
        return outside[:0]
    rim = mesh.positions[ends]
    low, high = rim.min(axis=0), rim.max(axis=0)
    # No island is larger than twice the diagonal, as the engine measures its size.
    around = (high - low).max() + feather * 2.0 * np.linalg.norm(high - low)
    near = ((mesh.positions >= low - around) & (mesh.positions <= high + around)).all(axis=1)
    found: Ints = outside[near[outside].all(axis=1)]
    return found


def joined_by_weight(mesh: MeshArrays, patch: Patch) -> Mask:
    """Return the (n,) mask of the vertices to which edges lead from the patch over vertices that may move in part."""
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
    alike = two_sided_edges(mesh, boundary_edges(mesh)).alike
    return outside[:, ::-1] if 2 * np.count_nonzero(alike) > len(alike) else outside


def numbered(patch: Patch, *triangles: Ints) -> tuple[Ints, ...]:
    """Return (q,) mesh vertices, the patch's first, then those of the triangles alone; and these in their numbers."""
    others = np.setdiff1d(np.concatenate(triangles), patch.vertices)
    vertices = np.concatenate([patch.vertices, others])
    number = numbers_in(vertices, int(vertices.max(initial=-1)) + 1)
    return vertices, *(number[part] for part in triangles)


class Neighbourhood:
    """The triangles (t, 3) of a mesh whose corners are all finite, by the vertices that they have."""

    def __init__(self, positions: Floats, triangles: Ints) -> None:
        finite = np.isfinite(positions).all(axis=1)
        self._triangles = triangles if finite.all() else triangles[finite[triangles].all(axis=1)]
        corners = self._triangles.ravel()
        self._order = np.argsort(corners, kind="stable")
        counts = np.bincount(corners, minlength=len(positions))
        self._ends = np.cumsum(counts)
        self._begins = self._ends - counts

    def around(self, vertices: Ints, rings: int = RINGS) -> Ints:
        """Return the (o, 3) triangles within so many steps of the vertices, in the order of the mesh."""
        rows = self._at(vertices)
        for _ in range(rings - 1):
            rows = self._at(np.unique(self._triangles[rows]))
        found: Ints = self._triangles[rows]
        return found

    def _at(self, vertices: Ints) -> Ints:
        """Return the numbers of the triangles with one of these vertices, ascending."""
        begins, counts = self._begins[vertices], (self._ends - self._begins)[vertices]
        shifts = np.repeat(begins - np.cumsum(counts) + counts, counts)
        rows: Ints = np.unique(self._order[shifts + np.arange(len(shifts))] // 3)
        return rows


SAME = 1e-6  # of the selection's size: offsets that differ by less are those of a key that only moves it


@dataclass(frozen=True)
class MovedKey:
    """New positions for vertices (k,) of one shape key, in the mesh's own coordinates."""

    name: str
    vertices: Ints
    positions: Floats  # (k, 3)


def is_bent(mesh: MeshArrays, positions: Floats) -> bool:
    """Return whether a key with positions (n, 3) bends the patch or the faces around it, rather than move them."""
    inside = vertices_of(mesh, mesh.in_patch)
    touched = np.unique(np.concatenate([np.flatnonzero(inside), nearby(mesh.triangles, inside).ravel()]))
    offsets = positions[touched] - mesh.positions[touched]
    return bool(np.ptp(offsets, axis=0).max() > SAME * np.ptp(mesh.positions[inside], axis=0).max())
