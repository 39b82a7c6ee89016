"""Edges that a new mesh keeps: seams of textures and colours, edges with marks of their own. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from ..words.words import said
from .boundary import edges_inside
from .region import MeshArrays, free_vertices
from .types import Floats, Mask

WIRES = "edges without faces"  # in MeshArrays.lines
SAME = 1e-6  # of values that are meant to be one
_WORDS = {
    "sharp_edge": "Mark Sharp",
    "freestyle_edge": "Mark Freestyle Edge",
    "crease_edge": "Edge Crease",
    "bevel_weight_edge": "Edge Bevel Weight",
    "material_index": "materials",
    ".sculpt_face_set": "face sets",
}  # of Blender's own attributes, which it shows by other names
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


def edges_at_wires(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of one edge of the patch at each vertex inside that edges without faces hang on.

    A line keeps its vertices, and so these edges. Of those at the vertex it is the one of median length: a short or a
    long one would leave its mark on the new mesh.
    """
    used = np.zeros(len(mesh.edges), dtype=bool)
    used[mesh.corner_edges] = True
    hung = np.zeros(len(mesh.positions), dtype=bool)
    hung[mesh.edges[~used]] = True
    hung &= free_vertices(mesh)
    edges, side = np.nonzero(hung[mesh.edges] & used[:, None])
    vertices = mesh.edges[edges, side]
    lengths = np.linalg.norm(np.diff(mesh.positions[mesh.edges[edges]], axis=1)[:, 0], axis=1)
    order = np.lexsort((lengths, vertices))
    _, starts, counts = np.unique(vertices[order], return_index=True, return_counts=True)
    found = np.zeros(len(mesh.edges), dtype=bool)
    found[edges[order][starts + counts // 2]] = True
    return found


def inner_lines(mesh: MeshArrays) -> Mask:
    """Return those of mesh.lines that lie inside the patch, as an (e,) mask; raises ValueError where most edges do."""
    inside = edges_inside(mesh)
    lines = np.zeros(len(mesh.edges), dtype=bool)
    for of_one_kind in mesh.lines.values():
        lines |= of_one_kind & inside
    if np.count_nonzero(lines) > MOST * np.count_nonzero(inside):
        raise ValueError(_refusal(mesh, lines, inside))
    return lines


def inner_curves(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of pinned edges inside the patch with free slopes, which its new mesh is cut along."""
    curves = np.zeros(len(mesh.edges), dtype=bool)
    for of_one_kind in (mesh.creases, mesh.smooth_curves):
        if of_one_kind is not None:
            curves |= of_one_kind
    result: Mask = curves & edges_inside(mesh)
    return result


def _refusal(mesh: MeshArrays, lines: Mask, inside: Mask) -> str:
    counts = {name: np.count_nonzero(mask & inside) for name, mask in mesh.lines.items()}
    most = max(counts, key=lambda name: counts[name])
    lines_in, all_in = (int(np.count_nonzero(mask)) for mask in (lines, inside))
    return said("all_lines", lines=lines_in, all=all_in, most=int(counts[most]), name=_WORDS.get(most, most))
