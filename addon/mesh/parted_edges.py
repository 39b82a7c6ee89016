"""Edges of a bmesh in several: with the marks, UVs and weights that Blender's own subdivision gives the pieces."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bmesh

from ..core.subdivided import Subdivided


@contextmanager
def parted_edges(bm: Any, parted: Subdivided | None) -> Iterator[list[Any]]:
    """Give the vertices by their numbers in the subdivided mesh, with its edges parted; whole again after an error."""
    bm.verts.ensure_lookup_table()
    table = list(bm.verts)
    new = [] if parted is None else _part(bm, table, parted)
    bm.verts.index_update()
    try:
        yield [*table, *new]
    except Exception:
        for vertex in new[::-1]:
            bmesh.utils.vert_collapse_edge(vertex, vertex.link_edges[0])
        raise


def _part(bm: Any, table: list[Any], parted: Subdivided) -> list[Any]:
    """Put the new vertices in, edge after edge."""
    new: list[Any] = []
    before, done = (-1, -1), 0.0
    for pair, share in zip(map(tuple, parted.ends.tolist()), parted.shares.tolist(), strict=True):
        tail, head = (table[number] for number in pair)
        if pair != before:
            start, edge, done = tail, bm.edges.get((tail, head)), 0.0
        place = tail.co.lerp(head.co, share)
        _, vertex = bmesh.utils.edge_split(edge, start, (share - done) / (1.0 - done))
        vertex.co = place
        edge = bm.edges.get((vertex, head))
        new.append(vertex)
        start, before, done = vertex, pair, share
    return new
