"""The shape keys of an object other than its Basis: what they show, read and written one by one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.around import MovedKey
from ..arrays.types import Floats
from ..words.words import said
from .columns import column


def read_keys(obj: bpy.types.Object) -> dict[str, Floats]:
    """Return (n, 3) for each key but the Basis, as they will be when edit mode ends; none while another key is edited.

    Raises ValueError where a key is locked.
    """
    keys = obj.data.shape_keys
    if keys is None or obj.active_shape_key != keys.reference_key:
        return {}
    bm = bmesh.from_edit_mesh(obj.data)
    offsets = _offsets(bm, keys)
    found = {}
    for key in keys.key_blocks:
        if key == keys.reference_key:
            continue
        if key.lock_shape:
            raise ValueError(said("key_locked", name=key.name))
        places = _layer(bm, key)
        found[key.name] = places + offsets if _will_follow(keys, key) else places
    return found


def write_keys(obj: bpy.types.Object, moved: Sequence[MovedKey]) -> None:
    """Move vertices of shape keys; the Basis is where it goes already.

    When edit mode ends Blender adds to keys that depend on the Basis by how much that has moved.
    """
    keys, bm = obj.data.shape_keys, bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    offsets = _offsets(bm, keys) if moved else np.empty((0, 3))
    for key in moved:
        layer = bm.verts.layers.shape[key.name]
        places = key.positions
        if _will_follow(keys, keys.key_blocks[key.name]):
            places = places - offsets[key.vertices]
        for vertex, place in zip(key.vertices.tolist(), places.tolist(), strict=True):
            bm.verts[vertex][layer] = place


def _layer(bm: Any, key: Any) -> Floats:
    layer = bm.verts.layers.shape[key.name]
    return np.array([vertex[layer] for vertex in bm.verts])


def _offsets(bm: Any, keys: Any) -> Floats:
    """Return by how much the Basis has moved, (n, 3), since Blender has last looked."""
    return np.array([vertex.co for vertex in bm.verts]) - _layer(bm, keys.reference_key)


def _will_follow(keys: Any, key: Any) -> bool:
    return bool(keys.use_relative and follows(key, keys.reference_key))


def shown_offsets(obj: bpy.types.Object) -> Floats | None:
    """Return (n, 3) from the Basis to what is seen outside edit mode; None where that is the Basis, or it isn't edited.

    Vertex groups of keys don't count. With keys that are not relative, and while the mesh has other vertices than its
    keys, nothing is known.
    """
    keys = obj.data.shape_keys
    if keys is None or not keys.use_relative or obj.active_shape_key != keys.reference_key:
        return None
    offsets = np.zeros((len(keys.reference_key.data), 3))
    for key in keys.key_blocks:
        if key != keys.reference_key and not key.mute and key.value != 0.0:
            here, there = (column(block.data, "co", 3, np.float32) for block in (key.relative_key, key))
            offsets += key.value * (there.astype(np.float64) - here)
    return offsets if offsets.any() else None


def follows(block: bpy.types.ShapeKey, basis: bpy.types.ShapeKey) -> bool:
    """Return whether a chain of relative keys leads from the block to the basis."""
    seen = set()
    while block != basis and block.name not in seen:
        seen.add(block.name)
        block = block.relative_key
        if block == basis:
            return True
    return False
