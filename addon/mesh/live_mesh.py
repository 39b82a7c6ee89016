"""What Live reads from a mesh in edit mode at every change, and where its region is kept.

Without a temporary copy: that would be a change of its own, each time.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from itertools import chain
from operator import attrgetter
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Floats, Ints
from ..options.options import FairOptions

_co, _index, _verts = attrgetter("co"), attrgetter("index"), attrgetter("verts")  # called without a frame each

LAYER = "fair_live"  # integer face attribute, not zero in the region: bmesh of Blender 4.2 has no booleans
OPTIONS = "fair_live_options"  # custom property of the mesh: FairOptions as JSON
KEY = "fair_live_key"  # custom property of the mesh: the shape key that the region is in; empty for the Basis


def mark_faces(mesh: bpy.types.Mesh, faces: Ints, options: FairOptions, key: str) -> None:
    """Make these faces of a mesh in edit mode its region, with these options, in that shape key."""
    bm = bmesh.from_edit_mesh(mesh)
    layer = bm.faces.layers.int.get(LAYER) or bm.faces.layers.int.new(LAYER)
    chosen = np.zeros(len(bm.faces), dtype=np.int64)
    chosen[faces] = 1
    for face, inside in zip(bm.faces, chosen.tolist(), strict=True):
        face[layer] = inside
    mesh[OPTIONS] = json.dumps(asdict(options))
    mesh[KEY] = key
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def forget_region(mesh: bpy.types.Mesh) -> bool:
    """Remove the region from a mesh in edit mode; return whether there was one."""
    bm = bmesh.from_edit_mesh(mesh)
    layer = bm.faces.layers.int.get(LAYER)
    mesh.pop(OPTIONS, None)
    mesh.pop(KEY, None)
    if layer is None:
        return False
    bm.faces.layers.int.remove(layer)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    return True


def region_options(mesh: bpy.types.Mesh) -> FairOptions:
    """Return the options of the region; the defaults where they can't be read."""
    try:
        return FairOptions.parsed(mesh[OPTIONS])
    except (KeyError, TypeError, ValueError):  # none, or values of another version
        return FairOptions()


def region_key(mesh: bpy.types.Mesh) -> str:
    """Return the name of the shape key that the region is in; empty for the Basis, and without keys."""
    return str(mesh.get(KEY, ""))


def region_faces(mesh: bpy.types.Mesh) -> Ints | None:
    """Return the faces of the region of a mesh in edit mode, ascending; None where there is none."""
    bm = bmesh.from_edit_mesh(mesh)
    layer = bm.faces.layers.int.get(LAYER)
    if layer is None:
        return None
    return np.array([k for k, face in enumerate(bm.faces) if face[layer] and not face.hide], dtype=np.int64)


def has_region(mesh: bpy.types.Mesh) -> bool:
    """Tell at no cost whether a mesh in edit mode has a region."""
    return bmesh.from_edit_mesh(mesh).faces.layers.int.get(LAYER) is not None


def counts(mesh: bpy.types.Mesh) -> tuple[int, int, int]:
    bm = bmesh.from_edit_mesh(mesh)
    return len(bm.verts), len(bm.edges), len(bm.faces)


def corners(mesh: bpy.types.Mesh, faces: Ints) -> Ints:
    """Return the vertices of these faces one after the other."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.faces.ensure_lookup_table()
    bm.verts.index_update()
    table: Any = bm.faces
    chosen = map(table.__getitem__, faces.tolist())
    return np.fromiter(map(_index, chain.from_iterable(map(_verts, chosen))), dtype=np.int64)


def positions(mesh: bpy.types.Mesh, vertices: Ints) -> Floats:
    """Return the positions (k, 3) of some vertices (k,) of a mesh in edit mode."""
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    table: Any = bm.verts
    flat = chain.from_iterable(map(_co, map(table.__getitem__, vertices.tolist())))
    return np.fromiter(flat, dtype=np.float64, count=3 * len(vertices)).reshape(-1, 3)
