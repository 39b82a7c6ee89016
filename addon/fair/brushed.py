"""How much of each vertex a brush has painted. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from ..arrays.types import Floats

INNER = 0.5  # of the radius, within which all is painted


def falloff(shares: Floats) -> Floats:
    """Return weights (k,) for distances (k,) as shares of the radius: 1 within INNER, 0 from 1 on, smooth between."""
    left = np.clip((1.0 - shares) / (1.0 - INNER), 0.0, 1.0)
    weights: Floats = left * left * (3.0 - 2.0 * left)
    return weights


def paint(weights: Floats, positions: Floats, place: Floats, radius: float) -> None:
    """Raise the weights (n,) of the vertices at `positions` (n, 3) within the radius of a place (3,)."""
    near = np.flatnonzero(np.abs(positions[:, 0] - place[0]) < radius)
    shares = np.linalg.norm(positions[near] - place, axis=1) / radius
    weights[near] = np.maximum(weights[near], falloff(shares))
