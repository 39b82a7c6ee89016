"""Hard edges that a fair surface has rounded off, though they are part of the shape around it, or were marked to stay.

An edge that lies inside the selection from end to end is what fairing removes. One that runs on outside ends in the
surface as if it had been bitten off.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .around import nearby
from .arrays import Floats, Ints, Mask
from .bends import Bends, bends
from .engine import Problem
from .hard_chains import MOST_MARKED, SHARP, chains
from .region import nothing

ROUNDED = 15.0  # by which one has become flatter that is rounded off
BESIDE = 0.12  # of a hard edge's bend: what edges of the same triangles bend at most. Fins and folds of skin are round
RUNS_ON = 2  # of them that stay, and that are rounded off, at least


@dataclass(frozen=True)
class Eaten:
    """Mesh vertices at hard edges that the patch had and has no more, ascending."""

    running_on: Ints = field(default_factory=nothing)  # of chains that lead out of the patch
    marked: Ints = field(default_factory=nothing)  # marked sharp, though not pinned


def eaten_edges(problem: Problem, after: Floats, sharp: Ints | None) -> Eaten:
    """Compare the positions (q, 3) of problem.vertices before and after.

    sharp: (k, 2) edges that are marked so, in numbers of the mesh, ordered within; None: none.
    """
    patch, moves = problem.patch, np.zeros(len(problem.points), dtype=bool)
    moves[patch.free] = True
    marked = nothing() if sharp is None else _blunted(problem, after, sharp, moves)
    return Eaten(problem.vertices[_running_on(problem, after, moves)], marked)


def _running_on(problem: Problem, after: Floats, moves: Mask) -> Ints:
    """Return the free vertices, in numbers of the problem, at rounded edges of chains that lead out of the patch."""
    # Far inside an edge may be a feature of its own: chains are followed near the boundary alone.
    outline = np.zeros(len(moves), dtype=bool)
    outline[np.intersect1d(problem.patch.outline, problem.outside)] = True
    near = nearby(np.concatenate([problem.patch.triangles, problem.outside]), outline)
    old = bends(problem.points, near)
    inside = moves[old.edges].any(axis=1)
    outside = ~inside & ~outline[old.edges].all(axis=1)  # a chain along the boundary leads nowhere
    sizes = np.abs(old.degrees)
    flatter = inside & (sizes - np.abs(bends(after, near).degrees) > ROUNDED)
    found = [nothing()]
    for chain in chains(problem.points, old):
        parts = chain[outside[chain]], chain[flatter[chain]]
        beside = _beside(old, chain)
        if all(len(part) >= RUNS_ON and np.median(beside[part] / sizes[part]) <= BESIDE for part in parts):
            found.append(old.edges[parts[1]].ravel())
    ends = np.unique(np.concatenate(found))
    free: Ints = ends[moves[ends]]
    return free


def _beside(of: Bends, chain: Ints) -> Floats:
    """Return (e,) how much other edges than the chain's bend at most in the two triangles of each edge."""
    others = np.ones(len(of.edges), dtype=bool)
    others[chain] = False
    most = np.zeros(int(of.sides.max(initial=-1)) + 1)
    for side in of.sides[others].T:
        np.maximum.at(most, side, np.abs(of.degrees[others]))
    bent: Floats = most[of.sides].max(axis=1)
    return bent


def _blunted(problem: Problem, after: Floats, sharp: Ints, moves: Mask) -> Ints:
    """Return the mesh vertices at hard edges marked sharp that are rounded off."""
    patch = problem.patch
    own = len(patch.vertices)
    old, new = bends(problem.points[:own], patch.triangles), bends(after[:own], patch.triangles)
    marked = _is_among(patch.vertices[old.edges], sharp)
    if np.count_nonzero(marked) > MOST_MARKED * len(marked):
        return nothing()
    flatter = (np.abs(old.degrees) > SHARP) & (np.abs(old.degrees) - np.abs(new.degrees) > ROUNDED)
    found = marked & flatter & moves[old.edges].any(axis=1)
    vertices: Ints = np.unique(patch.vertices[old.edges[found]])
    return vertices


def _is_among(edges: Ints, some: Ints) -> Mask:
    """Return the (e,) mask of edges (e, 2) that are among some (k, 2); all are ordered within."""
    count = int(edges.max(initial=0)) + 1
    known = some[(some < count).all(axis=1)]
    found: Mask = np.isin(edges[:, 0] * count + edges[:, 1], known[:, 0] * count + known[:, 1])
    return found
