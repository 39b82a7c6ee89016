"""What a call is given, checked: groups of options, or fields of them by name."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments, groups
from fairing.options.groups import Boundary, Layout, Options
from fairing.results import FloatArray, IntArray

KINDS = ("G0", "G1", "G2")


def by_parts(boundary: Boundary, options: Options) -> tuple[Boundary, Options]:
    """The boundary and the options of a call; ``continuity`` stays in the boundary where some of it is "G2".

    Raises ValueError for other words or another shape, for what contradicts ``options``, and for "G0" beside "G2".
    """
    if boundary.continuity is None:
        return boundary, options
    kinds = checked(boundary.continuity, boundary.vertices)
    fixed = arguments.integers("fixed", boundary.vertices, None)  # type: ignore[arg-type]
    loose, curved = kinds == "G0", kinds == "G2"
    if loose.any() and (curved.any() or options.surface.continuity == "G2"):
        raise ValueError(
            "continuity: 'G0' and 'G2' can't be mixed in one boundary: 'G0' takes the equation 'least_variation', "
            "'G2' 'harmonic'"
        )
    if loose.any():
        creases = options.curves.creases
        given = arguments.integers("creases", [] if creases is None else creases, None)
        options = options.changed(creases=np.union1d(given, fixed[loose]).astype(np.int32))
    if not curved.any():
        if options.surface.continuity == "G2":  # the words along the boundary say more
            boundary, options = replace(boundary, curvatures=None), options.changed(continuity="G1")
        return replace(boundary, continuity=None), options
    return replace(boundary, continuity=kinds), options.changed(continuity="G2")


def where_met(curvatures: FloatArray, kinds: Any) -> FloatArray:
    """(k,) curvatures of the vertices that are to continue them, infinite at the others; ``kinds`` None: all are."""
    return curvatures if kinds is None else np.where(kinds == "G2", curvatures, np.inf)


def checked(value: Any, vertices: Any) -> npt.NDArray[np.str_]:
    """The (k,) words of ``continuity``; raises ValueError for others, or another shape than that of ``vertices``."""
    if vertices is None:
        raise ValueError("continuity: needs `vertices`, whose order it follows")
    kinds = np.asarray(value)
    count = len(np.asarray(vertices))
    if kinds.shape != (count,):
        raise ValueError(f"continuity: shape ({count},) is needed, one word for each vertex, not {kinds.shape}")
    for kind in np.unique(kinds).tolist():
        arguments.choice("continuity", kind, KINDS)
    return kinds


INNER_FAIRNESS = _core.WORDS["inner_fairness"]
BOUNDARIES = ("given", "mended")
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
    values["paper"] = groups.engine_options(method, chosen.solving.levels, chosen.solving.paper)
    values["threads"] = arguments.whole("threads", threads, 0)
    options = _core.Options()
    for name, value in values.items():
        setattr(options, name, value)
    return options


def layout_within(layout: Layout, count: int) -> dict[str, Any]:
    """How vertices of a mesh of ``count`` lie: the word or the rows (i, j, λ), and (e, 2) edges, where given."""
    found: dict[str, Any] = {}
    if layout.neighbours is not None:
        found["neighbours"] = arguments.vertices_of("neighbours", layout.neighbours, count, 2)
    if isinstance(layout.inner_fairness, str):
        found["inner_fairness"] = arguments.choice("inner_fairness", layout.inner_fairness, INNER_FAIRNESS)
    elif layout.inner_fairness is not None:
        found["weights"] = _edge_weights(layout.inner_fairness, count)
    return found


def _refuse_with_paper(values: dict[str, Any]) -> None:
    """ValueError for what only the fast solver has."""
    for name, wrong in (("equation", ("constant", "minimal_energy", "least_variation")), ("open_border", ("faired",))):
        if values[name] in wrong:
            raise ValueError(f"{name}: {values[name]!r} is not accepted by method 'paper'; accepted with 'global'")
    for name in ("creases", "smooth_curves"):
        if values[name]:
            raise ValueError(f"{name}: not accepted by method 'paper'; accepted with 'global'")


def faired_needs_fixed(open_border: str, fixed: IntArray | None) -> None:
    """Refuse to fair all that holds a patch."""
    if open_border == "faired" and fixed is None:
        raise ValueError("open_border: 'faired' needs `fixed`, since all other border vertices move")


def continuity(value: str, equation: str, method: str) -> bool:
    """Whether curvatures are to be met; only Δ_B H = 0 of the fast solver has a version that meets them."""
    if arguments.choice("continuity", value, CONTINUITIES) == "G1":
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


def _edge_weights(value: npt.ArrayLike, count: int) -> FloatArray:
    rows = arguments.floats("inner_fairness", value)
    ends = rows[:, :2]
    whole = (ends == np.floor(ends)) & (np.abs(ends) <= np.iinfo(np.int32).max)
    if not np.isfinite(rows).all() or not whole.all() or (rows[:, 2] < 0).any():
        raise ValueError("inner_fairness: rows of two vertex indices and a finite weight λ ≥ 0 are needed")
    arguments.indices_within("inner_fairness", ends.astype(np.int64), count)
    return rows


OF_BOUNDARY = {
    "fixed": "vertices", "fixed_normals": "normals", "fixed_curvatures": "curvatures", "outside": "outside",
}  # fmt: skip


def given(
    boundary: Boundary | npt.ArrayLike | None, options: Options | None, named: dict[str, Any]
) -> tuple[Boundary, Options]:
    """The boundary and the options of a call; ``named``: fields of the boundary, and of the options in place of these.

    Raises TypeError for a name that there isn't, ValueError where a group is something else, or a field given twice.
    """
    known = boundary if isinstance(boundary, Boundary) else Boundary(boundary)
    chosen = Options() if options is None else options
    if not isinstance(chosen, Options):
        raise ValueError(f"options: a fairing.Options is needed, not {options!r}")
    for name, group in vars(chosen).items():
        if not isinstance(group, type(getattr(Options(), name))):
            raise ValueError(f"options: {name} has to be a fairing.{name.capitalize()}, not {group!r}")
    held = {OF_BOUNDARY[name]: value for name, value in named.items() if name in OF_BOUNDARY}
    for name, field in OF_BOUNDARY.items():
        if name in named and getattr(known, field) is not None:
            raise ValueError(f"{name}: given twice, by this name and in `boundary`: one of them is needed")
    others = {name: value for name, value in named.items() if name not in OF_BOUNDARY}
    return by_parts(replace(known, **held), chosen.changed(**others))
