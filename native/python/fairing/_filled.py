"""The surfaces over all holes of a call, and all of them as one result."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from fairing import _core
from fairing._new_mesh import FillResult, Hole, read_only
from fairing._rows import quads_of
from fairing._run_on import Curves
from fairing._types import Diagnostic, IntArray, MeshError

_ORDER = (  # the last one is named
    "equation", "low_passed", "least_variation", "least_bent", "swept_tube", "old_shape", "loft", "first_surface",
)  # fmt: skip
_WORST = ("converged", "iteration_limit", "stalled", "folded")
Fields = dict[str, Any]
Loops = tuple[IntArray, ...]


def joined(
    count: int,
    filled: Sequence[tuple[list[IntArray], Fields | Diagnostic]],
    holes: _core.Holes,
    curves: Sequence[Curves | Diagnostic | None],
) -> FillResult:
    """What the engine gives back for each hole, and the loops that were left before, in one; MeshError: all were.

    count: of the caller's vertices; curves: what runs through each hole, or why nothing can.
    """
    of_holes = [(tuple(own), _outcome(report, curves[k] if curves else None)) for k, (own, report) in enumerate(filled)]
    every: list[tuple[Loops, Fields | Diagnostic]] = [*of_holes, *(((loop,), why) for loop, why, _ in holes.left)]
    done = [(own, each) for own, each in every if not isinstance(each, Diagnostic)]
    left = [(loop, why) for own, why in every if isinstance(why, Diagnostic) for loop in own]
    if not done:
        raise MeshError(left[0][1])
    unfilled = [why for _, why, is_outer in holes.left if not is_outer]
    unfilled += [each for _, each in of_holes if isinstance(each, Diagnostic)]
    values = _one(count, [each for _, each in done])
    values["warnings"] += (*(() if holes.outer is None else (holes.outer,)), *unfilled)
    return _result(
        values,
        loops=tuple(loop for own, _ in done for loop in own),
        left_open=tuple(loop for loop, _ in left),
        left_because=tuple(why for _, why in left),
        holes=tuple(
            Hole(own, None, each)
            if isinstance(each, Diagnostic)
            else Hole(own, _result(each, loops=own, left_open=()), None)
            for own, each in every
        ),
    )


def _result(values: Fields, **others: Any) -> FillResult:
    own = {name: value for name, value in values.items() if name not in ("pairs", "base")}
    pairs = values.get("pairs")
    return FillResult(**own, **others, quads=None if pairs is None else quads_of(values["triangles"], pairs))


def _outcome(report: Fields | Diagnostic, curves: Curves | Diagnostic | None) -> Fields | Diagnostic:
    """The fields of one surface, or why there is none."""
    if isinstance(report, Diagnostic) or isinstance(curves, Diagnostic):
        return curves if isinstance(curves, Diagnostic) else report
    values = dict(report)
    is_along = values.pop("along_curves")
    if curves is not None:
        values["warnings"] += curves.warnings if is_along or not curves.cut.loops else curves.left_alone()
    if curves is not None and is_along:
        bands = tuple(tuple(map(read_only, band)) for band in curves.bands)
        values |= {"curves": tuple(map(read_only, curves.curves)), "marked": curves.marked, "bands": bands}
    return values


def _one(count: int, parts: Sequence[Fields]) -> Fields:
    """The fields of a result with those of all parts."""
    if len(parts) == 1:
        return dict(parts[0])
    firsts = np.cumsum([0, *(len(part["vertices"]) for part in parts)]).tolist()
    numbered = list(zip(parts, firsts, strict=False))
    result = dict(max(parts, key=lambda part: _rank(part["provenance"])))
    for name in ("vertices", "mean_curvature", "boundary_angle", "join"):
        result[name] = np.concatenate([part[name] for part in parts])
    for name in ("fixed", "triangles"):
        result[name] = np.concatenate([_moved(part[name], count, first) for part, first in numbered])
    if all("pairs" in part for part in parts):
        rows = np.cumsum([0, *(len(part["triangles"]) for part in parts)]).tolist()
        result["pairs"] = np.concatenate([part["pairs"] + row for part, row in zip(parts, rows, strict=False)])
    result["marked"] = tuple(each for part in parts for each in part.get("marked", ()))
    result["curves"] = tuple(_moved(each, count, first) for part, first in numbered for each in part.get("curves", ()))
    result["bands"] = tuple(
        tuple(_moved(row, count, first) for row in band) for part, first in numbered for band in part.get("bands", ())
    )
    for name, of_all in (("converged", all), ("polished", all), ("cut", any)):
        result[name] = of_all(part[name] for part in parts)
    for name in ("iterations", "residual", "initial_residual"):
        result[name] = max(part[name] for part in parts)
    result["termination"] = max((part["termination"] for part in parts), key=_WORST.index)
    result["way"] = tuple(each for part in parts for each in part["way"])
    stages = dict.fromkeys(name for part in parts for name in part["seconds"])
    result["seconds"] = {name: sum(part["seconds"].get(name, 0.0) for part in parts) for name in stages}
    result["warnings"] = tuple(_renamed(each, count, first) for part, first in numbered for each in part["warnings"])
    return {name: read_only(value) if isinstance(value, np.ndarray) else value for name, value in _once(result).items()}


def _rank(provenance: str) -> int:
    return _ORDER.index(provenance) if provenance in _ORDER else len(_ORDER)


def _moved(numbers: IntArray, count: int, first: int) -> IntArray:
    moved: IntArray = read_only(np.where(numbers < count, numbers, numbers + first).astype(np.int32))
    return moved


def _renamed(warning: Diagnostic, count: int, first: int) -> Diagnostic:
    """New vertices have other numbers; of triangles those of the mesh that was solved are named in any case."""
    if warning.kind != "vertex" or not first:
        return warning
    return Diagnostic(warning.code, warning.message, _moved(warning.elements, count, first), "vertex", warning.figures)


def _once(values: Fields) -> Fields:
    """Each fixed vertex once, with its largest angles: loops may share some."""
    fixed, place = np.unique(values["fixed"], return_inverse=True)
    if len(fixed) == len(values["fixed"]):
        return values
    result = {**values, "fixed": fixed}
    for name in ("boundary_angle", "join"):
        result[name] = np.zeros(len(fixed))
        np.maximum.at(result[name], place, values[name])
    return result
