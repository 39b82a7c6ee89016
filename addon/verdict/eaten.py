"""Hard edges that a fair surface has rounded off, though they are part of the shape around it, or were marked to stay.

An edge that lies inside the selection from end to end is what fairing removes. One that runs on outside ends in the
surface as if it had been bitten off.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import fairing

from ..arrays.around import nearby
from ..arrays.region import nothing
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem


@dataclass(frozen=True)
class Eaten:
    """Mesh vertices at hard edges that the patch had and has no more, ascending."""

    running_on: Ints = field(default_factory=nothing)  # of chains that lead out of the patch
    marked: Ints = field(default_factory=nothing)  # marked sharp, though not pinned


def eaten_edges(problem: Problem, after: Floats, sharp: Ints | None) -> Eaten:
    """Compare the positions (q, 3) of problem.vertices before and after.

    sharp: (k, 2) edges that are marked so, in numbers of the mesh; None: none.
    """
    patch = problem.patch
    # Far inside an edge may be a feature of its own: chains are followed near the boundary alone.
    rim = np.zeros(len(problem.vertices), dtype=bool)
    rim[np.intersect1d(patch.outline, problem.outside)] = True
    near = nearby(np.concatenate([patch.triangles, problem.outside]), rim)
    running_on = fairing.looks.rounded_edges(problem.points, after, near, patch.free)
    marked = nothing() if sharp is None else _blunted(problem, after, sharp)
    return Eaten(np.sort(problem.vertices[running_on]), np.sort(problem.vertices[marked]))


def _blunted(problem: Problem, after: Floats, sharp: Ints) -> Ints:
    """Return the vertices of the patch at hard edges marked sharp that are rounded off."""
    patch = problem.patch
    number = np.full(max(int(patch.vertices.max()), int(sharp.max(initial=0))) + 1, -1)
    number[patch.vertices] = np.arange(len(patch.vertices))
    marked = number[sharp]
    own = len(patch.vertices)
    inside = marked[(marked >= 0).all(axis=1)]
    points = problem.points[:own], after[:own]
    return fairing.looks.rounded_edges(*points, patch.triangles, patch.free, marked=inside).astype(np.int64)
