"""Long edges of boundaries in several: faces beside them become polygons with more corners. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .lines import inner_curves
from .outline import outline_edges
from .pairs import edge_keys, places_of
from .region import MeshArrays


@dataclass(frozen=True)
class Subdivided:
    """A mesh with s more vertices on its edges, which come last."""

    mesh: MeshArrays
    ends: Ints  # (s, 2) of the edge that each lies on: edge after edge, from one end to the other
    shares: Floats  # (s,) and how far it lies on the way

    @property
    def old_count(self) -> int:
        """The number of vertices that were there before."""
        return len(self.mesh.positions) - len(self.ends)

    def named(self, vertices: Ints) -> Ints:
        """Return vertices by old ones, in order: a new one by an end of its edge."""
        old = np.concatenate([np.arange(self.old_count), self.ends[:, 0]])
        found: Ints = old[vertices]
        return found

    def along(self, loop: Ints) -> Ints:
        """Return a closed loop of old vertices with the new ones on its edges."""
        between: dict[tuple[int, int], list[int]] = {}
        for k, (a, b) in enumerate(self.ends.tolist()):
            between.setdefault((a, b), []).append(self.old_count + k)
        whole: list[int] = []
        for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True):
            whole += [a, *between.get((a, b), between.get((b, a), [])[::-1])]
        return np.array(whole, dtype=np.int64)


def with_subdivided_loops(mesh: MeshArrays, places: Floats, groups: list[list[Ints]], spacing: float) -> Subdivided:
    """Part the long edges of closed loops. places: (n, 3) in the space where lengths are measured.

    spacing: as a factor of the mean edge of each group of loops, which one surface joins.
    """
    pairs, lengths = [np.empty((0, 2), dtype=np.int64)], [np.empty(0)]
    for loops in groups:
        of_group = np.concatenate([np.column_stack([loop, np.roll(loop, -1)]) for loop in loops])
        pairs.append(of_group)
        lengths.append(np.full(len(of_group), spacing * _lengths(places, of_group).mean()))
    return _subdivided(mesh, places, np.concatenate(pairs), np.concatenate(lengths))


def with_subdivided_patch(mesh: MeshArrays, places: Floats, spacing: float) -> Subdivided:
    """Part the long edges around a patch, and of curves that are held inside; spacing: as a factor of the mean edge."""
    around = mesh.edges[outline_edges(mesh)]
    pairs = np.concatenate([around, mesh.edges[inner_curves(mesh)]])
    mean = _lengths(places, around).mean() if len(around) else 0.0
    return _subdivided(mesh, places, pairs if mean > 0.0 else pairs[:0], np.full(len(pairs), spacing * mean))


def _lengths(places: Floats, pairs: Ints) -> Floats:
    found: Floats = np.linalg.norm(places[pairs[:, 0]] - places[pairs[:, 1]], axis=1)
    return found


def _subdivided(mesh: MeshArrays, places: Floats, pairs: Ints, lengths: Floats) -> Subdivided:
    found = fairing.subdivide_edges(places, mesh.triangles, pairs, lengths[: len(pairs)])
    ends, shares = found.ends.astype(np.int64), found.shares
    if not len(ends):
        return Subdivided(mesh, ends, shares)
    of_edge = _numbers(mesh, ends)
    corners = _Corners.of(mesh, ends, of_edge)
    curves = inner_curves(mesh)[of_edge]
    new = mesh.positions[ends[:, 0]] + shares[:, None] * (mesh.positions[ends[:, 1]] - mesh.positions[ends[:, 0]])

    def at_edges(values: Mask | None) -> Mask | None:
        return None if values is None else np.concatenate([values, values[of_edge]])

    def between(values: Mask | None) -> Mask | None:
        return None if values is None else np.concatenate([values, values[ends].all(axis=1)])

    by_angle = mesh.held_by_angle
    whole = replace(
        mesh,
        positions=np.concatenate([mesh.positions, new]),
        edges=_edges(mesh, ends, of_edge),
        corner_vertices=corners.vertices,
        corner_edges=corners.edges,
        corner_faces=mesh.corner_faces[corners.sources],
        corner_normals=None if mesh.corner_normals is None else mesh.corner_normals[corners.sources],
        triangles=found.triangles.astype(np.int64),
        triangle_faces=mesh.triangle_faces[found.parent],
        pinned=np.concatenate([mesh.pinned, curves]),
        held_by_angle=None if by_angle is None else np.concatenate([by_angle, curves & by_angle[ends].any(axis=1)]),
        free_slopes=between(mesh.free_slopes),
        continued=between(mesh.continued),
        tension=None if mesh.tension is None else np.append(mesh.tension, np.sqrt(mesh.tension[ends].prod(axis=1))),
        parts=None if mesh.parts is None else np.concatenate([mesh.parts, mesh.parts[ends].mean(axis=1)]),
        creases=at_edges(mesh.creases),
        smooth_curves=at_edges(mesh.smooth_curves),
        sharp=at_edges(mesh.sharp),
        hard=at_edges(mesh.hard),
        lines={name: np.concatenate([mask, mask[of_edge]]) for name, mask in mesh.lines.items()},
    )
    return Subdivided(whole, ends, shares)


def _numbers(mesh: MeshArrays, pairs: Ints) -> Ints:
    """Return the (k,) numbers of edges (k, 2)."""
    return places_of(edge_keys(pairs), edge_keys(mesh.edges))


def _edges(mesh: MeshArrays, ends: Ints, of_edge: Ints) -> Ints:
    """Return all edges: an old one ends at its first new vertex, from each of which a new one goes on."""
    new = len(mesh.positions) + np.arange(len(ends))
    last = np.append(of_edge[1:] != of_edge[:-1], True)
    first = np.append(True, last[:-1])
    edges = mesh.edges.copy()
    edges[of_edge[first]] = np.column_stack([ends[first, 0], new[first]])
    return np.concatenate([edges, np.column_stack([new, np.where(last, ends[:, 1], np.append(new[1:], 0))])])


@dataclass(frozen=True)
class _Corners:
    """All corners of faces with more corners."""

    vertices: Ints
    edges: Ints
    sources: Ints  # the old corner that each is, or comes after

    @classmethod
    def of(cls, mesh: MeshArrays, ends: Ints, of_edge: Ints) -> _Corners:
        rows: dict[int, list[int]] = {}
        for row, edge in enumerate(of_edge.tolist()):
            rows.setdefault(edge, []).append(row)
        vertices, edges = mesh.corner_vertices.tolist(), mesh.corner_edges.tolist()
        added = {}
        for corner in np.flatnonzero(np.isin(mesh.corner_edges, of_edge)).tolist():
            own = rows[edges[corner]]
            on_edge = [len(mesh.positions) + row for row in own]
            pieces = [edges[corner], *(len(mesh.edges) + row for row in own)]
            if vertices[corner] != ends[own[0], 0]:
                on_edge, pieces = on_edge[::-1], pieces[::-1]
            added[corner] = on_edge, pieces[1:]
            edges[corner] = pieces[0]
        where = [corner + 1 for corner, (on_edge, _) in added.items() for _ in on_edge]
        return cls(
            np.insert(np.array(vertices), where, [vertex for on_edge, _ in added.values() for vertex in on_edge]),
            np.insert(np.array(edges), where, [edge for _, pieces in added.values() for edge in pieces]),
            np.insert(np.arange(len(vertices)), where, [corner for corner, (on, _) in added.items() for _ in on]),
        )
