"""Options of the two methods: which words and numbers each accepts."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._groups import Boundary, Options
from fairing._types import FloatArray, IntArray

# The engine's own words; `outline` is chosen here.
METHODS = _core.WORDS["method"]
NORMALS = _core.WORDS["normals"]
EQUATIONS = _core.WORDS["equation"]
OTHERWISE = _core.WORDS["otherwise"]
INNER_FAIRNESS = _core.WORDS["inner_fairness"]
OUTLINES = ("given", "mended")
CONTINUITIES = ("G1", "G2")
STARTS = ("outline", "given", "least_variation", "loft", "smoothed")
OPEN_BORDERS = ("held", "faired")


def engine_options(
    *,
    equation: str,
    otherwise: str,
    load: Any,
    bulge: Any,
    fairness: str,
    method: str,
    normals: str,
    tolerance: Any,
    max_iterations: Any,
    threads: Any,
    detail: Any,
    detail_size: Any,
    start: str = "outline",
    creases: Any = None,
    smooth_curves: Any = None,
    open_border: str = "held",
    pin_radius: Any = 0.0,
) -> _core.Options:
    """Checks the options that both methods have; ``fairness`` is the engine's word for it."""
    _arguments.choice("normals", normals, NORMALS)
    if method == "paper" and equation == "least_variation":
        raise ValueError("equation: 'least_variation' is not accepted by method 'paper'; accepted with 'global'")
    faired = _arguments.choice("open_border", open_border, OPEN_BORDERS) == "faired"
    if faired and method == "paper":
        raise ValueError("open_border: 'faired' is not accepted by method 'paper'; accepted with 'global'")
    slopes = {"creases": creases, "smooth_curves": smooth_curves}
    return _core.Options(
        equation=_arguments.choice("equation", equation, EQUATIONS),
        otherwise=_arguments.choice("otherwise", otherwise, OTHERWISE),
        load=load_number("load", equation, load),
        bulge=load_number("bulge", equation, bulge),
        inner_fairness=fairness,
        method=method,
        normals="averaged" if method == "paper" else normals,
        tolerance=_arguments.positive("tolerance", tolerance),
        max_iterations=_arguments.whole("max_iterations", max_iterations, 1),
        threads=_arguments.whole("threads", threads, 0),
        detail=_arguments.share("detail", detail),
        detail_size=_arguments.share("detail_size", detail_size),
        start=_arguments.choice("start", start, STARTS),
        fair_border=faired,
        pin_radius=_arguments.share("pin_radius", pin_radius),
        **{name: _free_slopes(name, vertices, method) for name, vertices in slopes.items()},
    )


def faired_needs_fixed(open_border: str, fixed: IntArray | None) -> None:
    """Refuse to fair all that holds a patch."""
    if open_border == "faired" and fixed is None:
        raise ValueError("open_border: 'faired' needs `fixed`, since all other border vertices move")


def _free_slopes(name: str, vertices: Any, method: str) -> list[int]:
    """The vertices named; only the fast solver leaves slopes free."""
    if vertices is None:
        return []
    named = _arguments.integers(name, vertices, None)
    if len(named) and method == "paper":
        raise ValueError(f"{name}: not accepted by method 'paper'; accepted with 'global'")
    return [int(v) for v in named]


def continuity(value: str, equation: str, method: str) -> bool:
    """Whether curvatures are to be met; only Δ_B H = 0 of the fast solver has a version that meets them."""
    if _arguments.choice("continuity", value, CONTINUITIES) == "G1":
        return False
    if equation not in ("harmonic", "automatic") or method != "global":
        raise ValueError(
            f"continuity: 'G2' is not accepted with equation {equation!r} and method {method!r}; "
            "accepted with 'harmonic' or 'automatic' and 'global'"
        )
    return True


def tension(boundary: Boundary, fixed: IntArray | None, chosen: Options) -> FloatArray | None:
    """(k,) tensions at ``fixed``, or None; only Δ_B H = 0 with tangent joins has a version with them."""
    if boundary.tension is None:
        return None
    surface, method = chosen.surface, chosen.solving.method
    if surface.continuity != "G1":
        raise ValueError(f"tension: not accepted with continuity {surface.continuity!r}; accepted with 'G1'")
    if surface.equation not in ("harmonic", "automatic") or method != "global":
        raise ValueError(
            f"tension: not accepted with equation {surface.equation!r} and method {method!r}; accepted with 'harmonic' "
            "or 'automatic' and 'global'"
        )
    return _arguments.tensions(boundary.tension, fixed)


def neighbour_edges(neighbours: npt.ArrayLike | None, count: int) -> IntArray | None:
    """(e, 2) vertices below ``count``."""
    if neighbours is None:
        return None
    return _arguments.indices_within("neighbours", _arguments.integers("neighbours", neighbours, 2), count)


def callback(progress: Any) -> Any:
    """A callable, or None."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: a callable(fraction, stage) or None is needed, not {progress!r}")
    return progress


def load_number(name: str, equation: str, value: Any) -> float:
    """A finite load or bulge, which only equation "constant" may have."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.floating, np.integer)):
        raise ValueError(f"{name}: a number is needed, not {value!r}")
    if not np.isfinite(value) or (value != 0.0 and equation != "constant"):
        raise ValueError(
            f"{name}: {value!r} is not accepted; accepted are 0 and, with equation 'constant', finite numbers"
        )
    return float(value)


def inner_fairness(value: Any, count: int) -> tuple[str, FloatArray | None]:
    """The word for the engine and rows (i, j, λ), which count instead where there are any."""
    if isinstance(value, str) or value is None:
        return _arguments.choice("inner_fairness", value, INNER_FAIRNESS), None
    return "uniform", _directed_weights(value, count)


def _directed_weights(value: npt.ArrayLike, count: int) -> FloatArray:
    rows = _arguments.floats("inner_fairness", value)
    ends = rows[:, :2]
    whole = (ends == np.floor(ends)) & (np.abs(ends) <= np.iinfo(np.int32).max)
    if not np.isfinite(rows).all() or not whole.all() or (rows[:, 2] < 0).any():
        raise ValueError("inner_fairness: rows of two vertex indices and a finite weight λ ≥ 0 are needed")
    _arguments.indices_within("inner_fairness", ends.astype(np.int64), count)
    return rows
