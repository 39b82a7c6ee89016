"""Wires that hang together: arcs, the nodes where these meet, and how a surface through them lies at each node."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NoReturn

import numpy as np

from fairing._arguments import listed
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError

_REACH = 0.1  # of an arc: how far on its direction at a node is read, so that one crooked edge does not decide
_LEAST_GAP = np.radians(5.0)  # between arcs around a node; nearer ones lie on each other, or on different sheets
_CLEAR = 0.5  # cosine by which a normal, carried along an arc, says on which side the other end's lies


@dataclass(frozen=True, eq=False)
class Network:
    """Arcs between nodes that hang together, with a normal at each node, all on one side of the surface."""

    arcs: tuple[IntArray, ...]
    """The vertices of each, from node to node."""
    normals: dict[int, FloatArray]
    order: dict[int, tuple[tuple[int, ...], FloatArray]]
    """The darts that leave a node, counter-clockwise, and their angles. Dart 2 k runs along arc k, 2 k + 1 back."""

    def path(self, dart: int) -> IntArray:
        return _path(self.arcs, dart)


def parts(edges: IntArray, points: FloatArray) -> tuple[list[Network], list[IntArray]]:
    """Networks, and lone loops; MeshError where wires end, or where it can't be told how they lie at a node."""
    joined: dict[int, list[int]] = defaultdict(list)
    for a, b in edges.tolist():
        joined[a].append(b)
        joined[b].append(a)
    ends = np.array(sorted(v for v, others in joined.items() if len(others) == 1), dtype=np.int32)
    if len(ends):
        refuse("WIRES_END", f"wires end at {listed(ends)}: join each end to another wire, or remove it", ends)
    arcs = _arcs(joined)
    loops = [arc[:-1] for arc in arcs if len(joined[int(arc[0])]) == 2]
    between = [arc for arc in arcs if len(joined[int(arc[0])]) > 2]
    return [_network(group, points) for group in _groups(between)], loops


def _arcs(joined: dict[int, list[int]]) -> list[IntArray]:
    found, seen = [], set()
    nodes = [v for v in sorted(joined) if len(joined[v]) > 2]
    for begin in [*nodes, *sorted(joined)]:
        for first in sorted(joined[begin]):
            if (begin, first) in seen:
                continue
            path = [begin, first]
            while len(joined[path[-1]]) == 2 and path[-1] != begin:
                a, b = joined[path[-1]]
                path.append(b if a == path[-2] else a)
            if len(joined[begin]) > 2 or path[-1] == begin:
                seen |= {(path[0], path[1]), (path[-1], path[-2])}
                seen |= {(v, w) for v in path[1:-1] for w in joined[v]}
                found.append(np.array(path, dtype=np.int32))
    return found


def _groups(arcs: list[IntArray]) -> list[list[IntArray]]:
    """Those that hang together."""
    group: dict[int, list[IntArray]] = {}
    for arc in arcs:
        a, b = (group.get(int(arc[k]), []) for k in (0, -1))
        whole = a if a is b else a + b
        whole.append(arc)
        for each in whole:
            group[int(each[0])] = group[int(each[-1])] = whole
    return list({id(each): each for each in group.values()}.values())


def _path(arcs: Sequence[IntArray], dart: int) -> IntArray:
    arc = arcs[dart // 2]
    return arc[::-1] if dart % 2 else arc


def _network(arcs: list[IntArray], points: FloatArray) -> Network:
    leaving: dict[int, list[int]] = defaultdict(list)
    for dart in range(2 * len(arcs)):
        leaving[int(_path(arcs, dart)[0])].append(dart)
    ways = np.array([_direction(points[_path(arcs, dart)]) for dart in range(2 * len(arcs))])
    normals = {node: _plane(ways[darts]) for node, darts in leaving.items()}
    normals = _on_one_side(arcs, normals, points)
    order = {}
    for node, darts in leaving.items():
        angles = _angles(ways[darts], normals[node])
        by_angle = np.argsort(angles, kind="stable")
        gaps = np.diff(np.append(angles[by_angle], angles[by_angle[0]] + 2 * np.pi))
        if gaps.min() < _LEAST_GAP:
            where = np.array([node], dtype=np.int32)
            text = f"wires leave {listed(where)} one above the other, so that their order around it can't be told: "
            refuse("UNCLEAR_CELLS", text + "part them, or remove one", where)
        order[node] = tuple(darts[k] for k in by_angle), angles[by_angle]
    return Network(tuple(arcs), normals, order)


def _direction(path: FloatArray) -> FloatArray:
    along = np.concatenate([[0.0], np.linalg.norm(np.diff(path, axis=0), axis=1).cumsum()])
    at = max(1, int(np.searchsorted(along, _REACH * along[-1], side="right")) - 1)
    way = path[at] - path[0]
    unit: FloatArray = way / np.linalg.norm(way)
    return unit


def _plane(ways: FloatArray) -> FloatArray:
    """The unit normal of the plane nearest to the tips of directions: of three through all of them."""
    normal: FloatArray = np.linalg.svd(ways - ways.mean(axis=0))[2][2]
    return normal


def _angles(ways: FloatArray, normal: FloatArray) -> FloatArray:
    flat = ways - (ways @ normal)[:, None] * normal
    x = flat[np.linalg.norm(flat, axis=1).argmax()]
    x = x / np.linalg.norm(x)
    found: FloatArray = np.arctan2(flat @ np.cross(normal, x), flat @ x)
    return found


def carried(normal: FloatArray, path: FloatArray) -> FloatArray:
    """(k − 1, 3) a normal at the path's beginning, carried along its edges without turning about them."""
    ways = np.diff(path, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    found = np.empty_like(ways)
    for k, way in enumerate(ways):
        across = normal - (normal @ way) * way
        size = float(np.linalg.norm(across))
        normal = across / size if size > 1e-9 else normal
        found[k] = normal
    return found


def _on_one_side(arcs: Sequence[IntArray], normals: dict[int, FloatArray], points: FloatArray) -> dict[int, FloatArray]:
    """The same normals, turned so that those which arcs join agree: the clearest arcs first."""
    agreement = []
    for arc in arcs:
        here = carried(normals[int(arc[0])], points[arc])[-1]
        there = carried(normals[int(arc[-1])], points[arc[::-1]])[0]
        agreement.append(float(here @ there))
    sign = dict.fromkeys(normals, 1.0)
    group = {node: [node] for node in normals}
    for k in np.argsort(-np.abs(agreement), kind="stable").tolist():
        a, b = int(arcs[k][0]), int(arcs[k][-1])
        agrees = sign[a] * sign[b] * agreement[k]
        if group[a] is group[b]:
            if agrees < -_CLEAR:
                where = np.unique(arcs[k])
                text = f"a surface along the wire at {listed(where)} comes back to its own other side: remove it"
                refuse("UNCLEAR_CELLS", text, where, "one_sided")
            continue
        for node in group[b] if agrees < 0 else ():
            sign[node] = -sign[node]
        group[a] += group[b]
        for node in group[b]:
            group[node] = group[a]
    return {node: sign[node] * normal for node, normal in normals.items()}


def refuse(code: str, text: str, where: IntArray, case: str = "") -> NoReturn:
    """MeshError at these vertices; a figure named like the case tells which one it is."""
    figures = {"vertices": float(len(where)), **({case: 1.0} if case else {})}
    raise MeshError(Diagnostic(code, text, np.asarray(where, dtype=np.int32), "vertex", figures))
