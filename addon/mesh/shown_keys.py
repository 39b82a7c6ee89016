"""What the shape keys of an object add to its Basis where they are shown."""

from __future__ import annotations

import bpy
import numpy as np

from ..arrays.types import Floats
from .columns import column


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
