"""What all pictures of new surfaces have in common."""

from __future__ import annotations

from typing import Any

import numpy as np

from holes import FloatArray

TILE = 210
AROUND, NEW = (0.9, 0.9, 0.9), (0.5, 0.75, 1.0)


def eye_of(patch: Any) -> FloatArray:
    """Aslant over the outline."""
    mean = patch.normals.mean(axis=0) + 1e-3
    across = np.cross(mean, [0.3, 0.5, 0.8])
    return np.asarray(mean / np.linalg.norm(mean) + 0.8 * across / np.linalg.norm(across))


def reach_of(patch: Any) -> float:
    """Half-width of a window that shows the outline."""
    rim = patch.vertices[patch.fixed]
    return 1.2 * float(np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())
