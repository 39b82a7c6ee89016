"""What takes the place of a patch that is meshed anew, and where its values come from. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

import fairing

from ..arrays.places import no_pairs, numbers_in, pair_keys, places_of
from ..arrays.region import MeshArrays, Patch
from ..arrays.types import Floats, Ints, Mask
from ..fair.engine import Problem
from .faces import inner_edges

Edge = tuple[int, int]


@dataclass(frozen=True)
class Stencil:
    """Weighted means of values (n, w)."""

    sources: Ints  # (k, s)
    weights: Floats  # (k, s), each row sums to 1

    def mean(self, values: Floats) -> Floats:
        """Return (k, w)."""
        result: Floats = np.einsum("ks,ksw->kw", self.weights, values[self.sources])
        return result

    @property
    def heaviest(self) -> Ints:
        """The (k,) sources with the largest weights, for what has no mean."""
        found: Ints = self.sources[np.arange(len(self.sources)), self.weights.argmax(axis=1)]
        return found


@dataclass(frozen=True)
class NewPart:
    """Faces between r vertices of the mesh and k new ones, in this order; all other indices are those of the mesh."""

    stay: Ints  # (r,)
    fixed_count: int  # of `stay`: those that don't move,
    held_count: int  # and those that hold the surface: on fair curves, too; the others are on lines
    triangles: Ints  # (m, 3)
    lines: Ints  # (l, 2) edges that stay, or that part two triangles that would make an old quad again
    vertices: Stencil  # of vertices: at the k new ones
    corners: Stencil  # of corners: at the 3 m new ones, triangle after triangle
    faces: Ints  # (m,) each takes its material from
    gone_faces: Ints
    gone_vertices: Ints
    pairs: Ints = field(default_factory=no_pairs)  # (q, 2) triangles that are the halves of a quad in a row
    cut: Ints = field(default_factory=no_pairs)  # (c, 2) edges that are pieces of old ones,
    cut_from: Ints = field(default_factory=no_pairs)  # (c, 2) the ends of each of these, vertices of the mesh


def new_part(mesh: MeshArrays, problem: Problem, result: fairing.RemeshResult, lines: Mask) -> NewPart:
    """Make it of the engine's answer; lines: the (e,) mask of edges that were kept.

    mesh: as it was solved, a mirrored one wound the other way round.
    """
    patch = problem.patch
    triangles, gone, rows = _replaced(patch, result)
    count = len(patch.vertices)
    held = np.unique(triangles[triangles < count])
    moving = np.isin(held, problem.curve)
    fixed = np.concatenate([held[~moving], held[moving]])
    on_line = np.flatnonzero(result.old >= 0)
    new = np.flatnonzero(result.old < 0)
    stay = np.concatenate([fixed, result.old[on_line]]).astype(np.int64)
    number = numbers_in(np.concatenate([fixed, count + on_line, count + new]), count + len(result.old))
    numbered = number[triangles]
    origin = result.origin[0][new].astype(np.int64), result.origin[1][new]
    walls = _walls(patch, lines, mesh)
    places = _corner_places(patch, numbered, stay, origin, walls)
    corner_of = corner_numbers(mesh, patch.faces, patch.vertices[patch.triangles])
    return NewPart(
        stay=patch.vertices[stay],
        fixed_count=int(np.count_nonzero(~moving)),
        held_count=len(fixed),
        triangles=numbered,
        lines=np.concatenate([_wall_edges(numbered, stay, walls), _diagonals_of_old_quads(patch, numbered, stay)]),
        vertices=Stencil(patch.vertices[patch.triangles[origin[0]]], origin[1]),
        corners=Stencil(corner_of[places[0]], places[1]),
        faces=_face_sources(patch, numbered, len(stay), places[0]),
        gone_faces=gone,
        gone_vertices=patch.vertices[np.setdiff1d(patch.free, stay)],
        pairs=_pairs_in_rows(result, rows),
    )


def _pairs_in_rows(result: fairing.RemeshResult, rows: Ints) -> Ints:
    """Return (q, 2): the quads that the result has in rows, as pairs of the triangles that are new; rows: of these."""
    if result.quads is None or any(warning.code == "NO_QUAD_ROWS" for warning in result.warnings):
        return no_pairs()
    pairs = numbers_in(rows, len(result.triangles))[result.quads.pairs]
    whole: Ints = pairs[(pairs >= 0).all(axis=1)]
    return whole


def _replaced(patch: Patch, result: fairing.RemeshResult) -> tuple[Ints, Ints, Ints]:
    """Return the triangles that are new (m, 3), the faces that go, and the rows of the result that are new."""
    stays = fairing.components(patch.triangles, fixed=patch.fixed) < 0
    kept = np.flatnonzero(stays & (not stays.all()))  # without any free vertex all of them go
    gone = np.setdiff1d(patch.faces, patch.faces[kept])
    partly = np.intersect1d(patch.faces[kept], np.delete(patch.faces, kept))
    added = len(result.triangles) - len(kept)
    again = added + np.flatnonzero(np.isin(patch.faces[kept], partly))
    rows = np.concatenate([np.arange(added), again])
    triangles = result.triangles[rows].astype(np.int64)
    gone = np.union1d(gone, partly)
    named = _in_old_numbers(patch, result)[triangles]
    whole = _faces_that_stay(patch, named, gone)
    sorted_new = [tuple(corners) for corners in np.sort(named, axis=1).tolist()]
    keep = np.array([corners not in whole for corners in sorted_new], dtype=bool)
    return triangles[keep], np.setdiff1d(gone, list(whole.values())), rows[keep]


def _in_old_numbers(patch: Patch, result: fairing.RemeshResult) -> Ints:
    """Return the patch's own number of each vertex of the result: those on lines have two. Negative for new ones."""
    again = np.where(result.old >= 0, result.old, -1 - np.arange(len(result.old)))
    numbers: Ints = np.concatenate([np.arange(len(patch.vertices)), again]).astype(np.int64)
    return numbers


