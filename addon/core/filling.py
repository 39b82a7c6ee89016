"""From border loops to the surfaces over them. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from .arrays import Floats, Ints
from .border import left_by
from .engine import Progress, sub_range
from .fill_job import Job
from .fill_pieces import Filled, FillOptions, Piece
from .holes import Borders
from .islands import with_islands
from .region import MeshArrays
from .sentences import in_numbers_of
from .subdivided import Subdivided, with_subdivided_loops


def fill(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None = None
) -> Filled:
    """Fill each loop of border_loops, or join all of them, in the space that the 4×4 `matrix` leads to.

    What is wrong with one loop stops no other. Raises the first MeshRefusal, BorderRefusal or fairing.SolverError where
    there is no surface at all; ValueError and fairing.Cancelled. `mesh` is never changed.
    """
    if options.subdivide_boundary:
        return _subdivided(mesh, matrix, loops, options, progress)
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        job = Job.of(mesh, matrix, options)
    groups = _groups(job.world, loops, options)
    made = job.together(groups, progress)
    pieces, errors, left = [], [], []
    for i, group in enumerate(groups):
        part = sub_range(progress, max(i, len(made)) / len(groups), max(i + 1, len(made)) / len(groups))
        try:
            pieces.append(made[i] if i in made else job.piece(group, part))
        except (ValueError, fairing.SolverError) as error:
            errors.append(error)
            left.append(left_by(error, np.unique(np.concatenate(group))))
    if errors and not pieces:
        raise errors[0]
    return Filled(pieces, tuple(left)).settled(options)


def fill_borders(borders: Borders, matrix: Floats, options: FillOptions, progress: Progress | None = None) -> Filled:
    """Fill chosen borders; see `fill`."""
    found = borders.whole.found(lambda mesh: fill(mesh, matrix, borders.loops, options, progress))
    return found.with_left(borders.left)


def _subdivided(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None
) -> Filled:
    """Fill with boundaries whose long edges are parted, those alone over which there is a surface then."""
    whole = replace(options, subdivide_boundary=False)
    with np.errstate(invalid="ignore", over="ignore"):
        world = mesh.transformed(matrix)
    parted = with_subdivided_loops(mesh, world.positions, _groups(world, loops, options), options.spacing)
    if not len(parted.ends):
        return fill(mesh, matrix, loops, whole, progress)
    fine = replace(whole, spacing=max(1.0, options.spacing))  # their edges are as long as wanted now
    with in_numbers_of(parted.named):
        found = fill(parted.mesh, matrix, [parted.along(loop) for loop in loops], fine, progress)
    pieces = [_with_old_spots(piece, parted) for piece in found.pieces]
    left = tuple(each.named(parted.named) for each in found.left)
    if not left:
        return replace(found, pieces=pieces, parted=parted)
    stays = np.unique(np.concatenate([each.vertices for each in left]))
    others = [loop for loop in loops if not np.isin(loop, stays).all()]
    return fill(mesh, matrix, others, options, progress).with_left(left)


def _with_old_spots(piece: Piece, parted: Subdivided) -> Piece:
    spots = parted.named(piece.verdict.spots)
    return replace(piece, verdict=replace(piece.verdict, spots=spots[np.sort(np.unique(spots, return_index=True)[1])]))


def _groups(world: MeshArrays, loops: list[Ints], options: FillOptions) -> list[list[Ints]]:
    """Return the loops that one surface joins each."""
    if options.bridge or not options.islands:
        return [loops] if options.bridge else [[loop] for loop in loops]
    return [[loops[k] for k in numbers] for numbers in with_islands(world, loops)]
