"""The surface of a shape key over new faces: faired from the key's own surroundings. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from ..arrays.region import to_local
from ..arrays.types import Floats, Ints

MOST_VERTICES = 20_000  # new ones, times keys that bend the boundary: .4 s
_MOST_STEPS = 40
_SAME = 1e-6  # of the boundary's size: offsets that differ by less are those of a key that only moves
_SOLVED = ("harmonic", "minimal_energy", "least_variation")
_WRONG = {"FLIPPED_TRIANGLES", "SELF_INTERSECTION"}


@dataclass(frozen=True)
class Surroundings:
    """What lies around a new surface: r vertices of its boundary first, then others."""

    vertices: Ints  # (q,) of the mesh
    triangles: Ints  # (o, 3) in numbers of these, wound so that outside is outside
    matrix: Floats  # (4, 4) to the space in which surfaces are fair

    def world(self, positions: Floats) -> Floats:
        """Take positions (n, 3) there."""
        result: Floats = positions @ self.matrix[:3, :3].T + self.matrix[:3, 3]
        return result


@dataclass(frozen=True)
class NewSurface:
    """Faces over r vertices of a boundary and k new ones."""

    points: Floats  # (r + k, 3) in world space
    triangles: Ints  # (m, 3), wound so that outside is outside
    equation: str  # that holds


def key_surfaces(
    surface: NewSurface, around: Surroundings, places: list[Floats], carried: list[Floats]
) -> list[Floats | None]:
    """Return (k, 3) for each shape key: where it has the new vertices, in the mesh's own coordinates.

    places: (q, 3) of `around.vertices` in each key, carried: (k, 3) where its offsets, carried over, lead. None where
    these stay: where a key moves its surroundings as a whole or has no surface of the same kind, and in large meshes.
    """
    count = len(carried[0]) if carried else 0
    there = [around.world(each) for each in places]
    bent = [_is_bent(surface.points[: len(surface.points) - count], each) for each in there]
    if surface.equation not in _SOLVED or sum(bent) * count > MOST_VERTICES:
        return [None] * len(places)
    return [
        _faired(surface, around, key, around.world(start)) if is_bent else None
        for is_bent, key, start in zip(bent, there, carried, strict=True)
    ]


def _is_bent(rim: Floats, there: Floats) -> bool:
    """Whether the offsets of a boundary's vertices differ from each other; `there` begins with where they are."""
    offsets = there[: len(rim)] - rim
    return bool(np.isfinite(there).all() and np.ptp(offsets, axis=0).max() > _SAME * np.ptp(rim, axis=0).max())


def _faired(surface: NewSurface, around: Surroundings, there: Floats, start: Floats) -> Floats | None:
    rim = np.arange(len(surface.points) - len(start))
    normals = fairing.surrounding_normals(there, around.triangles, rim).normals
    if not (np.linalg.norm(normals, axis=1) > 0.0).all():
        return None
    try:
        options = fairing.Options(
            fairing.Surface(surface.equation, otherwise="stop"),
            fairing.Layout("conformal", reference=surface.points),
            solving=fairing.Solving(start="given", max_iterations=_MOST_STEPS),
        )
        points = np.concatenate([there[rim], start])
        found = fairing.fair(points, surface.triangles, fairing.Boundary(rim, normals), options)
    except (fairing.MeshError, fairing.SolverError):
        return None
    if not found.converged or {warning.code for warning in found.warnings} & _WRONG:
        return None
    return to_local(found.vertices[len(rim) :], around.matrix)
