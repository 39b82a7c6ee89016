"""Arrays in, arrays out: the one path from a mesh to its fair positions, for operator, script and command line."""

from __future__ import annotations

from dataclasses import replace

from ..arrays.region import MeshArrays
from ..arrays.types import Floats
from ..mirror.reflected import whole_of
from ..options.options import FairOptions
from ..remesh.remeshing import remesh_arrays
from ..verdict.outcome import Fairing, outcome
from ..verdict.verdict import UNUSABLE
from ..words.words import said
from .engine import Progress
from .held_curves import released
from .solve import Kept, solve


def fair_arrays(
    mesh: MeshArrays,
    matrix: Floats,
    options: FairOptions,
    progress: Progress | None = None,
    kept: Kept | None = None,
) -> Fairing:
    """Fair the patch of `mesh` in the space that the 4×4 `matrix` leads to; kept: what former calls left.

    Where edges are held for their angle alone and nothing usable comes out, they are let go. Raises what `solve` and
    `outcome` do. `mesh` is never changed. Any thread will do.
    """
    found = _faired(mesh, matrix, options, progress, kept)
    if mesh.held_by_angle is None:
        return found
    if found.verdict.grade != UNUSABLE:
        return replace(found, warnings=(said("edges_held"), *found.warnings))
    found = _faired(released(mesh), matrix, options, progress, kept)
    return replace(found, warnings=(said("edges_let_go"), *found.warnings))


def _faired(
    mesh: MeshArrays, matrix: Floats, options: FairOptions, progress: Progress | None, kept: Kept | None
) -> Fairing:
    if options.remesh:
        return remesh_arrays(mesh, matrix, options, progress)
    whole = whole_of(mesh)
    if whole is not None:
        return whole.half_of(_on_old_mesh(whole.mesh, matrix, options, progress, kept))
    return _on_old_mesh(mesh, matrix, options, progress, kept)


def _on_old_mesh(
    mesh: MeshArrays, matrix: Floats, options: FairOptions, progress: Progress | None, kept: Kept | None
) -> Fairing:
    return outcome(mesh, matrix, options, solve(mesh, matrix, options, progress, kept), progress)
