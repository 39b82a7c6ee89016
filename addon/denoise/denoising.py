"""From selected faces to where their vertices lie without roughness. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.around import MovedKey
from ..arrays.region import MeshArrays, free_vertices, make_patch, to_local
from ..arrays.types import Floats, Ints
from ..fair.engine import Progress
from ..mirror.reflected import whole_of
from ..mirror.symmetry import mirrored
from ..options.other_options import DenoiseOptions
from ..verdict.verdict import GOOD, LOOK, Verdict
from ..words.words import said


@dataclass(frozen=True)
class Denoised:
    """New positions for the vertices that move, in the mesh's own coordinates."""

    vertices: Ints  # (k,) mesh indices, ascending
    positions: Floats  # (k, 3)
    largest: float  # distance that one of them moves, in world space
    verdict: Verdict
    warnings: tuple[str, ...]
    keys: tuple[MovedKey, ...] = ()


def denoise_arrays(
    mesh: MeshArrays, matrix: Floats, options: DenoiseOptions, progress: Progress | None = None
) -> Denoised:
    """Take the roughness from the patch; its boundary, open borders and edges marked sharp stay.

    Raises what `fairing.denoise` does, with mesh indices, and ValueError where the matrix has no inverse.
    """
    whole = whole_of(mesh)
    if whole is None:
        return _denoised(mesh, matrix, options, progress)
    found = _denoised(whole.mesh, matrix, options, progress)
    vertices, positions = whole.moved(found.vertices, found.positions)
    return replace(found, vertices=vertices, positions=positions)


def _denoised(mesh: MeshArrays, matrix: Floats, options: DenoiseOptions, progress: Progress | None) -> Denoised:
    with np.errstate(invalid="ignore", over="ignore"):  # what is not finite outside the patch
        world = mesh.transformed(matrix)
    free = free_vertices(mesh)
    finite = np.isfinite(world.positions).all(axis=1)
    touching = free[world.triangles].any(axis=1)
    triangles = world.triangles[finite[world.triangles].all(axis=1) | touching]
    known = np.zeros(len(free), dtype=bool)
    known[triangles] = True
    sharp = None if mesh.sharp is None else mesh.edges[mesh.sharp & known[mesh.edges].all(axis=1)]
    smooth = fairing.denoise(
        world.positions, triangles, size=options.size, amount=options.amount, fixed=np.flatnonzero(~free),
        edges=sharp, progress=progress,
    )  # fmt: skip
    moved = np.flatnonzero(free & (smooth != world.positions).any(axis=1))
    places, warnings = mesh.positions.copy(), tuple[str, ...]()
    places[moved] = to_local(smooth[moved], matrix)
    if mesh.mirror_x:
        patch = make_patch(mesh)
        places[patch.vertices], warnings = mirrored(mesh, patch, places[patch.vertices])
    distances = np.linalg.norm((places[moved] - mesh.positions[moved]) @ matrix[:3, :3].T, axis=1)
    verdict = Verdict(GOOD) if len(moved) else Verdict(LOOK, said("unmoved"))
    return Denoised(moved, places[moved], float(distances.max(initial=0.0)), verdict, warnings)
