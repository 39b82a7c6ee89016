"""Fairing for scripts: a mesh and its faces, without edit mode, operators or a context."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import bpy

import fairing

from ..arrays.places import as_indices, as_matrix
from ..arrays.region import MeshArrays
from ..arrays.types import Floats
from ..mesh import mesh_io, remeshed
from ..options.options import FairOptions
from ..remesh.remeshing import Remeshed
from ..verdict.outcome import Fairing
from ..verdict.report import is_written
from ..verdict.verdict import NotUsable
from .engine import Progress
from .fair_arrays import fair_arrays


def fair_mesh(
    mesh: bpy.types.Mesh, /, faces: Sequence[int], *, matrix: Any = None, **properties: Any
) -> fairing.FairResult | fairing.RemeshResult:
    """Make the polygons `faces` of `mesh` the fair surface of their surroundings.

    faces: their numbers, or a mask of all polygons.
    matrix: 4×4, to the space in which the surface is fair; default: the mesh's own.
    properties: those of `mesh.fair_region`, with the same names and defaults. With remesh=True the faces are replaced
    by others, which come last in the mesh.
    Returns the `fairing` result for the patch: its vertices are those of the visible `faces`, in
    ascending order, in the space of `matrix`.
    Warns of properties that have no effect given the others.
    Raises fairing.MeshError (elements: vertices of `mesh`), ValueError, TypeError for a property that does not exist
    and for a value of another kind, IndexError, fairing.SolverError and MemoryError; NotUsable where the result folds,
    crosses itself or is none, unless allow_folds=True. The mesh is untouched then.
    """
    options = FairOptions.named(properties)
    for name in options.idle:
        warnings.warn(f"fair_mesh: {name} has no effect with these options", stacklevel=2)
    outcome = fair_faces(mesh, faces, matrix, options)
    if not is_written([outcome], options):
        raise NotUsable(outcome.verdict, outcome.result)
    return outcome.result


def fair_faces(
    mesh: bpy.types.Mesh,
    faces: Sequence[int],
    matrix: Any,
    options: FairOptions,
    progress: Progress | None = None,
) -> Fairing:
    """Do the work of `fair_mesh`, with all its errors but NotUsable; what is not usable is not written."""
    arrays, world = read(mesh, faces, matrix, options)
    outcome = fair_arrays(arrays, world, options, progress)
    if is_written([outcome], options):
        write(mesh, outcome)
    return outcome


def read(mesh: bpy.types.Mesh, faces: Sequence[int], matrix: Any, options: FairOptions) -> tuple[MeshArrays, Floats]:
    """Return the mesh with these faces selected, and the matrix as numbers; raises what `fair_mesh` does."""
    if options.remesh:
        mesh_io.check_new_faces(mesh_io.user_of(mesh))
    chosen = as_indices("faces", faces, len(mesh.polygons))
    arrays = mesh_io.read_mesh(mesh, chosen, options)
    return arrays, as_matrix(matrix)


def write(mesh: bpy.types.Mesh, outcome: Fairing) -> None:
    if isinstance(outcome, Remeshed):
        remeshed.write_mesh(mesh, outcome)
    else:
        mesh_io.write_mesh(mesh, outcome.vertices, outcome.positions)
