"""Feather: how much of the way each vertex goes, in a patch and the band around it. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from .arrays import Floats, Ints
from .options import FairOptions
from .region import MeshArrays, Patch, vertices_of


def refuse_options(options: FairOptions) -> None:
    """Raise ValueError for options that a band can't have."""
    for wrong, text in (
        (options.outline != "GIVEN", "Outline: Smooth moves vertices of the band: choose As Selected, or Feather 0"),
        (
            options.joins_curvature,
            "Join: Curvature holds the outline, which Feather moves: choose Tangent, or Feather 0",
        ),
    ):
        if wrong and options.feather > 0.0:
            raise ValueError(text)


def band_weights(mesh: MeshArrays, patch: Patch, vertices: Ints, outside: Ints, feather: float) -> Floats | None:
    """Return (q,) from 0 to 1 for the mesh's `vertices` (q,), the patch's first: 1 inside, less and less in the band.

    outside: (o, 3) triangles around the patch, in numbers of `vertices`; feather: a share of the patch's size.
    None where nothing lies around the patch. Pinned vertices and those of hidden faces have 0: these stay. The engine
    holds open borders itself.
    """
    if not np.isin(patch.triangles, outside).any():
        return None
    points = mesh.positions[vertices]
    weights = np.array(fairing.feather_weights(points, patch.triangles, outside, feather, fixed=patch.fixed))
    stays = mesh.pinned.copy()
    if mesh.hidden is not None:
        stays |= vertices_of(mesh, mesh.hidden)
    weights[stays[vertices]] = 0.0
    weights[patch.free] = 1.0
    return weights
