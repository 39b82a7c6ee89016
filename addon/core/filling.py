"""From border loops to the surfaces over them. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

import fairing

from .arrays import Floats, Ints
from .border import left_by
from .engine import Progress, sub_range
from .fill_job import Job
from .fill_pieces import Filled, FillOptions, Piece
from .halves import Half
from .islands import with_islands
from .region import MeshArrays
from .sentences import in_numbers_of
from .subdivided import Subdivided, with_subdivided_loops


def fill(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None = None,
    halves: Sequence[Half] = (),
) -> Filled:  # fmt: skip
    """Fill each loop of border_loops, or join all of them, in the space that the 4×4 `matrix` leads to; and halves.

    What is wrong with one loop stops no other. Raises the first MeshRefusal, BorderRefusal or fairing.SolverError where
    there is no surface at all; ValueError and fairing.Cancelled. `mesh` is never changed.
    """
    if options.subdivide_boundary:
        return _subdivided(mesh, matrix, loops, options, progress, halves)
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        job = Job.of(mesh, matrix, options)
    groups = _groups(job.world, loops, options)
    made = job.small(groups)
    pieces, errors, left = [], [], []
    count = len(groups) + len(halves)
    for i in range(count):
        part = sub_range(progress, i / count, (i + 1) / count)
        vertices = np.concatenate(groups[i]) if i < len(groups) else halves[i - len(groups)].chain
        try:
            if i < len(groups):
                pieces.append(made[i] if i in made else job.whole(mesh, groups[i], part))
            else:
                pieces.append(job.half(mesh, halves[i - len(groups)], part))
        except (ValueError, fairing.SolverError) as error:
            errors.append(error)
            left.append(left_by(error, np.unique(vertices)))
    if errors and not pieces:
        raise errors[0]
    return Filled(pieces, tuple(left)).settled(options)


def _subdivided(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None,
    halves: Sequence[Half],
) -> Filled:  # fmt: skip
    """Fill with boundaries whose long edges are parted, those alone over which there is a surface then.

    Edges across mirror planes stay whole.
    """
    whole = replace(options, subdivide_boundary=False)
    with np.errstate(invalid="ignore", over="ignore"):
        world = mesh.transformed(matrix)
    parted = with_subdivided_loops(mesh, world.positions, _groups(world, loops, options), options.spacing)
    if not len(parted.ends) or halves:
        return fill(mesh, matrix, loops, whole, progress, halves)
    fine = replace(whole, spacing=max(1.0, options.spacing))  # their edges are as long as wanted now
    with in_numbers_of(parted.named):
        found = fill(parted.mesh, matrix, [parted.along(loop) for loop in loops], fine, progress)
    pieces = [_with_old_spots(piece, parted) for piece in found.pieces]
    left = tuple(replace(each, vertices=np.unique(parted.named(each.vertices)), spots=parted.named(each.spots))
                 for each in found.left)  # fmt: skip
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
