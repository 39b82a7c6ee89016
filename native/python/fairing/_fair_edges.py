"""Chains of edges become fair curves."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._edge_ends import chain_from
from fairing._matching import meeting_point
from fairing._new_mesh import read_only
from fairing._types import FloatArray, IntArray

_ONWARD = 0.5  # cosine of the turn at which an edge does not go on in another one

Links = dict[int, list[int]]


@dataclass(frozen=True, eq=False)
class FairEdges:
    """Edges as fair curves. All arrays are read-only."""

    vertices: FloatArray
    """(n, 3) all vertices; those that are not in ``moved`` keep their bits."""
    moved: IntArray
    """(k,) ascending."""
    curves: tuple[IntArray, ...]
    """The vertices of each chain that is fair now, from end to end."""


def fair_edges(
    vertices: npt.ArrayLike, edges: npt.ArrayLike, onward: npt.ArrayLike, *, reference: npt.ArrayLike | None = None
) -> FairEdges:
    """Make chains of edges fair between the edges that they continue.

    Each chain of ``edges`` (e, 2) between two ends at which edges of ``onward`` (o, 2) go on becomes the curve of least
    variation with their tangents (docs/hard_surfaces.md): a straight line between straight edges, an arc between those
    of a circle. Three chains and more that meet do so in the point nearest to the straight lines of their other ends.
    Vertices keep their shares of a chain's length in ``reference`` (n, 3), by default ``vertices``. Vertices of
    ``onward`` stay. So do chains that end anywhere else,
    and closed ones. No argument is changed.
    """
    points = _arguments.floats("vertices", vertices)
    pairs = (
        _arguments.indices_within(name, _arguments.integers(name, value, 2), len(points))
        for name, value in (("edges", edges), ("onward", onward))
    )
    inner, outer = (_links(each) for each in pairs)
    before = points if reference is None else _arguments.floats("reference", reference, len(points))
    result = points.copy()
    paths = _paths(inner, outer)
    tangents = {(path[0], path[1]): _tangent(path, outer, points) for each in paths for path in (each, each[::-1])}
    centres = _centres(paths, inner, outer, tangents, points)
    moved: set[int] = set(centres)
    for vertex, place in centres.items():
        result[vertex] = place
    curves = []
    for path in paths:
        ways = tangents[path[0], path[1]], tangents[path[-1], path[-2]]
        known = [way is not None or end in centres for way, end in zip(ways, (path[0], path[-1]), strict=True)]
        if not all(known):
            continue
        if len(path) > 2:
            result[path[1:-1]] = _curve(result[[path[0], path[-1]]], ways, before[path])
        moved |= set(path[1:-1])
        curves.append(np.array(path, dtype=np.int32))
    return FairEdges(read_only(result), np.array(sorted(moved), dtype=np.int32), tuple(curves))


def _links(edges: IntArray) -> Links:
    joined: Links = defaultdict(list)
    for a, b in np.unique(np.sort(edges, axis=1), axis=0).tolist():
        if a != b:
            joined[a].append(b)
            joined[b].append(a)
    return joined


def _paths(inner: Links, outer: Links) -> list[list[int]]:
    """The chains between nodes: ends, branchings, and where edges go on."""
    nodes = sorted(v for v in inner if len(inner[v]) != 2 or outer.get(v))
    found = []
    for node in nodes:
        for first in inner[node]:
            path = [node, first]
            while len(inner[path[-1]]) == 2 and not outer.get(path[-1]):
                path.append(next(v for v in inner[path[-1]] if v != path[-2]))
            if (path[0], path[1]) < (path[-1], path[-2]):
                found.append(path)
    return found


def _tangent(path: list[int], outer: Links, points: FloatArray) -> FloatArray | None:
    """The direction in which an edge comes to the path's beginning, unit; None where none goes on there."""
    chord = points[path[-1]] - points[path[0]]
    best, most = None, _ONWARD * float(np.linalg.norm(chord))
    for second in outer.get(path[0], ()):
        chain = chain_from(path[0], second, outer, points)
        direction = _core.chain_end(np.ascontiguousarray(points[chain]))[0].ravel()
        if direction @ chord > most:
            best, most = direction, float(direction @ chord)
    return best


def _centres(
    paths: list[list[int]],
    inner: Links,
    outer: Links,
    tangents: dict[tuple[int, int], FloatArray | None],
    points: FloatArray,
) -> dict[int, FloatArray]:
    """Where branchings go that edges from outside lead to."""
    lines: dict[int, list[tuple[FloatArray, FloatArray]]] = defaultdict(list)
    loose: set[int] = set()  # branchings from which a chain leads nowhere
    for each in paths:
        for path in (each, each[::-1]):
            way = tangents[path[0], path[1]]
            if way is not None:
                lines[path[-1]].append((points[path[0]], way))
            elif len(inner[path[0]]) < 3:
                loose.add(path[-1])
    found = {}
    for vertex, to_it in lines.items():
        if len(inner[vertex]) < 3 or outer.get(vertex) or vertex in loose:
            continue
        centre = meeting_point([place for place, _ in to_it], [way for _, way in to_it])
        if centre is not None and all(way @ (centre - place) > 0.0 for place, way in to_it):
            found[vertex] = centre
    return found


def _curve(ends: FloatArray, ways: tuple[FloatArray | None, FloatArray | None], before: FloatArray) -> FloatArray:
    """Places of the inner vertices of a chain; ways: of the edges that come to its ends; before: its (k, 3) points."""
    lengths = np.linalg.norm(np.diff(before, axis=0), axis=1).cumsum()
    begin = np.zeros(3) if ways[0] is None else ways[0]
    end = np.zeros(3) if ways[1] is None else -ways[1]
    shares = (lengths[:-1] / lengths[-1]).tolist()
    places: FloatArray = _core.fair_curve(np.ascontiguousarray(ends), np.array([begin, end]), shares)
    return places
