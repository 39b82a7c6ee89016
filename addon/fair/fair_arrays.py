"""Arrays in, arrays out: the one path from a mesh to its fair positions, for operator, script and command line."""

from __future__ import annotations

from dataclasses import replace

from ..arrays.around import MovedKey, is_bent
from ..arrays.region import MeshArrays
from ..arrays.types import Floats
from ..mirror.reflected import whole_of
from ..options.options import FairOptions
from ..remesh.remeshing import remesh_arrays
from ..verdict.outcome import Fairing, outcome
from ..verdict.verdict import GRADES, UNUSABLE
from ..words.words import said
from .engine import REFUSALS, Progress, sub_range
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


def fair_all_keys(
    mesh: MeshArrays, matrix: Floats, options: FairOptions, progress: Progress | None, kept: Kept | None
) -> Fairing:
    """Fair the patch as `fair_arrays` does, and that of every key that bends it; the others follow the Basis.

    A key without a usable surface follows, too, which a warning says. The verdict is the worst. Raises what
    `fair_arrays` does for the Basis.
    """
    bent = {name: positions for name, positions in mesh.keys.items() if is_bent(mesh, positions)}
    share = 1.0 / (1 + len(bent))
    found = fair_arrays(mesh, matrix, options, sub_range(progress, 0.0, share), kept)
    for k, (name, positions) in enumerate(bent.items(), 1):
        part = sub_range(progress, k * share, (k + 1) * share)
        try:
            own = fair_arrays(replace(mesh, positions=positions, keys={}), matrix, options, part)
        except REFUSALS as cause:
            found = replace(found, warnings=(*found.warnings, said("key_follows", name=name, reason=str(cause))))
            continue
        found = _with_key(found, name, own, options)
    return found


def _with_key(found: Fairing, name: str, own: Fairing, options: FairOptions) -> Fairing:
    verdict = own.verdict
    if verdict.grade == UNUSABLE and not options.allow_folds:
        return replace(found, warnings=(*found.warnings, said("key_follows", name=name, reason=verdict.reason)))
    if GRADES.index(verdict.grade) > GRADES.index(found.verdict.grade):
        found = replace(found, verdict=replace(verdict, reason=said("of_key", name=name, reason=verdict.reason)))
    return replace(found, keys=(*found.keys, MovedKey(name, own.vertices, own.positions)))
