"""Hard edges around a patch that a smoothed boundary has rounded: a row of steadily sharp edges that runs on straight.

Noise has sharp edges, too, but they don't run on, and each bends by another angle. The limits below were set on a cube,
on noisy spheres and on scans (docs/blender.md): what they miss are edges below 70° and rows of fewer than four edges.
"""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints, Mask
from .bends import Bends, bends
from .vectors import unit

SHARP = 35.0  # degrees from which an edge may belong to a row
HARD = 70.0  # degrees by which a row bends in the median
STEADY = 15.0  # degrees: largest standard deviation within a row
STRAIGHT = 0.85  # cosine between an edge and the next one
ROW = 4  # edges of a row, one of which at least doesn't move
ROUNDED = 15.0  # degrees by which one of its edges at least has become flatter


def rounded_edges(before: Floats, after: Floats, triangles: Ints, moved: Ints) -> Ints:
    """Return the vertices at hard edges of the triangles (m, 3) that are rounded, ascending.

    before, after: (q, 3) positions; moved: the vertices that differ.
    """
    old = bends(before, triangles)
    flatter = np.abs(old.degrees) - np.abs(bends(after, triangles).degrees) > ROUNDED
    moves = np.isin(old.edges, moved).any(axis=1)
    found = [np.empty(0, dtype=np.int64)]
    for sign in (1.0, -1.0):
        sharp = np.flatnonzero(sign * old.degrees > SHARP)
        for row in _rows(before, old.edges[sharp]):
            edges = sharp[row]
            if _is_hard(old, edges, moves) and flatter[edges].any():
                found.append(old.edges[edges[flatter[edges]]].ravel())
    vertices: Ints = np.intersect1d(np.concatenate(found), moved)
    return vertices


def _is_hard(old: Bends, edges: Ints, moves: Mask) -> bool:
    degrees = np.abs(old.degrees[edges])
    long_enough = len(edges) >= ROW and not moves[edges].all()
    return bool(long_enough and np.median(degrees) >= HARD and degrees.std() <= STEADY)


def _rows(points: Floats, edges: Ints) -> list[Ints]:
    """Return the rows into which edges (k, 2) fall, joined where one runs on straight in another."""
    along = unit(points[edges[:, 1]] - points[edges[:, 0]])
    row = np.arange(len(edges))
    ends: dict[int, list[tuple[int, Floats]]] = {}
    for edge, (first, second) in enumerate(edges.tolist()):
        for vertex, direction in ((first, along[edge]), (second, -along[edge])):
            for other, its in ends.setdefault(vertex, []):
                if float(direction @ its) < -STRAIGHT:
                    row[row == row[other]] = row[edge]
            ends[vertex].append((edge, direction))
    return [np.flatnonzero(row == number) for number in np.unique(row)]
