"""Faces of a patch that are wound against the others: they are turned on a copy, before anything reads a normal off."""

from __future__ import annotations

from collections import defaultdict, deque
from dataclasses import replace

import numpy as np

from ..words.words import said
from .boundary import two_sided_edges
from .region import MeshArrays, reversed_corners
from .types import Ints, Mask


def with_one_winding(mesh: MeshArrays) -> tuple[MeshArrays, int]:
    """Return the mesh with all faces of each connected part of the patch wound as most of them, and how many turned."""
    turned = _against_most(mesh)
    count = int(np.count_nonzero(turned))
    return (_turned(mesh, turned), count) if count else (mesh, 0)


def winding_note(turned: int) -> tuple[str, ...]:
    """Return the sentence on faces that were turned."""
    return (said("INCONSISTENT_WINDING", n=turned),) if turned else ()


def _against_most(mesh: MeshArrays) -> Mask:
    """Return the (f,) mask of faces wound against most of those that edges connect them with."""
    against = np.zeros(len(mesh.in_patch), dtype=bool)
    own = np.zeros(len(mesh.edges), dtype=bool)
    own[mesh.corner_edges[mesh.in_patch[mesh.corner_faces]]] = True
    sides = two_sided_edges(mesh, own)
    within = mesh.in_patch[sides.faces].all(axis=1)
    if not sides.alike[within].any():
        return against
    adjacent: dict[int, list[tuple[int, bool]]] = defaultdict(list)
    for (a, b), alike in zip(sides.faces[within].tolist(), sides.alike[within].tolist(), strict=True):
        adjacent[a].append((b, alike))
        adjacent[b].append((a, alike))
    turns: dict[int, bool] = {}
    for start in adjacent:
        if start not in turns:
            part = _spread(start, adjacent)
            most = 2 * sum(part.values()) > len(part)
            turns.update({face: turned != most for face, turned in part.items()})
    against[[face for face, turned in turns.items() if turned]] = True
    return against


def _spread(start: int, adjacent: dict[int, list[tuple[int, bool]]]) -> dict[int, bool]:
    """Return which faces connected with `start` are wound against it; on a Möbius strip the first path there counts."""
    against, queue = {start: False}, deque([start])
    while queue:
        face = queue.popleft()
        for other, alike in adjacent[face]:
            if other not in against:
                against[other] = against[face] != alike
                queue.append(other)
    return against


def _turned(mesh: MeshArrays, faces: Mask) -> MeshArrays:
    """Return the mesh with the faces in the (f,) mask wound the other way round."""
    backwards, along = reversed_corners(mesh.corner_faces)
    corners = np.arange(len(backwards))
    turned = faces[mesh.corner_faces]
    order: Ints = np.where(turned, backwards, corners)
    edges: Ints = np.where(turned, along, corners)
    triangles = mesh.triangles.copy()
    rows = faces[mesh.triangle_faces]
    triangles[rows] = triangles[rows, ::-1]
    normals = mesh.corner_normals
    return replace(
        mesh,
        corner_vertices=mesh.corner_vertices[order],
        corner_edges=mesh.corner_edges[edges],
        triangles=triangles,
        corner_normals=None if normals is None else np.where(turned[:, None], -normals, normals)[order],
    )
