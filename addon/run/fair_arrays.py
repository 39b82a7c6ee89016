"""Arrays in, arrays out: the one path from a mesh to its fair positions, for operator, script and command line."""

from __future__ import annotations

from ..core.arrays import Floats
from ..core.engine import Progress
from ..core.options import FairOptions
from ..core.outcome import Fairing, outcome
from ..core.region import MeshArrays
from ..core.remeshing import remesh_arrays
from ..core.solve import Kept, solve


def fair_arrays(
    mesh: MeshArrays,
    matrix: Floats,
    options: FairOptions,
    progress: Progress | None = None,
    kept: Kept | None = None,
) -> Fairing:
    """Fair the patch of `mesh` in the space that the 4×4 `matrix` leads to; kept: what former calls left.

    Raises what `solve` and `outcome` do. `mesh` is never changed. Any thread will do.
    """
    if options.mesh == "NEW":
        return remesh_arrays(mesh, matrix, options, progress)
    solved = solve(mesh, matrix, options, progress, kept)
    return outcome(mesh, matrix, options, solved)
