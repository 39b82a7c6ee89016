"""The tetrathing with the 500 vertices of Fig. 8a."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cases import Case, tetrathing_case
from thinning import Thinner, flip_to_delaunay, thin


def thinned_tetrathing(count: int) -> Case:
    """From 828 vertices by half-edge collapses on its fair surface; the circles stay."""
    case = tetrathing_case(times=2)
    surface = case.fair().vertices
    mesh = Thinner(surface, case.triangles, np.array_split(case.fixed, 6))
    thin(mesh, case.free.tolist(), np.ones(len(surface)), len(surface) - count)
    flip_to_delaunay(mesh, set(range(len(surface))))
    triangles = np.array([face for face in mesh.faces if face])
    used, local = np.unique(triangles, return_inverse=True)
    return replace(
        case, vertices=surface[used], triangles=local.reshape(-1, 3), fixed=np.searchsorted(used, case.fixed),
        reference=surface[used],
    )  # fmt: skip
