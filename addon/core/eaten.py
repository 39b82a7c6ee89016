"""Hard edges that a fair surface has rounded off, though they are part of the shape around it, or were marked to stay.

An edge that lies inside the selection from end to end is what fairing removes. One that runs on outside ends in the
surface as if it had been bitten off.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .around import nearby
from .arrays import Floats, Ints, Mask
from .bends import bends
from .engine import Problem
from .region import nothing
from .rounded import ROUNDED, SHARP, rounded_edges

RUNS_ON = 2  # edges of a row that lie outside at least
MOST_MARKED = 0.25  # of the edges inside: importers mark nearly all of them, which sets none apart


@dataclass(frozen=True)
class Eaten:
    """Mesh vertices at hard edges that the patch had and has no more, ascending."""

    running_on: Ints = field(default_factory=nothing)  # of rows that lead out of the patch
    marked: Ints = field(default_factory=nothing)  # marked sharp, though not pinned


def eaten_edges(problem: Problem, after: Floats, sharp: Ints | None) -> Eaten:
    """Compare the positions (q, 3) of problem.vertices before and after.

    sharp: (k, 2) edges that are marked so, in numbers of the mesh, ordered within; None: none.
    """
    patch, before = problem.patch, problem.points
    moves = np.zeros(len(before), dtype=bool)
    moves[patch.free] = True
    # Far inside an edge may be a feature of its own: rows are followed near the outline alone.
    outline = np.zeros(len(before), dtype=bool)
    outline[np.intersect1d(patch.outline, problem.outside)] = True
    near = nearby(np.concatenate([patch.triangles, problem.outside]), outline)
    running = rounded_edges(before, after, near, patch.free, RUNS_ON)
    marked = nothing() if sharp is None else _blunted(problem, after, sharp, moves)
    return Eaten(problem.vertices[running], marked)


def _blunted(problem: Problem, after: Floats, sharp: Ints, moves: Mask) -> Ints:
    patch = problem.patch
    own = len(patch.vertices)
    old, new = bends(problem.points[:own], patch.triangles), bends(after[:own], patch.triangles)
    flatter = (np.abs(old.degrees) > SHARP) & (np.abs(old.degrees) - np.abs(new.degrees) > ROUNDED)
    marked = _is_among(patch.vertices[old.edges], sharp)
    if np.count_nonzero(marked) > MOST_MARKED * len(marked):
        return nothing()
    found = marked & flatter & moves[old.edges].any(axis=1)
    vertices: Ints = np.unique(patch.vertices[old.edges[found]])
    return vertices


def _is_among(edges: Ints, some: Ints) -> Mask:
    """Return the (e,) mask of edges (e, 2) that are among some (k, 2); all are ordered within."""
    count = int(edges.max(initial=0)) + 1
    known = some[(some < count).all(axis=1)]
    found: Mask = np.isin(edges[:, 0] * count + edges[:, 1], known[:, 0] * count + known[:, 1])
    return found
