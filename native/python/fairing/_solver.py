"""Repeated solves of one mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _options, _paper, _parts
from fairing._fair import Preview, Progress
from fairing._paper import PaperOptions
from fairing._types import FairResult, FloatArray, IntArray

_ANY_COUNT = int(np.iinfo(np.int32).max)
_SHARED = (
    "equation", "otherwise", "load", "bulge", "normals", "tolerance", "max_iterations", "threads", "detail",
    "detail_size", "pin_radius",
)  # fmt: skip
_CURVES = ("creases", "smooth_curves", "open_border")
_CHANGEABLE = (*_SHARED, "inner_fairness", "neighbours", "method", "levels", "paper", "continuity")


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
        equation: str = "harmonic",
        otherwise: str = "least_variation",
        load: float = 0.0,
        bulge: float = 0.0,
        inner_fairness: Any = "uniform",
        neighbours: npt.ArrayLike | None = None,
        method: str = "global",
        levels: int = 0,
        tolerance: float = 1e-6,
        max_iterations: int = 200,
        normals: str = "fitted",
        threads: int = 0,
        paper: PaperOptions | None = None,
        detail: float = 0.0,
        detail_size: float = 0.0,
        continuity: str = "G1",
        creases: npt.ArrayLike | None = None,
        smooth_curves: npt.ArrayLike | None = None,
        open_border: str = "held",
        pin_radius: float = 0.1,
    ) -> None:
        """Check and copy everything; nothing is solved yet. Raises what fairing.fair does for these arguments.

        How many vertices there are is known at the first :meth:`solve` only: indices that are too large, and free
        vertices without a row in ``inner_fairness``, are refused there. So is everything about connectivity where the
        largest index is more than a hundred times the number of indices.
        """
        given = dict(locals())
        faces = _arguments.integers("triangles", triangles, 3)
        self._fixed, _ = _arguments.boundary(fixed, None)
        _options.faired_needs_fixed(open_border, self._fixed)
        self._curves = {name: given[name] for name in _CURVES}
        self._options = {name: given[name] for name in _CHANGEABLE}
        self._neighbours, self._weights, options = self._checked(self._options)
        self._engine = _core.Solver(faces, self._fixed, self._neighbours, self._weights, options)

    def change(self, **options: Any) -> None:
        """Give some options of the constructor (all that are not about connectivity) other values.

        The next solve starts from the last answer all the same, which is worth it for another load, λ or tolerance,
        and often for another equation. Raises what the constructor does, TypeError for other names; nothing has
        changed then.
        """
        unknown = set(options) - set(_CHANGEABLE)
        if unknown:
            raise TypeError(f"{min(unknown)!r} is no option that can be changed")
        wanted = {**self._options, **options}
        neighbours, weights, checked = self._checked(wanted)
        self._engine.change(neighbours, weights, checked)
        self._options, self._neighbours, self._weights = wanted, neighbours, weights

    def _checked(
        self,
        options: dict[str, Any],
    ) -> tuple[IntArray | None, FloatArray | None, tuple[_core.Options, _core.PaperOptions]]:
        """Edges, λ by rows, and the engine's options; how many vertices there are is known at the first solve."""
        edges = _options.neighbour_edges(options["neighbours"], _ANY_COUNT)
        method = _arguments.choice("method", options["method"], _options.METHODS)
        _options.continuity(options["continuity"], options["equation"], method)
        kind, weights = _options.inner_fairness(options["inner_fairness"], _ANY_COUNT)
        paper = _paper.engine_options(method, options["levels"], options["paper"])
        shared = {name: options[name] for name in _SHARED} | self._curves
        return edges, weights, (_options.engine_options(fairness=kind, method=method, **shared), paper)

    def solve(
        self,
        vertices: npt.ArrayLike,
        fixed_normals: npt.ArrayLike | None = None,
        reference: npt.ArrayLike | None = None,
        progress: Progress | None = None,
        fixed_curvatures: npt.ArrayLike | None = None,
        preview: Preview | None = None,
        continuity: npt.ArrayLike | None = None,
        tension: npt.ArrayLike | None = None,
    ) -> FairResult:
        """Solve for these positions and normals; arguments, result and errors are those of fairing.fair.

        ``reference`` left out is ``vertices``, as there. Give the same one each time for weights that depend on
        it, or they are made anew, and factorised, whenever a vertex has moved. With continuity "G2"
        ``fixed_curvatures`` must be given; :func:`fairing.surrounding_normals` fits them. ``continuity`` says where
        along ``fixed`` they are met, "G2", and where the join is tangent only, "G1"; default: met everywhere.
        ``tension`` is that of :class:`fairing.Boundary`.
        """
        points = _arguments.floats("vertices", vertices)
        count = points.shape[0]
        if fixed_normals is not None and self._fixed is None:
            raise ValueError("fixed_normals: needs `fixed`, whose order it follows")
        _, given_normals = _arguments.boundary(self._fixed, fixed_normals)
        curvatures = self._curvatures(fixed_curvatures, continuity)
        m0 = None if reference is None else _arguments.floats("reference", reference, count)
        if self._neighbours is not None:
            _arguments.indices_within("neighbours", self._neighbours, count)
        if self._weights is not None:
            _arguments.indices_within("inner_fairness", self._weights[:, :2].astype(np.int32), count)
        callback = _options.callback(progress)
        tensions = None if tension is None else _arguments.tensions(tension, self._fixed)
        return FairResult(**self._engine.solve(points, given_normals, curvatures, tensions, m0, callback, preview))

    def _curvatures(self, given: npt.ArrayLike | None, kinds: npt.ArrayLike | None) -> FloatArray | None:
        """Checked; needed for "G2" and refused without it."""
        joins = self._options["continuity"] == "G2"
        if joins != (given is not None):
            raise ValueError(
                f"fixed_curvatures: {'needed' if joins else 'refused'} with continuity {self._options['continuity']!r}"
            )
        if given is None:
            return None
        words = None if kinds is None else _parts.checked(kinds, self._fixed)
        return _parts.where_met(_arguments.curvatures(given, self._fixed), words)
