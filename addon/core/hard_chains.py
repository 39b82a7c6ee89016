"""Hard edges that hang together. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .arrays import Floats, Ints
from .bends import Bends
from .groups import groups

SHARP = 35.0  # degrees by which a hard edge bends
CHAIN = 4  # connected hard edges at least, and as many of their lengths from end to end
MOST_MARKED = 0.25  # of the edges around: importers mark nearly all of them, which sets none apart
MOST_SHARP = 0.12  # of the edges around may be sharp: among more, as noise has them, none stands out


def chains(points: Floats, of: Bends) -> Iterator[Ints]:
    """Yield which edges are connected hard edges, convex ones and concave ones each on their own."""
    for sign in (1.0, -1.0):
        hard = np.flatnonzero(sign * of.degrees > SHARP)
        if len(hard) > MOST_SHARP * len(of.edges):
            continue
        for members in groups(len(hard), _touching(of.edges[hard])):
            chain: Ints = hard[members]
            ends = points[of.edges[chain]]
            length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean()
            if len(chain) >= CHAIN and np.linalg.norm(np.ptp(ends, axis=(0, 1))) >= CHAIN * length:
                yield chain


def _touching(edges: Ints) -> Iterator[tuple[int, int]]:
    """Yield pairs of the edges (e, 2) that share a vertex, as many as connect them."""
    last: dict[int, int] = {}
    for edge, ends in enumerate(edges.tolist()):
        for vertex in ends:
            if vertex in last:
                yield edge, last[vertex]
            last[vertex] = edge
