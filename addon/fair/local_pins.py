"""Lone pins that pull the surface around them only. Plain numpy, no bpy.

A surface that passes through them as a whole has to bend everywhere: three pins swell a head. Instead it is found
without them, and then lifted: by bumps with two continuous derivatives (Wendland 1995, φ₃,₁) that end within a radius.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from ..arrays.region import MeshArrays, free_vertices
from ..arrays.types import Floats, Ints, Mask
from ..options.options import FairOptions
from .engine import Problem

WIDTH = 3.0  # of a bump's radius over Pin Radius: it falls to a half at a third of it


def without_lone_pins(mesh: MeshArrays, options: FairOptions) -> tuple[MeshArrays, Mask]:
    """Return the mesh with the pins let go that pull locally, and their (n,) mask: none where nothing else holds it."""
    lone = lone_pins(mesh) if options.pulls_locally else np.zeros(len(mesh.pinned), dtype=bool)
    released = replace(mesh, pinned=mesh.pinned & ~lone)
    inside = mesh.corner_vertices[mesh.in_patch[mesh.corner_faces]]
    is_held = not free_vertices(released)[inside].all()
    return (released, lone) if is_held else (mesh, np.zeros_like(lone))


def lone_pins(mesh: MeshArrays) -> Mask:
    """Return the (n,) mask of pinned vertices of the patch with no pinned neighbour that would be free."""
    ends = mesh.edges[mesh.pinned[mesh.edges].all(axis=1)]
    alone = mesh.pinned.copy()
    alone[ends] = False
    lone: Mask = alone & free_vertices(replace(mesh, pinned=mesh.pinned & ~alone))
    return lone


def pulled(problem: Problem, vertices: Floats, lone: Mask, radius: float) -> Floats:
    """Return the vertices (q, 3) of an answer without the pins lifted to where they are; radius: of Pin Radius."""
    patch = problem.patch
    pins = np.flatnonzero(lone[patch.vertices])
    if not len(pins):
        return vertices
    own = len(patch.vertices)
    surface = vertices[:own]
    size = np.ptp(problem.own_points, axis=0).max()
    reach = np.minimum(WIDTH * radius * size, _to_the_nearest(surface, pins, patch.fixed))
    normals = fairing.vertex_normals(surface, patch.triangles)
    bumps = _bumps(surface, normals, pins, reach)
    wanted = problem.own_points[pins]
    points = vertices.copy()
    points[:own] += bumps @ np.linalg.solve(bumps[pins], wanted - surface[pins])
    points[pins] = wanted
    return points


def _to_the_nearest(points: Floats, pins: Ints, fixed: Ints) -> Floats:
    """Return (k,) how far each pin is from the nearest fixed vertex, where bumps have to end."""
    if not len(fixed):
        return np.full(len(pins), np.inf)
    return np.array([np.linalg.norm(points[fixed] - points[pin], axis=1).min() for pin in pins])


def _bumps(points: Floats, normals: Floats, pins: Ints, reach: Floats) -> Floats:
    """Return (p, k): the bump of each pin at each of the points, 1 at the pin; none on what faces away from it."""
    columns = []
    for pin, end in zip(pins, reach, strict=True):
        away = np.minimum(np.linalg.norm(points - points[pin], axis=1) / end, 1.0)
        facing = np.maximum(normals @ normals[pin], 0.0)
        columns.append((1.0 - away) ** 4 * (4.0 * away + 1.0) * facing)
    bumps: Floats = np.stack(columns, axis=1)
    return bumps
