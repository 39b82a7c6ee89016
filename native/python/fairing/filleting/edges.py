"""Hard edges that run on through a patch, and hard edges that are made fair."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filling.ends import Links, chain_end, chain_from, ends_at, links_of, matched, meeting_point, paths_between
from fairing.measure import boundary_loops, edges_with_uses, hard_edges
from fairing.options import arguments
from fairing.results import EdgesThrough, FairEdges, FloatArray, IntArray, read_only


def edges_through(
    vertices: npt.ArrayLike,
    inside: npt.ArrayLike,
    outside: npt.ArrayLike,
    *,
    neighbours: npt.ArrayLike | None = None,
    marked: npt.ArrayLike | None = None,
) -> EdgesThrough:
    """Find the edges of a patch along which hard edges (:func:`fairing.hard_edges`) of its surroundings run on.

    Hard edges outside that end at the boundary are matched as :func:`fairing.fill` does at a hole, and joined by the
    path over edges of the patch that is hard as far as can be. Where three quarters of it are hard, or more, the patch
    has that edge, maybe dented; elsewhere it has none.

    vertices: (n, 3); inside, outside: (m, 3) and (o, 3) triangles of the patch and around it; neighbours: (e, 2) those
    edges of the patch's triangles that count, of quads and polygons, by default all; marked: (k, 2) edges that are hard
    whatever they bend.
    """
    points = arguments.floats("vertices", vertices)
    own, around = (arguments.triangles_within(triangles, len(points)) for triangles in (inside, outside))
    marks = arguments.integers("marked", [] if marked is None else marked, 2)
    edges, uses = edges_with_uses(own)
    found, inner = arguments.NO_EDGES, edges[uses == 2]
    hard = hard_edges(points, np.concatenate([own, around]), marked=marks)
    is_inner = arguments.places_of(hard, inner) >= 0
    onward = hard[~is_inner]
    joined = _joined(points, around, boundary_loops(own), onward, marks) if len(onward) else []
    if joined:
        counted = inner
        if neighbours is not None:
            named = arguments.vertices_of("neighbours", neighbours, len(points), 2)
            counted = inner[arguments.places_of(inner, named) >= 0]
        found = _core.hard_ways(points, counted, hard[is_inner], joined)
    return EdgesThrough(read_only(found), read_only(onward))


def _joined(
    points: FloatArray, around: IntArray, loops: Sequence[IntArray], hard: IntArray, marks: IntArray
) -> list[list[int]]:
    """The vertices of the loops at which hard edges end that belong together."""
    joined = []
    for loop in loops:
        ends, _ = ends_at(loop, points, around, hard, marks)
        joined += [[ends[k].vertex for k in joint.ends] for joint in matched(ends)[0]]
    return joined


_ONWARD = 0.5  # cosine of the turn at which an edge does not go on in another one


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
    points = arguments.floats("vertices", vertices)
    pairs = (
        arguments.vertices_of(name, value, len(points), 2) for name, value in (("edges", edges), ("onward", onward))
    )
    inner, outer = (links_of(each) for each in pairs)
    before = points if reference is None else arguments.floats("reference", reference, len(points))
    result = points.copy()
    paths = paths_between({v for v in inner if len(inner[v]) != 2 or outer.get(v)}, inner)
    tangents = {(path[0], path[1]): _tangent(path, outer, points) for each in paths for path in (each, each[::-1])}
    centres = _centres(paths, inner, outer, tangents, points)
    moved: set[int] = set(centres)
    for vertex, place in centres.items():
        result[vertex] = place
    curves = []
    for path in paths:
        own = tangents[path[0], path[1]], tangents[path[-1], path[-2]]
        if any(each is None and end not in centres for each, end in zip(own, (path[0], path[-1]), strict=True)):
            continue
        if len(path) > 2:
            result[path[1:-1]] = _curve(result[[path[0], path[-1]]], own, before[path])
        moved |= set(path[1:-1])
        curves.append(np.array(path, dtype=np.int32))
    return FairEdges(read_only(result), np.array(sorted(moved), dtype=np.int32), tuple(curves))


def _tangent(path: list[int], outer: Links, points: FloatArray) -> FloatArray | None:
    """The direction in which an edge comes to the path's beginning, unit; None where none goes on there."""
    chord = points[path[-1]] - points[path[0]]
    best, most = None, _ONWARD * float(np.linalg.norm(chord))
    for second in outer.get(path[0], ()):
        direction, _ = chain_end(chain_from(path[0], second, outer, points), points)
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
            tangent = tangents[path[0], path[1]]
            if tangent is not None:
                lines[path[-1]].append((points[path[0]], tangent))
            elif len(inner[path[0]]) < 3:
                loose.add(path[-1])
    found = {}
    for vertex, to_it in lines.items():
        if len(inner[vertex]) < 3 or outer.get(vertex) or vertex in loose:
            continue
        centre = meeting_point([place for place, _ in to_it], [tangent for _, tangent in to_it])
        if centre is not None and all(tangent @ (centre - place) > 0.0 for place, tangent in to_it):
            found[vertex] = centre
    return found


def _curve(ends: FloatArray, tangents: tuple[FloatArray | None, FloatArray | None], before: FloatArray) -> FloatArray:
    """Places of the inner vertices of a chain; tangents: of the edges that come to its ends; before: (k, 3) points."""
    lengths = np.linalg.norm(np.diff(before, axis=0), axis=1).cumsum()
    begin, end = (np.zeros(3) if each is None else each for each in tangents)
    places: FloatArray = _core.fair_curve(
        np.ascontiguousarray(ends), np.array([begin, -end]), lengths[:-1] / lengths[-1]
    )
    return places
