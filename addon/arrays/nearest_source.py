"""Shortest paths over a graph from several sources at once. Plain numpy, no bpy."""

from __future__ import annotations

import heapq

import numpy as np

from .types import Floats, Ints


def nearest_sources(count: int, links: Ints, lengths: Floats, sources: Ints) -> Ints:
    """Return (count,): the node before each one on the shortest path from a source; itself at sources, −1 out of reach.

    links: (l, 2) pairs of nodes, each as long as lengths (l,) says.
    """
    adjacent: list[list[tuple[int, float]]] = [[] for _ in range(count)]
    for (a, b), length in zip(links.tolist(), lengths.tolist(), strict=True):
        adjacent[a].append((b, length))
        adjacent[b].append((a, length))
    away = [np.inf] * count
    before = [-1] * count
    queue = [(0.0, source) for source in sources.tolist()]
    for _, source in queue:
        away[source], before[source] = 0.0, source
    while queue:
        distance, node = heapq.heappop(queue)
        if distance > away[node]:
            continue
        for other, length in adjacent[node]:
            if distance + length < away[other]:
                away[other], before[other] = distance + length, node
                heapq.heappush(queue, (away[other], other))
    return np.array(before, dtype=np.int64)


def owners(before: Ints) -> Ints:
    """Return the source that each node's path comes from; −1 out of reach."""
    found = np.where(before < 0, np.arange(len(before)), before)
    while True:
        further = found[found]
        if (further == found).all():
            return np.where(before < 0, -1, found)
        found = further
