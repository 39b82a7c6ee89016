"""Hard edges that became round: a row of steadily sharp edges that runs on straight.

Noise has sharp edges, too, but they don't run on, and each bends by another angle. The limits below were set on cubes,
on noisy spheres and on scans (docs/blender.md): what they miss are rows of fewer than four edges, edges below 40°, and
uneven ones below 70°.
"""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints, Mask
from .bends import Bends, bends
from .vectors import unit

SHARP = 35.0  # degrees from which an edge may belong to a row
HARD = 70.0  # degrees by which a row bends in the median
STEADY = 15.0  # degrees: largest standard deviation within a row
BEVELLED, EVEN = 40.0, 4.0  # the same for rows that no noise has touched, such as those of a bevelled edge
STRAIGHT = 0.85  # cosine between an edge and the next one
ROW = 4  # edges of a row at least
ROUNDED = 15.0  # degrees by which one of its edges at least has become flatter


def rounded_edges(before: Floats, after: Floats, triangles: Ints, moved: Ints, still: int = 1) -> Ints:
    """Return the vertices at hard edges of the triangles (m, 3) that are rounded, ascending.

    before, after: (q, 3) positions; moved: the vertices that differ; still: edges of each row that stay, at least.
    """
    old = bends(before, triangles)
    flatter = np.abs(old.degrees) - np.abs(bends(after, triangles).degrees) > ROUNDED
    moves = np.isin(old.edges, moved).any(axis=1)
    found = [np.empty(0, dtype=np.int64)]
    for sign in (1.0, -1.0):
        sharp = np.flatnonzero(sign * old.degrees > SHARP)
        for row in _rows(before, old.edges[sharp]):
            edges = sharp[row]
            if _is_hard(old, edges, moves, still) and flatter[edges].any():
                found.append(old.edges[edges[flatter[edges]]].ravel())
    vertices: Ints = np.intersect1d(np.concatenate(found), moved)
    return vertices


def _is_hard(old: Bends, edges: Ints, moves: Mask, still: int) -> bool:
    if len(edges) < ROW or np.count_nonzero(~moves[edges]) < still:
        return False
    degrees = np.abs(old.degrees[edges])
    middle, spread = np.median(degrees), degrees.std()
    return bool((middle >= HARD and spread <= STEADY) or (middle >= BEVELLED and spread <= EVEN))


def _rows(points: Floats, edges: Ints) -> list[Ints]:
    """Return the rows into which edges (k, 2) fall, joined where one runs on straight in another."""
    along = unit(points[edges[:, 1]] - points[edges[:, 0]])
    row = list(range(len(edges)))
    ends: dict[int, list[tuple[int, Floats]]] = {}
    for edge, (first, second) in enumerate(edges.tolist()):
        for vertex, direction in ((first, along[edge]), (second, -along[edge])):
            for other, its in ends.setdefault(vertex, []):
                if float(direction @ its) < -STRAIGHT:
                    row[_first(row, other)] = _first(row, edge)
            ends[vertex].append((edge, direction))
    numbers = np.array([_first(row, edge) for edge in range(len(edges))], dtype=np.int64)
    return [np.flatnonzero(numbers == number) for number in np.unique(numbers)]


def _first(row: list[int], edge: int) -> int:
    """Return the edge that stands for the row of another one, and shorten the way there."""
    while row[edge] != edge:
        row[edge] = row[row[edge]]
        edge = row[edge]
    return edge
