"""Loops that are cut along curves, and curves that were drawn as wires."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from fairing.options.arguments import listed
from fairing.results import Diagnostic, FloatArray, IntArray, MeshError


@dataclass(frozen=True, eq=False)
class Tree:
    """Curves that hang together: one between two places of a loop, or more that meet inside."""

    leaves: tuple[int, ...]
    """Places in the loop, ascending."""
    paths: tuple[IntArray, ...]
    """The vertices from each leaf to the next one, and from the last to the first, both ends included."""


@dataclass(frozen=True, eq=False)
class CutOutline:
    """Loops without curves across them, the new surface on their left."""

    loops: tuple[IntArray, ...]
    normals: tuple[FloatArray, ...]
    """For each loop (k, 3): one side's, at curves a mean between their ends'."""


Places = Callable[[IntArray], FloatArray]


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


def cut(loop: IntArray, normals: FloatArray, sides: FloatArray, trees: Sequence[Tree], places_of: Places) -> CutOutline:
    """The loops that trees leave of one; none of them cross.

    normals: (k, 3) at its vertices; sides: (k, 3) of the triangle outside at the edge to the next one; places_of gives
    (k, 3) for vertices.
    """
    pieces = [_Piece(loop, normals, np.arange(len(loop)))]
    for tree in trees:
        whole = next(piece for piece in pieces if set(tree.leaves) <= set(piece.places.tolist()))
        pieces.remove(whole)
        pieces += _parted(whole, tree, sides, places_of)
    return CutOutline(tuple(piece.loop for piece in pieces), tuple(piece.normals for piece in pieces))


@dataclass(frozen=True, eq=False)
class _Piece:
    loop: IntArray
    normals: FloatArray
    places: IntArray
    """In the loop that was there first; −1 on curves."""

    def between(self, first: int, last: int) -> _Piece:
        """From one place to another, both included."""
        begin, end = (int(np.flatnonzero(self.places == place)[0]) for place in (first, last))
        there = (begin + np.arange((end - begin) % len(self.loop) + 1)) % len(self.loop)
        return _Piece(self.loop[there], self.normals[there].copy(), self.places[there])


def _parted(whole: _Piece, tree: Tree, sides: FloatArray, places_of: Places) -> list[_Piece]:
    order = sorted(tree.leaves, key=lambda leaf: int(np.flatnonzero(whole.places == leaf)[0]))
    turn = tree.leaves.index(order[0])
    paths = tree.paths[turn:] + tree.paths[:turn]
    result = []
    for leaf, after, path in zip(order, order[1:] + order[:1], paths, strict=True):
        part = whole.between(leaf, after)
        part.normals[0], part.normals[-1] = sides[leaf], sides[after - 1]
        back = path[::-1]
        along = _along(places_of(back), part.normals[-1], part.normals[0])[1:-1]
        result.append(
            replace(
                part,
                loop=np.concatenate([part.loop, back[1:-1]]),
                normals=np.concatenate([part.normals, along]),
                places=np.concatenate([part.places, np.full(len(back) - 2, -1)]),
            )
        )
    return result


def _along(points: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
    """Unit normals (k, 3) of a polyline, from those at its ends."""
    lengths = np.concatenate([[0.0], np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()])
    share = (lengths / max(lengths[-1], 1e-300))[:, None]
    normals = (1.0 - share) * first + share * last
    tangents = np.gradient(points, axis=0) if len(points) > 1 else np.zeros_like(points)
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1), 1e-300)[:, None]
    normals -= (normals * tangents).sum(axis=1)[:, None] * tangents
    sizes = np.linalg.norm(normals, axis=1)[:, None]
    unit: FloatArray = np.where(sizes > 1e-6, normals / np.maximum(sizes, 1e-300), first)
    return unit


def outside_normals(loop: IntArray, vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """(k, 3) unit normals of the triangles at each edge to the next vertex; zero where there is none."""
    edges = zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)
    places = {frozenset(ends): at for at, ends in enumerate(edges)}
    result = np.zeros((len(loop), 3))
    for row in triangles[np.isin(triangles, loop).sum(axis=1) > 1].tolist():
        for at in {places.get(frozenset(pair)) for pair in combinations(row, 2)} - {None}:
            p, q, r = vertices[row]
            normal = np.cross(q - p, r - p)
            result[at] = normal / max(float(np.linalg.norm(normal)), 1e-300)
    return result


@dataclass(frozen=True)
class Drawn:
    """Wires across one loop."""

    trees: tuple[Tree, ...] = ()
    curves: tuple[IntArray, ...] = ()
    reached: frozenset[int] = frozenset()
    """Vertices of the loop where wires end."""

    @property
    def vertices(self) -> IntArray:
        """All of theirs, ascending."""
        found: IntArray = np.unique(np.concatenate([np.empty(0, np.int32), *self.curves])).astype(np.int32)
        return found


def drawn(loop: IntArray, wires: IntArray) -> Drawn:
    """Wires (w, 2) that join vertices of the loop, or that meet between them.

    MeshError: NONMANIFOLD_EDGE where wires cross, or enclose a place of their own. Loose ends are left alone.
    """
    places = {vertex: at for at, vertex in enumerate(loop.tolist())}
    joined: dict[int, set[int]] = defaultdict(set)
    for a, b in wires.tolist():
        if not _is_edge_of(places, a, b, len(loop)):
            joined[a].add(b)
            joined[b].add(a)
    trees, curves = [], []
    for links in _components(places, joined):
        leaves = sorted(places[v] for v in links if v in places)
        if len(leaves) < 2:
            continue
        _refuse_rings(links)
        ends = [int(loop[leaf]) for leaf in leaves]
        paths = [_path(a, b, links) for a, b in zip(ends, ends[1:] + ends[:1], strict=True)]
        trees.append(Tree(tuple(leaves), tuple(np.array(path, dtype=np.int32) for path in paths)))
        curves += _branches(links, places)
    wrong = crosses(trees)
    if wrong:
        where = np.unique(np.concatenate([path for k in wrong for path in trees[k].paths]))
        raise refusal("cross each other", where, "give them a common vertex")
    reached = frozenset(int(loop[leaf]) for tree in trees for leaf in tree.leaves)
    return Drawn(tuple(trees), tuple(curves), reached)


def _is_edge_of(places: dict[int, int], a: int, b: int, count: int) -> bool:
    return a in places and b in places and (places[a] - places[b]) % count in (1, count - 1)


Links = dict[int, set[int]]


def _components(places: dict[int, int], joined: Links) -> list[Links]:
    """Wires that hang together inside the loop, without loose ends; a vertex of the loop parts them."""
    seen: set[tuple[int, int]] = set()
    found = []
    for begin in sorted(v for v in joined if v in places):
        for first in sorted(joined[begin]):
            links: Links = defaultdict(set)
            stack = [(begin, first)]
            while stack:
                a, b = stack.pop()
                if (a, b) in seen:
                    continue
                seen |= {(a, b), (b, a)}
                links[a].add(b)
                links[b].add(a)
                if b not in places:
                    stack += [(b, c) for c in joined[b]]
            if links:
                found.append(_without_loose_ends(links, places))
    return found


def _without_loose_ends(links: Links, places: dict[int, int]) -> Links:
    while loose := [v for v in links if len(links[v]) < 2 and v not in places]:
        for v in loose:
            for other in links.pop(v):
                links[other].discard(v)
    return {v: others for v, others in links.items() if others}


def _refuse_rings(links: Links) -> None:
    if sum(map(len, links.values())) // 2 >= len(links):
        where = np.array(sorted(links), dtype=np.int32)
        raise refusal("enclose a place of their own", where, "remove one")


def _path(begin: int, end: int, links: Links) -> list[int]:
    """The way from leaf to leaf in a tree."""
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


def _branches(links: Links, places: dict[int, int]) -> list[IntArray]:
    """The tree in curves between leaves and branchings."""
    nodes = {v for v in links if v in places or len(links[v]) != 2}
    found = []
    for node in sorted(nodes):
        for first in sorted(links[node]):
            path = [node, first]
            while path[-1] not in nodes:
                path.append(next(v for v in links[path[-1]] if v != path[-2]))
            if path[0] < path[-1]:
                found.append(np.array(path, dtype=np.int32))
    return found


def refusal(what: str, where: IntArray, advice: str) -> MeshError:
    """Why drawn edges can't be used, with their vertices."""
    text = f"edges drawn across a hole {what}, at {listed(where)}: {advice}"
    figures = {"wires": float(len(where))}
    return MeshError(Diagnostic("NONMANIFOLD_EDGE", text, where.astype(np.int32), "vertex", figures))