def _faces_that_stay(patch: Patch, triangles: Ints, gone: Ints) -> dict[tuple[int, ...], int]:
    """Return the triangular faces that are in the new mesh, too: in corners between edges of boundary or lines."""
    faces, counts = np.unique(patch.faces, return_counts=True)
    alone = np.isin(patch.faces, np.intersect1d(faces[counts == 1], gone))
    new = {tuple(corners) for corners in np.sort(triangles, axis=1).tolist()}
    old = zip(np.sort(patch.triangles[alone], axis=1).tolist(), patch.faces[alone].tolist(), strict=True)
    return {tuple(corners): face for corners, face in old if tuple(corners) in new}


def _wall_edges(triangles: Ints, stay: Ints, walls: dict[Edge, int]) -> Ints:
    """Return the (l, 2) sides of new triangles that are walls."""
    between = [(a, b) for (a, b), _ in sides_of(triangles) if a < len(stay) and b < len(stay)]
    known = [(a, b) for a, b in between if (int(stay[a]), int(stay[b])) in walls]
    return np.array(known, dtype=np.int64).reshape(-1, 2)


def _diagonals_of_old_quads(patch: Patch, triangles: Ints, stay: Ints) -> Ints:
    """Return the (d, 2) edges between new triangles that have the corners of one old quad: a mesh has it only once."""
    order = np.argsort(patch.faces, kind="stable")
    _, starts, counts = np.unique(patch.faces[order], return_index=True, return_counts=True)
    pairs = starts[counts == 2]
    old = np.concatenate([patch.triangles[order[pairs]], patch.triangles[order[pairs + 1]]], axis=1)
    quads = {frozenset(corners) for corners in old.tolist()}
    edges, sides = inner_edges(triangles)
    corners = triangles[sides].reshape(-1, 6)
    inside = np.flatnonzero((corners < len(stay)).all(axis=1))
    again = [row for row in inside.tolist() if frozenset(stay[corners[row]].tolist()) in quads]
    return edges[again]


