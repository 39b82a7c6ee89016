"""The shape keys of an object in edit mode, beside its Basis: read and written one by one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bmesh
import bpy
import numpy as np

from ..arrays.types import Floats
from ..fair.moved_keys import MovedKey
from ..words.words import said
from .mesh_io import follows


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
