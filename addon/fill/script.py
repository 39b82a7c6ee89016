"""Filling for scripts: a mesh and its borders, without edit mode, operators or a context."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

import fairing

from ..arrays.border import Left
from ..arrays.places import as_indices, as_matrix
from ..fair.engine import Progress
from ..mesh import filled as filled_mesh
from ..mesh import mesh_io
from ..options.options import FairOptions
from ..options.other_options import FillOptions
from .filling import fill_borders as fill_chosen
from .holes import borders_at, chosen_borders
from .pieces import Filled
from .report import Added, is_written, refuse_unusable


@dataclass(frozen=True)
class Done:
    filled: Filled
    added: Added | None  # None: nothing was written
    notes: tuple[str, ...] = ()  # about borders that were left open


class Fills(list[fairing.FillResult]):
    """The `fairing` result for each surface; `left`: the holes that stay open, each with `vertices` and `reason`."""

    left: tuple[Left, ...] = ()


def fill_mesh(
    mesh: bpy.types.Mesh, vertices: Sequence[int] | None = None, *, matrix: Any = None, **properties: Any
) -> Fills:
    """Fill the holes of `mesh`, or join their boundaries, with the fair surface that continues their surroundings.

    vertices: one or more of each border that is meant, or a mask of all vertices; default: all holes, that is all
    borders but those around the outside of a sheet (`fairing.borders.outer_borders`).
    matrix: 4×4, to the space in which the surface is fair; default: the mesh's own.
    properties: those of `mesh.fair_fill`, with the same names and defaults.
    Returns the `fairing` result for each surface, in the space of `matrix`; the new faces come last in the mesh. What
    can't be filled stays open; `left` of the result lists it.
    Raises, where no surface can be written, fairing.MeshError (elements: vertices of `mesh`), ValueError (also where
    there is no border), fairing.SolverError, and NotUsable where a surface folds, passes through the mesh or is none,
    unless allow_folds=True; always TypeError for a property that does not exist, IndexError and MemoryError. The mesh
    is untouched then.
    """
    options = FillOptions.named(properties)
    done = fill_borders(mesh, vertices, matrix, options)
    refuse_unusable(mesh.name, done.filled, options)
    fills = Fills(piece.result for piece in done.filled.pieces)
    fills.left = done.filled.left
    return fills


def fill_borders(
    mesh: bpy.types.Mesh,
    vertices: Sequence[int] | None,
    matrix: Any,
    options: FillOptions,
    progress: Progress | None = None,
) -> Done:
    """Do the work of `fill_mesh`, with all its errors but NotUsable; what is not usable is not written."""
    mesh_io.check_new_faces(mesh_io.user_of(mesh))
    arrays = mesh_io.read_mesh(mesh, np.empty(0, dtype=np.int64), FairOptions())
    seeds = np.full(len(arrays.positions), vertices is None)
    if vertices is not None:
        seeds[as_indices("vertices", vertices, len(seeds))] = True
    found = borders_at(arrays, seeds)
    if not (found.loops or found.left):
        raise ValueError("There is no border to fill" if vertices is None else "None of the vertices is on a border")
    world = as_matrix(matrix)
    borders = chosen_borders(world, found, options, vertices is None)
    filled = fill_chosen(borders, world, options, progress)
    written = is_written([(mesh.name, filled)], options)
    return Done(filled, filled_mesh.add_to_mesh(mesh, filled) if written else None, borders.notes)
