"""Border loops that a selection stands for. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..words.words import said
from .region import MeshArrays, face_sizes
from .types import Ints, Mask

NO_BORDER = said("no_border")


class BorderRefusal(ValueError):
    """A border that can't be filled; `elements` are vertices of the mesh."""

    def __init__(self, text: str, elements: Ints) -> None:
        super().__init__(text)
        self.elements = elements


@dataclass(frozen=True)
class Left:
    """A hole that stays open, or several that were to be joined: their vertices, and why."""

    vertices: Ints
    reason: str
    spots: Ints  # vertices that the reason is about

    def named(self, numbers: Callable[[Ints], Ints]) -> Left:
        """Return it with other numbers of its vertices."""
        return replace(self, vertices=np.unique(numbers(self.vertices)), spots=numbers(self.spots))


def left_by(error: Exception, vertices: Ints) -> Left:
    """Return the hole that an error kept from being filled."""
    spots = np.asarray(getattr(error, "elements", ()), dtype=np.int64)
    return Left(vertices, str(error), spots if len(spots) else vertices)


def border_loops(mesh: MeshArrays, seeds: Mask) -> tuple[list[Ints], list[Left]]:
    """Return the whole border loops through the vertices of the (n,) mask, each with the hole on its left.

    In the order of their lowest vertices; none where no seed is on a border. Where borders touch, they are parted as
    `fairing.borders.hole_loops` does it; a vertex where two touch stands for both only where neither has other seeds.
    Also returns what can't be filled: borders along which faces are wound against each other, without an area, or with
    a coordinate that is not finite.
    """
    edges = _border_edges(mesh)
    passes = np.bincount(edges[:, 0], minlength=len(seeds))
    pinched = (passes > 1)[mesh.triangles].any(axis=1)
    found = fairing.borders.hole_loops(mesh.positions, mesh.triangles[pinched], edges)
    loops: list[Ints] = []
    left = [_torn(chain.astype(np.int64)) for chain in found.torn if seeds[chain].any()]
    for loop in _meant([loop.astype(np.int64) for loop in found.loops], seeds, passes > 1):
        try:
            _check(mesh, loop)
            loops.append(loop)
        except BorderRefusal as refusal:
            left.append(left_by(refusal, np.unique(loop)))
    return loops, left


def refuse_all(left: Sequence[Left]) -> None:
    """Raise BorderRefusal with the first reason, where there is one."""
    if left:
        raise BorderRefusal(left[0].reason, left[0].spots)


def notes_on(left: Sequence[Left]) -> tuple[str, ...]:
    """Return a sentence for each reason for which holes stay open."""
    reasons = dict.fromkeys(each.reason for each in left)
    counts = [(reason, sum(each.reason == reason for each in left)) for reason in reasons]
    return tuple(said("holes_stay", n=count, reason=reason) for reason, count in counts)


def _border_edges(mesh: MeshArrays) -> Ints:
    """Return the (e, 2) edges with one face, with the hole on their left."""
    sizes = face_sizes(mesh)
    following = np.arange(len(mesh.corner_vertices)) + 1
    following[np.cumsum(sizes) - 1] = np.cumsum(sizes) - sizes
    uses = np.bincount(mesh.corner_edges, minlength=len(mesh.edges))
    border = uses[mesh.corner_edges] == 1
    return np.column_stack([mesh.corner_vertices[following[border]], mesh.corner_vertices[border]])


def _meant(loops: list[Ints], seeds: Mask, shared: Mask) -> list[Ints]:
    """Return the loops that the seeds stand for; shared: (n,) vertices that borders pass several times."""
    own = [bool((seeds[loop] & ~shared[loop]).any()) for loop in loops]
    taken = np.zeros(len(seeds), dtype=bool)
    for loop, is_meant in zip(loops, own, strict=True):
        taken[loop] |= is_meant
    return [loop for loop, is_meant in zip(loops, own, strict=True) if is_meant or (seeds & ~taken)[loop].any()]


def _torn(chain: Ints) -> Left:
    ends = np.unique(chain[[0, -1]])
    return Left(np.unique(chain), said("border_wound", first=ends[0]), ends)


def _check(mesh: MeshArrays, loop: Ints) -> None:
    points = mesh.positions[loop]
    broken = loop[~np.isfinite(points).all(axis=1)]
    if len(broken):
        raise BorderRefusal(said("border_nan", first=broken[0]), broken)
    same = loop[(points == np.roll(points, -1, axis=0)).all(axis=1)]
    if len(same):
        raise BorderRefusal(said("border_no_length", first=same[0]), same)
