"""Edges without a face that were drawn across a hole."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from fairing._arguments import listed
from fairing._cut_loops import Tree, crosses
from fairing._types import Diagnostic, IntArray, MeshError


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
