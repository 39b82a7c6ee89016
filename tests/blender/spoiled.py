"""Meshes that an operator may meet and no artist wants: one function for each."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import meshes
import numpy as np


def edited(obj: bpy.types.Object, change: Callable[[bmesh.types.BMesh], Any]) -> Any:
    """Change the mesh of an object in object mode; return what `change` does."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.faces.ensure_lookup_table()
    outcome = change(bm)
    bm.to_mesh(obj.data)
    bm.free()
    return outcome


def middle(obj: bpy.types.Object) -> int:
    """The vertex nearest to the origin."""
    return int(np.linalg.norm(meshes.positions(obj), axis=1).argmin())


def central(obj: bpy.types.Object, half: float = 0.7) -> meshes.Mask:
    """The faces around the origin, those that stand on them too."""
    return meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < half)


def raise_fin(obj: bpy.types.Object, place: tuple[float, float]) -> tuple[int, int]:
    """Put a triangle upright on the edge nearest to a place (x, y); return the edge's vertices."""

    def change(bm: bmesh.types.BMesh) -> tuple[int, int]:
        def distance(edge: bmesh.types.BMEdge) -> float:
            x, y = (edge.verts[0].co + edge.verts[1].co).xy / 2.0
            return float(np.hypot(x - place[0], y - place[1]))

        a, b = min(bm.edges, key=distance).verts
        found = (a.index, b.index)
        bm.faces.new((a, b, bm.verts.new((a.co + b.co) / 2.0 + (b.co - a.co).orthogonal())))
        return found

    return edited(obj, change)


def bow_tie() -> bpy.types.Object:
    """Two umbrellas whose tips are one vertex: number 0."""
    angles = 2.0 * np.pi * np.arange(6) / 6.0
    points = [np.zeros(3)]
    faces: list[list[int]] = []
    for side in (-1.0, 1.0):
        first = len(points)
        points += [(r * np.cos(a), r * np.sin(a), side * r) for r in (0.5, 1.0) for a in angles]
        for k in range(6):
            this, other = first + k, first + (k + 1) % 6
            ring = [[0, this, other], [this, this + 6, other + 6, other]]
            faces += ring if side > 0.0 else [face[::-1] for face in ring]
    return meshes.add(points, faces, "BowTie")


def moebius_strip(around: int = 24, across: int = 4) -> bpy.types.Object:
    """A band of quads, joined after half a turn."""
    points = []
    for k in range(around):
        turn = 2.0 * np.pi * k / around
        out = np.array([np.cos(turn), np.sin(turn), 0.0])
        along = np.cos(turn / 2.0) * out + np.sin(turn / 2.0) * np.array([0.0, 0.0, 1.0])
        points += [out + t * along for t in np.linspace(-0.3, 0.3, across + 1)]
    width = across + 1

    def number(k: int, j: int) -> int:
        return k * width + j if k < around else across - j

    faces = [
        [number(k, j), number(k + 1, j), number(k + 1, j + 1), number(k, j + 1)]
        for k in range(around)
        for j in range(across)
    ]
    return meshes.add(points, faces, "Moebius")


def join(first: bpy.types.Object, second: bpy.types.Object) -> bpy.types.Object:
    """Make one object of two; the first one's elements come first."""
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in (first, second))
    bpy.context.view_layer.objects.active = first
    bpy.ops.object.join()
    return bpy.context.view_layer.objects.active
