"""Options of the two methods: which words and numbers each accepts."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _paper
from fairing._groups import Layout, Options
from fairing._types import FloatArray, IntArray

INNER_FAIRNESS = _core.WORDS["inner_fairness"]
OUTLINES = ("given", "mended")
CONTINUITIES = ("G1", "G2")


def engine_options(chosen: Options, threads: Any, count: int) -> _core.Options:
    """What the engine is told about a mesh of ``count`` vertices, checked."""
    values = chosen.for_engine()
    method = values["method"]
    if method == "paper":
        values["normals"] = "averaged"
        _refuse_with_paper(values)
    for name in ("load", "bulge"):
        if values[name] != 0.0 and values["equation"] != "constant":
            accepted = "0 and, with equation 'constant', finite numbers"
            raise ValueError(f"{name}: {values[name]!r} is not accepted; accepted are {accepted}")
    values |= layout_within(chosen.layout, count)
    values["paper"] = _paper.engine_options(method, chosen.solving.levels, chosen.solving.paper)
    values["threads"] = _arguments.whole("threads", threads, 0)
    options = _core.Options()
    for name, value in values.items():
        setattr(options, name, value)
    return options


def layout_within(layout: Layout, count: int) -> dict[str, Any]:
    """How vertices of a mesh of ``count`` lie: the word or the rows (i, j, λ), and (e, 2) edges, where given."""
    found: dict[str, Any] = {}
    if layout.neighbours is not None:
        found["neighbours"] = _arguments.vertices_of("neighbours", layout.neighbours, count, 2)
    if isinstance(layout.inner_fairness, str):
        found["inner_fairness"] = _arguments.choice("inner_fairness", layout.inner_fairness, INNER_FAIRNESS)
    elif layout.inner_fairness is not None:
        found["weights"] = _directed_weights(layout.inner_fairness, count)
    return found


def _refuse_with_paper(values: dict[str, Any]) -> None:
    """ValueError for what only the fast solver has."""
    for name, wrong in (("equation", "least_variation"), ("open_border", "faired")):
        if values[name] == wrong:
            raise ValueError(f"{name}: {wrong!r} is not accepted by method 'paper'; accepted with 'global'")
    for name in ("creases", "smooth_curves"):
        if values[name]:
            raise ValueError(f"{name}: not accepted by method 'paper'; accepted with 'global'")


def faired_needs_fixed(open_border: str, fixed: IntArray | None) -> None:
    """Refuse to fair all that holds a patch."""
    if open_border == "faired" and fixed is None:
        raise ValueError("open_border: 'faired' needs `fixed`, since all other border vertices move")


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


def callback(progress: Any) -> Any:
    """A callable, or None."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: a callable(fraction, stage) or None is needed, not {progress!r}")
    return progress


def _directed_weights(value: npt.ArrayLike, count: int) -> FloatArray:
    rows = _arguments.floats("inner_fairness", value)
    ends = rows[:, :2]
    whole = (ends == np.floor(ends)) & (np.abs(ends) <= np.iinfo(np.int32).max)
    if not np.isfinite(rows).all() or not whole.all() or (rows[:, 2] < 0).any():
        raise ValueError("inner_fairness: rows of two vertex indices and a finite weight λ ≥ 0 are needed")
    _arguments.indices_within("inner_fairness", ends.astype(np.int64), count)
    return rows
