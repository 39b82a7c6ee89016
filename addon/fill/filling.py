"""From border loops to the surfaces over them. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from ..arrays.border import left_by
from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Ints
from ..fair.engine import Progress, sub_range
from ..options.other_options import FillOptions
from .holes import Borders
from .job import Job
from .pieces import Filled


def fill(
    mesh: MeshArrays, matrix: Floats, loops: list[Ints], options: FillOptions, progress: Progress | None = None
) -> Filled:
    """Fill each loop of border_loops, or join all of them, in the space that the 4×4 `matrix` leads to.

    What is wrong with one loop stops no other. Raises the first MeshRefusal, BorderRefusal or fairing.SolverError where
    there is no surface at all; ValueError and fairing.Cancelled. `mesh` is never changed.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        job = Job.of(mesh, matrix, options)
    groups = [loops] if options.bridge else [[loop] for loop in loops]
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
    return Filled(pieces, tuple(left)).usable(options)


def fill_borders(borders: Borders, matrix: Floats, options: FillOptions, progress: Progress | None = None) -> Filled:
    """Fill chosen borders; see `fill`."""
    found = borders.whole.found(lambda mesh: fill(mesh, matrix, borders.loops, options, progress))
    return found.with_left(borders.left)
