"""Graded irregular caps at sizes that a point-by-point generator can't reach.

Random points and flipped edges on a hemisphere, then a Möbius map of its stereographic disc: it is conformal, so
triangles keep their shape and edges grow from one side of the rim to the other.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import shapes
from graded import ASPECT, FLIPS
from meshing import Mesh, edge_pairs, flip_edges
from shapes import Patch, Style
from surfaces import Sphere

CENTRE = 0.43  # where the map takes the pole, in radii of the disc: makes an edge ratio of about 40


def graded_disc(n_free: int, style: Style) -> Patch:
    """A hemisphere of edge ratio about 40; every twelfth edge is flipped where triangles stay below an aspect of 12."""
    even = shapes.cap(n_free, replace(style, layout="random", jitter=0.0))
    surface = even.surface
    assert isinstance(surface, Sphere)
    s, t = surface.locate(even.vertices)
    disc = np.ascontiguousarray(surface.chart(s, t)).view(np.complex128)[:, 0]
    moved = (disc + CENTRE) / (1 + CENTRE * disc)
    st = np.column_stack(surface.unchart(moved.view(np.float64).reshape(-1, 2)))
    count = len(edge_pairs(even.triangles)[0])
    chosen = np.random.default_rng([style.seed, 13]).permutation(count)[: round(FLIPS * count)]
    triangles = flip_edges(even.domain, st, even.triangles, chosen, quality=0.25 * np.sqrt(3) / ASPECT)
    return shapes.patch_of(even.domain, Mesh(st, triangles, even.fixed))
