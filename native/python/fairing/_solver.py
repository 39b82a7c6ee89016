"""Repeated solves of one mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _options, _parts
from fairing._fair import Preview, Progress
from fairing._groups import Options
from fairing._types import FairResult, FloatArray

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

        How many vertices there are is known at the first :meth:`solve` only: indices that are too large, and free
        vertices without a row in ``inner_fairness``, are refused there. So is everything about connectivity where the
        largest index is more than a hundred times the number of indices.
        """
        faces = _arguments.integers("triangles", triangles, 3)
        self._fixed, _ = _arguments.boundary(fixed, None)
        self._options, self._threads = (options or Options()).changed(**named), threads
        _options.faired_needs_fixed(self._options.curves.open_border, self._fixed)
        self._engine = _core.Solver(faces, self._fixed, self._checked(self._options, threads))

    def change(self, *, threads: int | None = None, **options: Any) -> None:
        """Give some options of the constructor (all that are not about connectivity) other values.

        The next solve starts from the last answer all the same, which is worth it for another load, λ or tolerance,
        and often for another equation. Raises what the constructor does, TypeError for other names; nothing has
        changed then.
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
        checked = _options.engine_options(options, threads, _ANY_COUNT)
        _options.continuity(options.surface.continuity, options.surface.equation, options.solving.method)
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
        points = _arguments.floats("vertices", vertices)
        count = points.shape[0]
        if fixed_normals is not None and self._fixed is None:
            raise ValueError("fixed_normals: needs `fixed`, whose order it follows")
        _, given_normals = _arguments.boundary(self._fixed, fixed_normals)
        curvatures = self._curvatures(fixed_curvatures, continuity)
        m0 = None if reference is None else _arguments.floats("reference", reference, count)
        _options.layout_within(self._options.layout, count)
        callback = _options.callback(progress)
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
        words = None if kinds is None else _parts.checked(kinds, self._fixed)
        return _parts.where_met(_arguments.curvatures(given, self._fixed), words)
