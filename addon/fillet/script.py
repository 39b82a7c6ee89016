"""Fillets for scripts: a mesh and its edges, without edit mode, operators or a context."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np

import fairing

from ..arrays.places import as_indices, as_matrix
from ..fair.engine import Progress
from ..mesh import mesh_io, remeshed
from ..options.options import FairOptions
from ..options.other_options import FilletOptions
from ..verdict.verdict import UNUSABLE, NotUsable
from .rounding import Rounded, hard, round_arrays


def fillet_mesh(
    mesh: bpy.types.Mesh, edges: Sequence[int] | None = None, *, matrix: Any = None, **properties: Any
) -> fairing.results.FilletResult:
    """Round edges of `mesh`: within a width of them, faces are replaced by the fairest surface.

    edges: their numbers, or a mask of all edges; default: all hard edges.
    matrix: 4×4, to the space in which widths are measured; default: the mesh's own.
    properties: those of `mesh.fair_fillet`, with the same names and defaults.
    Returns the `fairing` result in the space of `matrix`; the new faces come last in the mesh.
    Raises fairing.MeshError (elements: vertices of `mesh`), ValueError, TypeError for a property that does not exist,
    IndexError, fairing.SolverError and MemoryError; NotUsable where the surface folds or is none. The mesh is untouched
    then.
    """
    outcome = fillet_edges(mesh, edges, matrix, FilletOptions.named(properties))
    if outcome.verdict.grade == UNUSABLE:
        raise NotUsable(outcome.verdict, outcome.result)
    return outcome.result


def fillet_edges(
    mesh: bpy.types.Mesh,
    edges: Sequence[int] | None,
    matrix: Any,
    options: FilletOptions,
    progress: Progress | None = None,
) -> Rounded:
    """Do the work of `fillet_mesh`, with all its errors but NotUsable; what is not usable is not written."""
    mesh_io.check_new_faces(mesh_io.user_of(mesh))
    reading = FairOptions(vertex_group=options.width_group)
    arrays = mesh_io.read_mesh(mesh, np.empty(0, dtype=np.int64), reading)
    world = as_matrix(matrix)
    if edges is None:
        seams = hard(arrays.transformed(world))
    else:
        seams = np.zeros(len(arrays.edges), dtype=bool)
        seams[as_indices("edges", edges, len(seams))] = True
    outcome = round_arrays(arrays, seams, world, options, progress)
    if outcome.verdict.grade != UNUSABLE:
        remeshed.write_mesh(mesh, outcome)
    return outcome