def sides_of(triangles: Ints, rows: Sequence[int] | None = None) -> Iterator[tuple[Edge, int]]:
    """Yield each directed side, all or those of some triangles, with 3 · its triangle + the corner where it begins."""
    chosen = np.arange(len(triangles)) if rows is None else np.array(rows)
    for t, (a, b, c) in zip(chosen.tolist(), triangles[chosen].tolist(), strict=True):
        yield (a, b), 3 * t
        yield (b, c), 3 * t + 1
        yield (c, a), 3 * t + 2


def _walls(patch: Patch, lines: Mask, mesh: MeshArrays) -> dict[Edge, int]:
    """Return the directed edges of the patch's border and of lines, each with its side of the old triangles."""
    sides = dict(sides_of(patch.triangles))
    number = numbers_in(patch.vertices, len(mesh.positions))
    kept = {(a, b) for a, b in number[mesh.edges[lines]].tolist()}
    return {(a, b): side for (a, b), side in sides.items() if (b, a) not in sides or (a, b) in kept or (b, a) in kept}


def _corner_places(
    patch: Patch, triangles: Ints, stay: Ints, origin: tuple[Ints, Floats], walls: dict[Edge, int]
) -> tuple[Ints, Floats]:
    """Return (3 m, 3) sides of old triangles, which stand for their corners, and weights, for each new corner.

    A new vertex has the corners of the triangle that it lies on. At one that stays, the first wall clockwise decides
    on the side.
    """
    corners = triangles.ravel()
    places = np.zeros((len(corners), 3), dtype=np.int64)
    weights = np.zeros((len(corners), 3))
    new = corners >= len(stay)
    of = corners[new] - len(stay)
    places[new] = 3 * origin[0][of][:, None] + np.arange(3)
    weights[new] = origin[1][of]
    weights[~new, 0] = 1.0
    anywhere = {vertex: side for (vertex, _), side in sides_of(patch.triangles)}
    sides = dict(sides_of(triangles))
    for corner in np.flatnonzero(~new).tolist():
        side = _first_wall(corner, triangles, stay, (sides, walls))
        places[corner] = anywhere[int(stay[corners[corner]])] if side is None else side
    return places, weights


def _first_wall(corner: int, triangles: Ints, stay: Ints, known: tuple[dict[Edge, int], dict[Edge, int]]) -> int | None:
    """Return the old side at the first wall clockwise from a new corner, None where there is none."""
    sides, walls = known
    at = corner
    while True:
        triangle, k = divmod(at, 3)
        vertex, other = int(triangles[triangle, k]), int(triangles[triangle, (k + 1) % 3])
        if other < len(stay):
            wall = walls.get((int(stay[vertex]), int(stay[other])))
            if wall is not None:
                return wall
        back = sides.get((other, vertex))
        if back is None:
            return None
        at = 3 * (back // 3) + (back + 1) % 3
        if at == corner:
            return None


def corner_numbers(mesh: MeshArrays, faces: Ints, triangles: Ints) -> Ints:
    """Return (3 m,): the mesh's corner at each corner of triangles (m, 3) of these faces (m,)."""
    wanted = pair_keys(faces[:, None], triangles).ravel()
    return places_of(wanted, pair_keys(mesh.corner_faces, mesh.corner_vertices))


def _face_sources(patch: Patch, triangles: Ints, stay_count: int, places: Ints) -> Ints:
    """Return (m,): the old face at a new vertex of each triangle, which is on the triangle's side of all lines."""
    first = (triangles >= stay_count).argmax(axis=1)
    sides = places.reshape(len(triangles), 3, 3)[np.arange(len(triangles)), first, 0]
    faces: Ints = patch.faces[sides // 3]
    return faces
