"""The main call, and repeated solves of one mesh."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments, checks
from fairing.options.checks import given
from fairing.options.groups import Boundary, Options
from fairing.results import FairResult, FloatArray, Progress
from fairing.solving import feather, surroundings

Preview = Callable[[FloatArray], object]


def fair(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    boundary: Boundary | npt.ArrayLike | None = None,
    options: Options | None = None,
    *,
    progress: Progress | None = None,
    preview: Preview | None = None,
    threads: int = 0,
    **named: Any,
) -> FairResult:
    """Replace the free vertices of a mesh by the fairest surface with the given boundary data.

    Solves Δ_B H = 0 (Schneider & Kobbelt 2001, eq. 4) for the positions of all vertices that are not fixed,
    with prescribed positions and normals at the fixed ones. The interior given does not matter, except for
    conformal weights without ``reference`` and for default normals. No argument is ever changed. Large arrays are not
    copied: they must stay as they are during the call.

    Parameters
    ----------
    vertices : (n, 3) float
        Positions, any unit.
    triangles : (m, 3) int
        Vertex indices, consistently wound.
    boundary : Boundary | (k,) int
        What is fixed (:class:`fairing.Boundary`), or the fixed vertices alone. Default: the mesh border.
    options : Options
        Which surface, and how it is found (:class:`fairing.Options`).
    progress : callable(fraction, stage) -> None | bool
        Called every 50 ms or so, by the calling thread, with the part done (0 … 1, never less than before) and what
        is being done. None or True goes on, False cancels; exceptions come out of the call.
    preview : callable(vertices) -> None
        Called once, by the calling thread, before the search begins: with the (n, 3) vertices of a first surface, which
        always exists and is finite. Of bi-Laplacian fills of the boundary, by the connectivity and by ``reference``, it
        is the one with the least bending energy, after two steps of its descent. Without ``detail``, and between the
        boundary that is given. Exceptions come out of the call.
    threads : int
        0: one for each core, eight at most. The result has the same bits for every number of threads.
    named
        Fields of the options by their names, in place of groups: ``equation="constant", bulge=0.1``; and ``fixed``,
        ``fixed_normals``, ``fixed_curvatures`` and ``outside`` for those of the boundary.

    Returns
    -------
    FairResult

    Raises
    ------
    MeshError
        The input can't be faired; ``code`` and ``elements`` say why and where.
    ValueError
        A shape or option is wrong; the message names the argument and what is accepted.
    Cancelled
        ``progress`` returned False.
    SolverError
        The numerics broke down.
    MemoryError
        There is not enough memory; on Linux a large run (100,000 free vertices) says so before it begins.
    """
    held, chosen = given(boundary, options, named)
    return solved(vertices, triangles, held, chosen, progress, threads, preview)


def solved(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    boundary: Boundary,
    chosen: Options,
    progress: Progress | None,
    threads: int,
    preview: Preview | None = None,
) -> FairResult:
    """What :func:`fair` does."""
    surface, skin, curves = chosen.surface, chosen.skin, chosen.curves
    points = arguments.floats("vertices", vertices)
    count = points.shape[0]
    faces = arguments.triangles_within(triangles, count)
    fixed, normals = arguments.boundary(boundary.vertices, boundary.normals)
    reference = chosen.layout.reference
    m0 = None if reference is None else arguments.floats("reference", reference, count)
    checks.faired_needs_fixed(curves.open_border, fixed)
    checks.callback(progress)
    engine = checks.engine_options(chosen, threads, count)
    joins = checks.continuity(surface.continuity, surface.equation, chosen.solving.method)
    around = surroundings.Surroundings.of(points, faces, fixed, boundary.outside)
    as_given = surroundings.Boundary(points, fixed, normals)
    if not joins and boundary.curvatures is not None:
        raise ValueError("fixed_curvatures: accepted with continuity 'G2' only")
    if joins:
        as_given = surroundings.with_curvatures(as_given, around, boundary.curvatures, boundary.continuity)

    def call(held: surroundings.Boundary) -> dict[str, Any]:
        return _core.fair(
            held.vertices, faces, held.fixed, held.normals, held.curvatures, m0, around.outside,
            engine, progress, preview,
        )  # fmt: skip

    fitted = arguments.choice("outline", surface.outline, checks.BOUNDARIES) == "mended"
    if fitted:
        surroundings.refuse_creases(curves.creases, around)
    refused = {"reference": m0 is not None, "outline": fitted, "continuity": joins}
    if feather.is_wanted(skin, refused, count):
        engine.detail = 1.0
        return FairResult(**feather.solve_feathered(call, as_given, around, skin, (threads, progress)))
    answer = surroundings.solve_fitted(call, as_given, faces, around) if fitted else call(as_given)
    return FairResult(**surroundings.with_join(answer, around))


_ANY_COUNT = int(np.iinfo(np.int32).max)
_OF_CONNECTIVITY = ("creases", "smooth_curves", "open_border")
_OF_ONE_SOLVE = ("outline", "reference", "feather", "weights", "start")


class Solver:
    """Fairs one mesh again and again while its boundary moves, each time from the last answer.

    Takes the triangles, the fixed vertices and the options of :func:`fairing.fair`, with the same meanings,
    defaults and errors; :meth:`solve` takes what may change. Kept between solves: the checked and cut
    connectivity, the weights λ while the reference stays the same, the factorisations, and each component's last
    answer. A small move of the boundary then costs a few iterations, without any factorisation.

    The first solve gives the bits of :func:`fairing.fair`, and so does each one that follows a changed number of
    vertices or coordinates that are not finite. Later ones give the same surface to the tolerance, whatever was
    solved before, where the data admit one surface; where they admit several, the one next to the last answer.
    A component is solved from its boundary alone, as by :func:`fairing.fair`, whenever

    - its last answer is not one to start from: not ``converged`` or not ``polished``, triangles flipped, more than a
      tenth of them poor (7 : 1 and beyond), or λ had to be given up for uniform ones;
    - its boundary, after the best rotation and scaling, has moved by more than 0.05 D, or a normal by more than 45°;
    - the iteration from the last answer is not at its end after a few steps, or ends in flipped triangles;
    - it has more than 50000 free vertices, or ``method`` is "paper".

    Where the equation has no surface, that of least variation is taken (``otherwise``). The solver then stays with it
    as long as the boundary moves by no more than these limits from one solve to the next, so that the shape does not
    jump while it is dragged; and it stays with the equation's own surface where its last answer led to one, however it
    grows. A larger move, or :meth:`change`, has the equation tried again.

    With ``detail`` the base meets its boundary as it is given: fairing.fair has a low-pass one where it knows the
    triangles outside.

    ``initial_residual`` is that of the surface that the solve started from. An error or a cancelled solve leaves the
    solver usable, with the answers that it had. One call at a time: another one meanwhile, from a second thread
    or from ``progress``, raises RuntimeError. Different solvers are independent of each other.
    """

    def __init__(
        self,
        triangles: npt.ArrayLike,
        *,
        fixed: npt.ArrayLike | None = None,
        options: Options | None = None,
        threads: int = 0,
        **named: Any,
    ) -> None:
        """Check and copy everything; nothing is solved yet. Raises what fairing.fair does for these arguments.

        How many vertices there are is known at the first :meth:`solve` only: indices that are too large, and vertices
        that ``inner_fairness`` ties to no fixed one, are refused there. So is everything about connectivity where the
        largest index is more than a hundred times the number of indices.
        """
        faces = arguments.integers("triangles", triangles, 3)
        self._fixed, _ = arguments.boundary(fixed, None)
        self._options, self._threads = (options or Options()).changed(**named), threads
        checks.faired_needs_fixed(self._options.curves.open_border, self._fixed)
        self._engine = _core.Solver(faces, self._fixed, self._checked(self._options, threads))

    def change(self, *, threads: int | None = None, **options: Any) -> None:
        """Give some options of the constructor (all that are not about connectivity) other values.

        The next answer is that of a new solver, whatever came before; only what was made of the connectivity is kept.
        Raises what the constructor does, TypeError for other names; nothing has changed then.
        """
        for name in options:
            if name in _OF_CONNECTIVITY:
                raise TypeError(f"{name!r} is no option that can be changed")
        wanted, count = self._options.changed(**options), self._threads if threads is None else threads
        self._engine.change(self._checked(wanted, count))
        self._options, self._threads = wanted, count

    @staticmethod
    def _checked(options: Options, threads: int) -> _core.Options:
        """The engine's options; how many vertices there are is known at the first solve."""
        for name in options.chosen:
            if name in _OF_ONE_SOLVE:
                raise TypeError(f"{name!r} is no option of a Solver")
        checked = checks.engine_options(options, threads, _ANY_COUNT)
        checks.continuity(options.surface.continuity, options.surface.equation, options.solving.method)
        return checked

    def solve(
        self,
        vertices: npt.ArrayLike,
        fixed_normals: npt.ArrayLike | None = None,
        reference: npt.ArrayLike | None = None,
        progress: Progress | None = None,
        fixed_curvatures: npt.ArrayLike | None = None,
        preview: Preview | None = None,
        continuity: npt.ArrayLike | None = None,
    ) -> FairResult:
        """Solve for these positions and normals; arguments, result and errors are those of fairing.fair.

        ``reference`` left out is ``vertices``, as there. Give the same one each time for weights that depend on
        it, or they are made anew, and factorised, whenever a vertex has moved. With continuity "G2"
        ``fixed_curvatures`` must be given; :func:`fairing.surrounding_normals` fits them. ``continuity`` says where
        along ``fixed`` they are met, "G2", and where the join is tangent only, "G1"; default: met everywhere.
        """
        points = arguments.floats("vertices", vertices)
        count = points.shape[0]
        if fixed_normals is not None and self._fixed is None:
            raise ValueError("fixed_normals: needs `fixed`, whose order it follows")
        _, given_normals = arguments.boundary(self._fixed, fixed_normals)
        curvatures = self._curvatures(fixed_curvatures, continuity)
        m0 = None if reference is None else arguments.floats("reference", reference, count)
        checks.layout_within(self._options.layout, count)
        callback = checks.callback(progress)
        return FairResult(**self._engine.solve(points, given_normals, curvatures, m0, callback, preview))

    def _curvatures(self, given: npt.ArrayLike | None, kinds: npt.ArrayLike | None) -> FloatArray | None:
        """Checked; needed for "G2" and refused without it."""
        wanted = self._options.surface.continuity
        if (wanted == "G2") != (given is not None):
            raise ValueError(
                f"fixed_curvatures: {'needed' if wanted == 'G2' else 'refused'} with continuity {wanted!r}"
            )
        if given is None:
            return None
        words = None if kinds is None else checks.checked(kinds, self._fixed)
        return checks.where_met(arguments.curvatures(given, self._fixed), words)
