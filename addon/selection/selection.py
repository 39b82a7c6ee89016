"""Selections as people make them: loops of edges, faces left out, boundaries on a fold, tunnels. No bpy."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import fairing

from ..arrays.around import numbered, outside_triangles, wound_alike
from ..arrays.boundary import edges_of, two_sided_edges
from ..arrays.region import MeshArrays, Patch, make_patch, nothing
from ..arrays.types import Floats, Ints, Mask
from ..fair.engine import Problem
from ..words.words import said

LEFT_OUT = 4  # faces at most of a hole in a selection that is taken for an oversight
ROUNDS = 5  # of growing


def visible(mesh: MeshArrays) -> Mask:
    """Return the (f,) mask of the faces that are not hidden."""
    shown: Mask = np.ones(len(mesh.in_patch), dtype=bool) if mesh.hidden is None else ~mesh.hidden
    return shown


def pieces(mesh: MeshArrays, faces: Mask, walls: Mask | None = None) -> Ints:
    """Return (f,): the lowest face of the piece that each face of the mask belongs to; -1 for the others.

    Pieces hang together across edges, those in the (e,) mask `walls` aside.
    """
    crossed = edges_of(mesh, faces) if walls is None else edges_of(mesh, faces) & ~walls
    pairs = two_sided_edges(mesh, crossed).faces
    first, second = pairs[faces[pairs].all(axis=1)].T
    label = np.arange(len(faces))
    while True:
        low = np.minimum(label[first], label[second])
        joined = label.copy()
        np.minimum.at(joined, label[first], low)
        np.minimum.at(joined, label[second], low)
        while (joined[joined] != joined).any():
            joined = joined[joined]
        if np.array_equal(joined, label):
            return np.where(faces, label, -1)
        label = joined


def enclosed_faces(mesh: MeshArrays, walls: Mask) -> Mask:
    """Return the (f,) mask of the visible faces that selected edges, the (e,) mask `walls`, enclose.

    Between several loops the faces that touch all of them; else everything but the largest piece of each connected
    part of the mesh. The largest one lies between the loops, too, if all others end at the mesh's border, as the ends
    of a tube do, and it does not. Nothing where no piece is cut off.
    """
    shown = visible(mesh)
    whole, cut = pieces(mesh, shown), pieces(mesh, shown, walls)
    open_pieces = np.unique(cut[shown & _open_faces(mesh)])
    sides = two_sided_edges(mesh, walls)
    parting = sides.faces[shown[sides.faces].all(axis=1)]
    parting = parting[cut[parting[:, 0]] != cut[parting[:, 1]]]
    chosen = np.zeros(len(shown), dtype=bool)
    for part in np.unique(whole[parting]):
        chosen |= np.isin(cut, _inside(cut, cut[parting[whole[parting[:, 0]] == part]], open_pieces))
    return chosen


def _inside(cut: Ints, sides: Ints, open_pieces: Ints) -> Ints:
    """Choose among the pieces of one connected part; sides (k, 2): those on both sides of each parting edge."""
    touching = np.unique(sides)
    order = touching[np.argsort([np.count_nonzero(cut == piece) for piece in touching], kind="stable")]
    is_open = np.isin(order, open_pieces)
    is_middle = len(order) > 2 and is_open[:-1].all() and not is_open[-1]
    between = [piece for piece in (order if is_middle else order[:-1]) if (sides == piece).any(axis=1).all()]
    return np.array(between[:1]) if between else order[:-1]


@dataclass(frozen=True)
class LeftOut:
    """Faces that a selection has left out within it."""

    count: int = 0
    vertices: Ints = field(default_factory=nothing)  # their corners


def left_out(mesh: MeshArrays) -> LeftOut:
    """Return what left_out_faces finds."""
    faces = left_out_faces(mesh)
    return LeftOut(int(np.count_nonzero(faces)), np.unique(mesh.corner_vertices[faces[mesh.corner_faces]]))


def left_out_faces(mesh: MeshArrays) -> Mask:
    """Return the (f,) mask of small holes in the selection: visible faces with selected ones all around."""
    rest = _next_to_patch(mesh, LEFT_OUT + 1)
    label = pieces(mesh, rest)
    sizes = np.bincount(label[rest], minlength=len(rest))
    is_open = np.zeros(len(rest), dtype=bool)
    is_open[label[rest & _open_faces(mesh)]] = True
    small: Mask = rest & (sizes[label] <= LEFT_OUT) & ~is_open[label]
    return small


def _next_to_patch(mesh: MeshArrays, steps: int) -> Mask:
    """Return the (f,) mask of the visible faces beyond the patch that some steps across edges reach.

    A piece of fewer faces than steps is whole there, and a larger one has as many as steps at least.
    """
    rest = visible(mesh) & ~mesh.in_patch
    reached = mesh.in_patch.copy()
    for _ in range(steps):
        reached[mesh.corner_faces[edges_of(mesh, reached)[mesh.corner_edges]]] = True
        reached &= rest | mesh.in_patch
    found: Mask = reached & rest
    return found


def _open_faces(mesh: MeshArrays) -> Mask:
    """Return the (f,) mask of the faces at the border of the mesh or next to hidden ones."""
    uses = np.bincount(mesh.corner_edges, minlength=len(mesh.edges))
    found = np.zeros(len(mesh.in_patch), dtype=bool)
    found[mesh.corner_faces[uses[mesh.corner_edges] == 1]] = True
    found[mesh.corner_faces[_beside_hidden(mesh)[mesh.corner_edges]]] = True
    return found


def _beside_hidden(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of the edges of hidden faces."""
    return edges_of(mesh, ~visible(mesh))


def problem_of(mesh: MeshArrays, matrix: Floats) -> Problem:
    """Return the patch and what is around it in world space, without normals: enough to look at the boundary."""
    with np.errstate(invalid="ignore", over="ignore"):
        world = mesh.transformed(matrix)
        patch = make_patch(world)
        vertices, outside = numbered(patch, wound_alike(world, outside_triangles(world, patch)))
    return Problem(patch, world.positions[vertices], np.empty((0, 3)), vertices, outside)


def tunnel_hint(patch: Patch) -> tuple[str, ...]:
    """Return a sentence on the tunnels of the patch, which may be why its surface is no good; none without them."""
    pieces = fairing.components(patch.triangles, fixed=patch.fixed)
    count = sum(tunnels(patch.triangles[pieces == piece]) for piece in range(int(pieces.max(initial=-1)) + 1))
    return (said("tunnels", n=count),) if count else ()


def tunnels(triangles: Ints) -> int:
    """Count the tunnels of connected triangles (m, 3): the genus, by Euler's formula.

    Where their border touches itself in a vertex, it counts as cut there.
    """
    edges, _ = fairing.edges_with_uses(triangles)
    loops = fairing.boundary_loops(triangles)
    on_border = sum(len(loop) for loop in loops)
    inner = len(np.setdiff1d(triangles, np.concatenate([np.empty(0, dtype=np.int64), *loops])))
    return (2 - len(loops) - (inner + on_border - len(edges) + len(triangles))) // 2
