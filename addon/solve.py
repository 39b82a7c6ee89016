"""Arrays in, arrays out: the one path from a mesh to its fair positions, for all callers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

import fairing

from .arrays import Floats, Ints
from .boundary import prescribed_normals
from .options import FairOptions
from .region import MeshArrays, Patch, island_count, make_patch, outline_radius

Progress = Callable[[float, str], "bool | None"]


@dataclass(frozen=True)
class Fairing:
    """New positions for the free vertices, in the mesh's own coordinates."""

    vertices: Ints  # (k,) mesh indices, ascending
    positions: Floats  # (k, 3)
    result: fairing.FairResult  # for the patch, in world space
    warnings: tuple[str, ...]


def fair_arrays(mesh: MeshArrays, matrix: Floats, options: FairOptions, progress: Progress | None = None) -> Fairing:
    """Fair the patch of `mesh` in the space that the 4×4 `matrix` leads to.

    Raises fairing.MeshError (its `elements` are vertices of `mesh` here), ValueError,
    fairing.SolverError and fairing.Cancelled. `mesh` is never changed.
    """
    # What is not finite outside the patch is none of our business, and the engine looks inside.
    with np.errstate(invalid="ignore", over="ignore"):
        world = mesh.transformed(matrix)
        # Conformal weights belong to the present shape, and so do its triangles.
        patch = make_patch(world, even=options.inner_fairness != "CONFORMAL")
        normals, warnings = prescribed_normals(world, patch, options.boundary_normals)
    with _mesh_indices(patch):
        result = fairing.fair(
            world.positions[patch.vertices],
            patch.triangles,
            fixed=patch.fixed,
            fixed_normals=normals,
            neighbours=patch.neighbours,
            load=_load(world, patch, options),
            progress=progress,
            **options.engine_arguments(),
        )
    free = patch.vertices[patch.free]
    fair = _to_local(result.vertices[patch.free], matrix)
    original = mesh.positions[free]
    # Blended in local space, so that factor 0 gives the very bits that were there.
    positions = original + options.factor * (fair - original)
    return Fairing(free, positions, result, warnings + _texts(result.warnings))


@contextmanager
def _mesh_indices(patch: Patch) -> Iterator[None]:
    """Make the elements of a MeshError vertices of the whole mesh instead of the patch's."""
    try:
        yield
    except fairing.MeshError as error:
        elements = mesh_vertices(error.diagnostic, patch).astype(np.int32)
        diagnostic = replace(error.diagnostic, elements=elements, kind="vertex")
        raise fairing.MeshError(diagnostic) from error


def mesh_vertices(diagnostic: fairing.Diagnostic, patch: Patch) -> Ints:
    """Return the mesh vertices that an error or warning of the engine is about, ascending.

    Edges come from the engine as pairs of vertices; triangles give their corners.
    """
    elements: Ints = diagnostic.elements.astype(np.int64)
    if diagnostic.kind == "triangle":
        elements = patch.triangles[elements].ravel()
    vertices: Ints = patch.vertices[np.unique(elements)]
    return vertices


def _load(world: MeshArrays, patch: Patch, options: FairOptions) -> float:
    """Return the engine's load, in length⁻³: 8 bulge / a³ with a the outline's RMS radius."""
    if options.equation != "CONSTANT" or options.bulge == 0.0:
        return 0.0
    if island_count(patch) > 1:
        raise ValueError("bulge: fair one island at a time, each has a radius of its own")
    return 8.0 * options.bulge / outline_radius(patch, world.positions) ** 3


def _to_local(positions: Floats, matrix: Floats) -> Floats:
    """Take world positions (k, 3) back; raises SolverError rather than pass on a NaN."""
    local: Floats = np.linalg.solve(matrix[:3, :3], (positions - matrix[:3, 3]).T).T
    if not np.isfinite(local).all():
        raise fairing.SolverError("The solution is not finite; the mesh was left as it was")
    return local


def _texts(diagnostics: tuple[fairing.Diagnostic, ...]) -> tuple[str, ...]:
    return tuple(str(diagnostic) for diagnostic in diagnostics)
