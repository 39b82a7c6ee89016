"""Where the free vertices go, and what that is worth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import fairing

from . import quality
from .arrays import Floats, Ints
from .engine import islands
from .quality import Quality
from .region import MeshArrays, Patch, to_local
from .solve import Solved
from .symmetry import mirror_map, symmetrised


@dataclass(frozen=True)
class Fairing:
    """New positions for the free vertices, in the mesh's own coordinates, and what they are worth."""

    vertices: Ints  # (k,) mesh indices, ascending
    positions: Floats  # (k, 3)
    result: fairing.FairResult  # for the patch, in world space
    warnings: tuple[str, ...]
    before: Quality
    after: Quality
    distortion: float  # area-weighted mean of the conformal distortion − 1
    curvature: tuple[float, float]  # largest |H| inside and on the outline, in 1/length


def outcome(
    mesh: MeshArrays, matrix: Floats, factor: float, solved: Solved, crossings: Callable[[Floats, Ints], int]
) -> Fairing:
    """Blend the answer with the mesh that it is for, and measure both.

    crossings: counts the pairs of triangles that run into each other (positions (n, 3), triangles (m, 3)).
    Raises fairing.SolverError where the answer is not finite in the mesh's own coordinates.
    """
    patch, result = solved.problem.patch, solved.result
    fair, warnings = _mirrored(mesh, patch, to_local(result.vertices, matrix))
    free = patch.vertices[patch.free]
    original = mesh.positions[free]
    # Blended in local space, so that factor 0 gives the very bits that were there.
    blended = original + factor * (fair[patch.free] - original)
    positions: Floats = fair[patch.free] if factor == 1.0 else blended
    before = solved.problem.points
    after = before.copy()
    after[patch.free] = positions @ matrix[:3, :3].T + matrix[:3, 3]
    clear = factor == 1.0 and not mesh.mirror_x and _is_clear(patch, result)
    quality_before, quality_after = quality.compare((before, after), patch.triangles, clear, crossings)
    return Fairing(
        vertices=free,
        positions=positions,
        result=result,
        warnings=solved.warnings + warnings,
        before=quality_before,
        after=quality_after,
        distortion=quality.texture_distortion(before, after, patch.triangles),
        curvature=_largest_curvatures(patch, result),
    )


def _is_clear(patch: Patch, result: fairing.FairResult) -> bool:
    """Tell whether the engine, which looks at each piece, has found that no triangle passes through another."""
    found = any(diagnostic.code == "SELF_INTERSECTION" for diagnostic in result.warnings)
    return not found and islands(patch) <= 1


def _mirrored(mesh: MeshArrays, patch: Patch, fair: Floats) -> tuple[Floats, tuple[str, ...]]:
    """Make the local positions (p, 3) symmetric where the mesh asks for that."""
    if not mesh.mirror_x:
        return fair, ()
    image = mirror_map(mesh, patch)
    if image is None:
        return fair, ("X mirror is on, but the selection is not symmetric: it was faired as it is",)
    return symmetrised(fair, image), ()


def _largest_curvatures(patch: Patch, result: fairing.FairResult) -> tuple[float, float]:
    sizes = np.abs(result.mean_curvature)
    return float(sizes[patch.free].max(initial=0.0)), float(sizes[patch.outline].max(initial=0.0))
