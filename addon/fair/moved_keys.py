"""Shape keys that are faired with their Basis. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays.around import nearby
from ..arrays.region import MeshArrays, vertices_of
from ..arrays.types import Floats, Ints

SAME = 1e-6  # of the selection's size: offsets that differ by less are those of a key that only moves it


@dataclass(frozen=True)
class MovedKey:
    """New positions for vertices (k,) of one shape key, in the mesh's own coordinates."""

    name: str
    vertices: Ints
    positions: Floats  # (k, 3)


def is_bent(mesh: MeshArrays, positions: Floats) -> bool:
    """Return whether a key with positions (n, 3) bends the patch or the faces around it, rather than move them."""
    inside = vertices_of(mesh, mesh.in_patch)
    touched = np.unique(np.concatenate([np.flatnonzero(inside), nearby(mesh.triangles, inside).ravel()]))
    offsets = positions[touched] - mesh.positions[touched]
    return bool(np.ptp(offsets, axis=0).max() > SAME * np.ptp(mesh.positions[inside], axis=0).max())
