"""Edges that a new mesh keeps: seams of textures and colours, edges with marks of their own. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Mask
from .outline import two_sided_edges
from .region import MeshArrays

SAME = 1e-6  # of values that are meant to be one
MOST = 0.5  # of the edges inside that may stay, or there is nothing to be meshed anew


def parting_edges(mesh: MeshArrays, values: Floats) -> Mask:
    """Return the (e,) mask of edges on whose two sides the values (c, w) of the corners differ at either end."""
    after = np.arange(len(mesh.corner_vertices)) + 1
    ends = np.flatnonzero(np.diff(mesh.corner_faces, append=-1))
    after[ends] = np.concatenate([[0], ends[:-1] + 1]) if len(ends) else ends
    forward = mesh.corner_vertices < mesh.corner_vertices[after]
    low = np.where(forward[:, None], values, values[after])
    high = np.where(forward[:, None], values[after], values)
    order = np.argsort(mesh.corner_edges, kind="stable")
    edges, both = mesh.corner_edges[order], np.concatenate([low, high], axis=1)[order]
    same_edge = edges[1:] == edges[:-1]
    differs = same_edge & (np.abs(both[1:] - both[:-1]) > SAME).any(axis=1)
    found = np.zeros(len(mesh.edges), dtype=bool)
    found[edges[1:][differs]] = True
    return found


def inner_lines(mesh: MeshArrays) -> Mask:
    """Return those of mesh.lines that lie inside the patch, as an (e,) mask; raises ValueError where most edges do."""
    inside = np.zeros(len(mesh.edges), dtype=bool)
    sides = two_sided_edges(mesh, np.ones(len(mesh.edges), dtype=bool))
    inside[sides.edges] = mesh.in_patch[sides.faces].all(axis=1)
    if mesh.lines is None:
        return np.zeros(len(mesh.edges), dtype=bool)
    lines: Mask = mesh.lines & inside
    if np.count_nonzero(lines) > MOST * np.count_nonzero(inside):
        raise ValueError(
            f"{np.count_nonzero(lines)} of {np.count_nonzero(inside)} edges inside the selection are seams of UVs, "
            "colours or materials, or marked, and would stay: there is nothing to mesh anew. Choose Mesh: Keep"
        )
    return lines
