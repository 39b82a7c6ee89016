"""Feather: the factor of each vertex in a patch and the band around it. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

import fairing

from ..arrays.around import joined_by_weight, staying
from ..arrays.places import numbers_in
from ..arrays.region import MeshArrays, Patch
from ..arrays.types import Floats, Ints
from ..options.options import FairOptions
from .boundary import hard_edges_of


@contextmanager
def naming_the_band(options: FairOptions) -> Iterator[None]:
    """Say why nothing holds the surface where a band reaches all around to the far side; raises ValueError then."""
    try:
        yield
    except fairing.MeshError as error:
        if error.diagnostic.code != "NO_BOUNDARY" or not options.moves_band:
            raise
        what = "Falloff" if options.falloff > 0.0 else "Vertex Group or Use Mask"
        raise ValueError(
            f"{what} reaches all around to the far side, so that nothing is left to hold the surface: choose less, "
            "or pin vertices"
        ) from error


def band_weights(mesh: MeshArrays, patch: Patch, vertices: Ints, outside: Ints, feather: float) -> Floats | None:
    """Return (q,) from 0 to 1 for the mesh's `vertices` (q,), the patch's first: 1 inside, less and less in the band.

    outside: (o, 3) triangles around the patch, in numbers of `vertices`; feather: a share of the patch's size, 0 where
    `mesh.parts` alone says how wide the band is. Where there are both, they are multiplied.
    None where all of the patch moves in full and nothing around it. Pinned vertices and those of hidden faces have
    0: these stay. The engine holds open borders itself. Raises ValueError where nothing would move.
    """
    parts = np.ones(len(vertices)) if mesh.parts is None else mesh.parts[vertices]
    weights = _faded(mesh, patch, vertices, outside, feather) * parts
    weights[staying(mesh)[vertices]] = 0.0
    weights[patch.free] = parts[patch.free]
    if not weights.any():
        raise ValueError("Vertex Group and Mask leave every vertex of the selection where it is: give some a weight")
    beyond = np.ones(len(vertices), dtype=bool)
    beyond[patch.free] = False
    return None if (weights[patch.free] == 1.0).all() and not weights[beyond].any() else weights


def _faded(mesh: MeshArrays, patch: Patch, vertices: Ints, outside: Ints, feather: float) -> Floats:
    """Return (q,) what the band does without `mesh.parts`: it fades out, or ends where nothing has a part any more."""
    if feather == 0.0:
        return np.asarray(joined_by_weight(mesh, patch)[vertices], dtype=np.float64)
    if not np.isin(patch.triangles, outside).any():
        return np.zeros(len(vertices))
    points = mesh.positions[vertices]
    creases = hard_edges_of(mesh, vertices, numbers_in(vertices, len(mesh.positions)))
    return np.array(
        fairing.feather_weights(points, patch.triangles, outside, feather, fixed=patch.fixed, creases=creases)
    )
