"""Border loops that a selection stands for. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from .arrays import Ints, Mask
from .region import MeshArrays, face_sizes

NO_BORDER = "No border is selected: select edges or vertices of the holes' boundaries, as many as you like of each"


class BorderRefusal(ValueError):
    """A border that can't be filled; `elements` are vertices of the mesh."""

    def __init__(self, text: str, elements: Ints) -> None:
        super().__init__(text)
        self.elements = elements


def border_loops(mesh: MeshArrays, seeds: Mask) -> list[Ints]:
    """Return the whole border loops through the vertices of the (n,) mask, each with the hole on its left.

    In the order of their lowest vertices; empty where no seed is on a border. Raises BorderRefusal where a loop touches
    itself or another one, where faces are wound against each other along it, where it has no area, and where it follows
    the plane of a Mirror modifier, beyond which it goes on.
    """
    tails, heads = _border_edges(mesh)
    following = dict(zip(tails.tolist(), heads.tolist(), strict=True))
    fork = np.bincount(tails, minlength=len(seeds)) != np.bincount(heads, minlength=len(seeds))
    fork |= np.bincount(tails, minlength=len(seeds)) > 1
    loops: list[Ints] = []
    seen: set[int] = set()
    border = np.union1d(tails, heads)
    for seed in border[seeds[border]].tolist():
        if seed not in seen:
            loop = _loop(seed, following, fork)
            seen.update(loop.tolist())
            _check(mesh, loop)
            loops.append(loop)
    return loops


def _border_edges(mesh: MeshArrays) -> tuple[Ints, Ints]:
    """Return where the edges with one face begin and end, seen from the hole."""
    sizes = face_sizes(mesh)
    following = np.arange(len(mesh.corner_vertices)) + 1
    following[np.cumsum(sizes) - 1] = np.cumsum(sizes) - sizes
    uses = np.bincount(mesh.corner_edges, minlength=len(mesh.edges))
    border = uses[mesh.corner_edges] == 1
    return mesh.corner_vertices[following[border]], mesh.corner_vertices[border]


def _loop(seed: int, following: dict[int, int], fork: Mask) -> Ints:
    loop = [seed]
    while True:
        if fork[loop[-1]]:
            text = f"The border touches itself at vertex {loop[-1]}, or faces there are wound against each other"
            raise BorderRefusal(f"{text}: split the vertex, or recalculate the normals", np.array(loop[-1:]))
        after = following[loop[-1]]
        if after == seed:
            return np.array(loop, dtype=np.int64)
        loop.append(after)


def _check(mesh: MeshArrays, loop: Ints) -> None:
    points = mesh.positions[loop]
    broken = loop[~np.isfinite(points).all(axis=1)]
    if len(broken):
        raise BorderRefusal(f"Vertex {broken[0]} of the border has a coordinate that is NaN or infinite", broken)
    same = loop[(points == np.roll(points, -1, axis=0)).all(axis=1)]
    if len(same):
        raise BorderRefusal(f"The border has an edge without length at vertex {same[0]}: merge by distance", same)
    if len(loop) < 3:
        raise BorderRefusal("A border of two edges bounds nothing: merge by distance", loop)
    for reflection in mesh.reflections:
        there = reflection.on_plane(points)
        if (there & np.roll(there, -1)).any():
            text = "The border follows a Mirror modifier's plane, which closes it there: apply the modifier first"
            raise BorderRefusal(text, loop[there])
