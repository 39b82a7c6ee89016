"""The numbers of a surface over a hole, and what runs across it: edges drawn there, hard edges that run on. No bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

import fairing

from ..arrays.places import no_pairs, numbers_in
from ..arrays.region import MeshArrays, nothing
from ..arrays.types import Floats, Ints, Mask
from ..words.words import joined, said


@dataclass(frozen=True)
class Loose:
    """What a mesh has of edges without a face."""

    edges: Ints  # (w, 2)
    at_faces: Mask  # (n,) the vertices of faces

    @classmethod
    def of(cls, mesh: MeshArrays) -> Loose:
        used = np.zeros(len(mesh.edges), dtype=bool)
        used[mesh.corner_edges] = True
        at_faces = np.zeros(len(mesh.positions), dtype=bool)
        at_faces[mesh.corner_vertices] = True
        return cls(mesh.edges[~used], at_faces)


def drawn_edges(loose: Loose, boundary: Ints) -> Ints:
    """Return the (w, 2) edges without a face that hang on the vertices of a boundary, directly or by others."""
    ends = loose.at_faces.copy()  # where they end: at faces, but for the boundary's own
    ends[boundary] = False
    reached = np.zeros(len(ends), dtype=bool)
    reached[boundary] = True
    while True:
        onward: Ints = loose.edges[(reached & ~ends)[loose.edges].any(axis=1)]
        if reached[onward].all():
            return onward
        reached[onward] = True


def marked_edges(mesh: MeshArrays) -> Ints:
    """Return the (m, 2) edges that are marked sharp."""
    return no_pairs() if mesh.sharp is None else mesh.edges[mesh.sharp]


def within(edges: Ints, vertices: Ints) -> Ints:
    """Return the edges (e, 2) both of whose ends are among the vertices (ascending), in their numbers."""
    chosen = edges[np.isin(edges, vertices).all(axis=1)]
    numbered: Ints = np.searchsorted(vertices, chosen).reshape(-1, 2).astype(np.int64)
    return numbered


@dataclass(frozen=True)
class Across:
    """What runs across one hole; edges in numbers of the surface's points."""

    drawn: Ints = field(default_factory=nothing)  # (d,) mesh vertices of drawn edges, the first points inside
    edges: Ints = field(default_factory=no_pairs)  # (c, 2)
    sharp: Ints = field(default_factory=no_pairs)  # (s, 2) those among them that continue marked ones
    hard: int = 0  # curves that continue hard edges
    as_drawn: int = 0  # curves that were drawn
    bands: int = 0  # bevels and rolled edges that run on, whose rows are among the edges


def reported(all_of_them: Sequence[Across]) -> str:
    """Say what surfaces follow; nothing where they follow nothing."""
    hard, drawn, bands = (sum(getattr(each, name) for each in all_of_them) for name in ("hard", "as_drawn", "bands"))
    counts = (("runs_on", hard), ("drawn", drawn), ("bevels_run_on", bands))
    return joined([said(key, n=count) for key, count in counts if count])


@dataclass(frozen=True)
class Numbering:
    """The points of a surface: those of its boundary, of edges drawn across it, and new ones."""

    boundary: Ints  # (r,) of the mesh
    drawn: Ints  # (d,) of the mesh
    of: Ints  # for each number of the engine, old vertices first

    @classmethod
    def made(cls, boundary: Ints, vertices: Ints, result: fairing.FillResult) -> Numbering:
        """vertices: (q,) of the mesh that the engine was given, ascending."""
        lying = np.unique(np.concatenate([nothing(), *result.curves]))
        drawn = np.setdiff1d(vertices[lying[lying < len(vertices)]], boundary)
        old, new = np.searchsorted(vertices, np.concatenate([boundary, drawn])), np.arange(len(result.vertices))
        of = numbers_in(np.concatenate([old, len(vertices) + new]), len(vertices) + len(new))
        return cls(boundary, drawn, of)

    def places(self, positions: Floats, new: Floats) -> Floats:
        """Return the points inside: drawn ones, whose `positions` are those of the mesh, and new ones."""
        return np.concatenate([positions[self.drawn], new])

    def across(self, result: fairing.FillResult, wires: Ints) -> Across:
        """wires: (w, 2) in the engine's numbers."""
        drawn = {tuple(pair) for pair in np.sort(wires, axis=1).tolist()}
        parts, rows = (
            [np.column_stack([curve[:-1], curve[1:]]) for curve in curves]
            for curves in (result.curves, [row for band in result.bands for row in band])
        )
        as_drawn = sum(tuple(sorted(part[0].tolist())) in drawn for part in parts)
        marked = [part for part, is_marked in zip(parts, result.marked, strict=True) if is_marked]
        whole, sharp = (self.of[np.concatenate([no_pairs(), *chosen])] for chosen in (parts + rows, marked))
        return Across(self.drawn, whole, sharp, len(parts) - as_drawn, as_drawn, len(result.bands))


def numbered_by_pass(numbered: Ints, triangles: Ints, loops: Sequence[Ints]) -> Ints:
    """Return the numbered triangles (m, 3) with the right pass of the loops at each of their corners.

    numbered: with any of the passes of a vertex; triangles: the same in the numbers of the loops, which have them on
    their left.
    """
    boundary = np.concatenate(loops)
    following = np.concatenate([np.roll(loop, -1) for loop in loops])
    result = numbered.copy()
    names, passes = np.unique(boundary, return_counts=True)
    for vertex in names[passes > 1].tolist():
        corners = np.argwhere(triangles == vertex).tolist()
        spokes = {int(triangles[t, (k + 1) % 3]): (t, k, int(triangles[t, (k + 2) % 3])) for t, k in corners}
        for place in np.flatnonzero(boundary == vertex).tolist():
            spoke = int(following[place])
            while spoke in spokes:  # counter-clockwise from the edge along which the pass leaves
                t, k, spoke = spokes.pop(spoke)
                result[t, k] = place
    return result


def renumbered(result: fairing.FillResult, old: Ints, new: Ints) -> fairing.FillResult:
    """Return a result with other numbers; old, new: the mesh vertices that numbers stand for, both ascending."""
    number = np.concatenate([np.searchsorted(new, old), len(new) + np.arange(len(result.vertices))]).astype(np.int32)
    quads = result.quads
    if quads is not None:
        quads = replace(quads, quads=number[quads.quads], triangles=number[quads.triangles])
    return replace(
        result,
        triangles=number[result.triangles],
        fixed=number[result.fixed],
        loops=tuple(number[loop] for loop in result.loops),
        curves=tuple(number[curve] for curve in result.curves),
        bands=tuple(tuple(number[row] for row in band) for band in result.bands),
        warnings=tuple(_warning(each, number) for each in result.warnings),
        quads=quads,
    )


def _warning(warning: fairing.Diagnostic, number: Ints) -> fairing.Diagnostic:
    if warning.kind != "vertex":
        return warning
    known = warning.elements[warning.elements < len(number)]  # not those of a mesh that was made meanwhile
    return replace(warning, elements=number[known].astype(np.int32))
