"""Other connectivity for the same vertices, without looking at positions."""

import numpy as np

import measures
from meshing import IntArray, edge_pairs


def shuffled(triangles: IntArray, fixed: IntArray, share: float, seed: int = 0) -> IntArray:
    """This share of the edges flipped at random, valences of free vertices kept within 4 … 9.

    Edges of the curves of fixed vertices stay, and no edge is made twice.
    """
    result = triangles.copy()
    ends, faces, opposite = edge_pairs(triangles)
    count = int(triangles.max()) + 1
    held = np.isin(np.arange(count), fixed)
    valence = measures.valences(triangles, count)
    known = {(int(a), int(b)) for a, b in measures.edges(triangles)}
    touched = np.zeros(len(triangles), dtype=bool)
    order = np.random.default_rng(seed).permutation(len(ends))[: round(share * len(ends))]
    for edge in order:
        (a, b), (c, d), pair = ends[edge], opposite[edge], faces[edge]
        new = (int(min(c, d)), int(max(c, d)))
        crowded = valence[[c, d]].max() >= 9 or valence[[a, b]].min() <= 4
        if touched[pair].any() or new in known or crowded or held[[a, b, c, d]].any():
            continue
        first, second = _turned(triangles[pair[0]], int(c), int(d))
        result[pair], touched[pair] = (first, second), True
        known.add(new)
        valence[[a, b]] -= 1
        valence[[c, d]] += 1
    return result


def _turned(triangle: IntArray, apex: int, other: int) -> tuple[IntArray, IntArray]:
    """The two triangles on the edge apex – other, wound like the triangle that has the apex."""
    at = int(np.flatnonzero(triangle == apex)[0])
    a, b = triangle[(at + 1) % 3], triangle[(at + 2) % 3]
    return np.array([apex, a, other]), np.array([other, b, apex])
