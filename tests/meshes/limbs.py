"""Hands over one outline: a patch some of whose inner vertices are replaced by the connectivity of long limbs."""

from collections.abc import Iterable

import numpy as np

from meshing import IntArray
from shapes import Patch


def with_limbs(patch: Patch, count: int, rows: int) -> tuple[IntArray, int]:
    """Triangles and how many vertices they have; up to `count` limbs of `rows` rings, whose tips are old vertices.

    A limb has twice as many vertices around as its tip had neighbours. New vertices come after the old ones.
    """
    tips = _apart(patch, count)
    triangles = [t for t in patch.triangles.tolist() if not set(t) & set(tips)]
    number = len(patch.vertices)
    for tip in tips:
        ring = _ring_of(patch, tip)
        outer, ring, number = ring, list(range(number, number + 2 * len(ring))), number + 2 * len(ring)
        triangles += _doubling(outer, ring)
        for _ in range(rows):
            outer, ring, number = ring, list(range(number, number + len(ring))), number + len(ring)
            triangles += _between(outer, ring)
        triangles += [[a, b, tip] for a, b in _sides(ring)]
    return np.array(triangles), number


def _apart(patch: Patch, count: int) -> list[int]:
    """Vertices whose neighbours are free and nobody else's, in a fixed order."""
    fixed = set(patch.fixed.tolist())
    free = [v for v in range(len(patch.vertices)) if v not in fixed]
    used, tips = set(fixed), list[int]()
    for v in np.random.default_rng(0).permutation(free).tolist():
        star = {v, *_ring_of(patch, v)}
        if len(tips) < count and not used & star:
            used |= star
            tips.append(v)
    return tips


def _ring_of(patch: Patch, vertex: int) -> list[int]:
    """The neighbours of an inner vertex, counter-clockwise."""
    turned = [np.roll(t, -t.tolist().index(vertex)).tolist() for t in patch.triangles if vertex in t]
    after = {a: b for _, a, b in turned}
    ring = [turned[0][1]]
    while len(ring) < len(turned):
        ring.append(after[ring[-1]])
    return ring


def _sides(ring: list[int]) -> Iterable[tuple[int, int]]:
    return zip(ring, ring[1:] + ring[:1], strict=True)


def _between(outer: list[int], inner: list[int]) -> list[list[int]]:
    pairs = zip(_sides(outer), _sides(inner), strict=True)
    return [t for (a, b), (c, d) in pairs for t in ([a, b, d], [a, d, c])]


def _doubling(outer: list[int], inner: list[int]) -> list[list[int]]:
    """From a ring to one with twice as many vertices, two for each side: at its first end and at its middle."""
    result = []
    for k, (a, b) in enumerate(_sides(outer)):
        at_a, middle, at_b = inner[2 * k], inner[2 * k + 1], inner[(2 * k + 2) % len(inner)]
        result += [[a, b, middle], [a, middle, at_a], [b, at_b, middle]]
    return result
