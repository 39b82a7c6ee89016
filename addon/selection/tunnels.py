"""Tunnels and handles in a selection, which no fair surface is rid of. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from ..arrays.region import Patch
from ..arrays.types import Ints
from ..words.words import said


def tunnel_hint(patch: Patch) -> tuple[str, ...]:
    """Return a sentence on the tunnels of the patch, which may be why its surface is no good; none without them."""
    pieces = fairing.components(patch.triangles, fixed=patch.fixed)
    count = sum(tunnels(patch.triangles[pieces == piece]) for piece in range(int(pieces.max(initial=-1)) + 1))
    return (said("tunnels", n=count),) if count else ()


def tunnels(triangles: Ints) -> int:
    """Count the tunnels of connected triangles (m, 3): the genus, by Euler's formula.

    Where their border touches itself in a vertex, it counts as cut there.
    """
    edges, _ = fairing.edges_with_uses(triangles)
    loops = fairing.boundary_loops(triangles)
    on_border = sum(len(loop) for loop in loops)
    inner = len(np.setdiff1d(triangles, np.concatenate([np.empty(0, dtype=np.int64), *loops])))
    return (2 - len(loops) - (inner + on_border - len(edges) + len(triangles))) // 2
