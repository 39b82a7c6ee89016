"""Loops that are cut along curves, and curves that were drawn as wires."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fairing.filling.ends import Links, links_of, paths_between, sides_of
from fairing.options.arguments import listed, places_of
from fairing.results import Diagnostic, FloatArray, IntArray, MeshError


@dataclass(frozen=True, eq=False)
class Tree:
    """Curves that hang together: one between two places of a loop, or more that meet inside."""

    leaves: tuple[int, ...]
    """Places in the loop, ascending."""
    paths: tuple[IntArray, ...]
    """The vertices from each leaf to the next one, and from the last to the first, both ends included."""


Places = Callable[[IntArray], FloatArray]
Piece = tuple[IntArray, FloatArray, IntArray]
"""Vertices of a loop, normals (k, 3), and places in the loop that was there first, −1 on curves."""


def gap(tree: Tree, place: int) -> int:
    """Between which two leaves a place of the loop lies."""
    return int(np.searchsorted(tree.leaves, place)) % len(tree.leaves)


def crosses(trees: Sequence[Tree]) -> set[int]:
    """Which trees cross another one: their leaves follow each other by turns."""
    found = set()
    for i, one in enumerate(trees):
        for j, other in enumerate(trees[:i]):
            gaps = {gap(one, leaf) for leaf in other.leaves if leaf not in one.leaves}
            if len(gaps) > 1:
                found |= {i, j}
    return found


def cut(
    loop: IntArray, normals: FloatArray, sides: FloatArray, trees: Sequence[Tree], places: Places
) -> tuple[list[IntArray], list[FloatArray]]:
    """The loops that trees leave of one, the new surface on their left, and their normals; none of the trees cross.

    normals: (k, 3) at its vertices; sides: (k, 3) of the triangle outside at the edge to the next one; places gives
    (k, 3) for vertices. Each loop has one side's normals, at curves a mean between their ends'.
    """
    pieces = [(loop, normals, np.arange(len(loop), dtype=np.int32))]
    for tree in trees:
        k = next(k for k, piece in enumerate(pieces) if np.isin(tree.leaves, piece[2]).all())
        pieces += _parted(pieces.pop(k), tree, sides, places)
    return [piece[0] for piece in pieces], [piece[1] for piece in pieces]


def _parted(whole: Piece, tree: Tree, sides: FloatArray, places: Places) -> list[Piece]:
    at = [int(np.flatnonzero(whole[2] == leaf)[0]) for leaf in tree.leaves]
    count, result = len(tree.leaves), []
    for k in (int(np.argmin(at)) + np.arange(count)) % count:
        leaf, after, back = tree.leaves[k], tree.leaves[(k + 1) % count], tree.paths[k][::-1]
        there = (at[k] + np.arange((at[(k + 1) % count] - at[k]) % len(whole[0]) + 1)) % len(whole[0])
        own = whole[1][there].copy()
        own[0], own[-1] = sides[leaf], sides[after - 1]
        along = _along(places(back), own[-1], own[0])[1:-1]
        new = np.full(len(back) - 2, -1, np.int32)
        parts = zip((whole[0][there], own, whole[2][there]), (back[1:-1], along, new), strict=True)
        loop, normals, old = (np.concatenate(part) for part in parts)
        result.append((loop, normals, old))
    return result


def _along(points: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
    """Unit normals (k, 3) of a polyline, from those at its ends."""
    lengths = np.concatenate([[0.0], np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()])
    share = (lengths / max(lengths[-1], 1e-300))[:, None]
    normals = (1.0 - share) * first + share * last
    tangents = np.gradient(points, axis=0)
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1), 1e-300)[:, None]
    normals -= (normals * tangents).sum(axis=1)[:, None] * tangents
    sizes = np.linalg.norm(normals, axis=1)[:, None]
    return np.where(sizes > 1e-6, normals / np.maximum(sizes, 1e-300), first)


def outside_normals(loop: IntArray, vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """(k, 3) unit normals of the triangles at each edge to the next vertex; zero where there is none."""
    near = triangles[np.isin(triangles, loop).sum(axis=1) > 1]
    a, b, c = vertices[near].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    result = np.zeros((len(loop), 3))
    for k in range(3):
        at = places_of(near[:, [k, (k + 1) % 3]], sides_of(loop))
        result[at[at >= 0]] = normals[at >= 0]
    return result


@dataclass(frozen=True)
class Drawn:
    """Wires across one loop."""

    trees: tuple[Tree, ...] = ()
    curves: tuple[IntArray, ...] = ()
    reached: frozenset[int] = frozenset()
    """Vertices of the loop where wires end."""


def drawn(loop: IntArray, wires: IntArray) -> Drawn:
    """Wires (w, 2) that join vertices of the loop, or that meet between them.

    MeshError: NONMANIFOLD_EDGE where wires cross, or enclose a place of their own. Loose ends are left alone.
    """
    places = {vertex: at for at, vertex in enumerate(loop.tolist())}
    trees, curves = [], []
    for links in _components(places, links_of(wires[places_of(wires, sides_of(loop)) < 0])):
        leaves = sorted(places[v] for v in links if v in places)
        if len(leaves) < 2:
            continue
        if sum(map(len, links.values())) // 2 >= len(links):
            raise refusal("form a ring", np.array(sorted(links)), "remove one")
        ends = [int(loop[leaf]) for leaf in leaves]
        paths = [_path(a, b, links) for a, b in zip(ends, ends[1:] + ends[:1], strict=True)]
        trees.append(Tree(tuple(leaves), tuple(np.array(path, dtype=np.int32) for path in paths)))
        nodes = {v for v in links if v in places or len(links[v]) != 2}
        curves += [np.array(path, dtype=np.int32) for path in paths_between(nodes, links)]
    wrong = crosses(trees)
    if wrong:
        where = np.unique(np.concatenate([path for k in wrong for path in trees[k].paths]))
        raise refusal("cross each other", where, "give them a common vertex")
    reached = frozenset(int(loop[leaf]) for tree in trees for leaf in tree.leaves)
    return Drawn(tuple(trees), tuple(curves), reached)


def _components(places: dict[int, int], joined: Links) -> list[Links]:
    """Wires that hang together inside the loop, without loose ends; a vertex of the loop parts them."""
    seen: set[tuple[int, int]] = set()
    found = []
    for begin in sorted(v for v in joined if v in places):
        for first in joined[begin]:
            stack, edges = [(begin, first)], []
            while stack:
                a, b = stack.pop()
                if (a, b) in seen:
                    continue
                seen |= {(a, b), (b, a)}
                edges.append((a, b))
                if b not in places:
                    stack += [(b, c) for c in joined[b]]
            if edges:
                found.append(_without_loose_ends(links_of(np.array(edges)), places))
    return found


def _without_loose_ends(links: Links, places: dict[int, int]) -> Links:
    while loose := [v for v in links if len(links[v]) < 2 and v not in places]:
        for v in loose:
            for other in links.pop(v):
                links[other].remove(v)
    return {v: others for v, others in links.items() if others}


def _path(begin: int, end: int, links: Links) -> list[int]:
    """From leaf to leaf in a tree."""
    before = {begin: begin}
    stack = [begin]
    while stack:
        here = stack.pop()
        for v in links[here]:
            if v not in before:
                before[v] = here
                stack.append(v)
    path = [end]
    while path[-1] != begin:
        path.append(before[path[-1]])
    return path[::-1]


def refusal(what: str, where: IntArray, advice: str) -> MeshError:
    """Why drawn edges can't be used, with their vertices."""
    text = f"edges drawn across a hole {what}, at {listed(where)}: {advice}"
    figures = {"wires": float(len(where))}
    return MeshError(Diagnostic("NONMANIFOLD_EDGE", text, where.astype(np.int32), "vertex", figures))
