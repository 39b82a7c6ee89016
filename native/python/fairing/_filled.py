"""The surfaces over all holes of a call, and all of them as one result."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import _core
from fairing._new_mesh import FillResult, Hole, read_only
from fairing._quads import PairedQuads
from fairing._rows import quads_of
from fairing._run_on import Curves
from fairing._types import Diagnostic, IntArray, MeshError

_ORDER = (
    "equation",
    "low_passed",
    "least_variation",
    "least_bent",
    "swept_tube",
    "old_shape",
    "loft",
    "first_surface",
)  # the last one is named
_WORST = ("converged", "iteration_limit", "stalled", "folded")


@dataclass(frozen=True, eq=False)
class Surfaces:
    """What the engine gives back for each hole, with what runs through it, and the loops that were left before."""

    count: int
    """Of the caller's vertices."""
    filled: Sequence[tuple[list[IntArray], dict[str, Any] | Diagnostic]]
    holes: _core.Holes
    curves: Sequence[Curves | Diagnostic | None]
    """What runs through each hole, or why nothing can."""

    def joined(self) -> FillResult:
        """All in one."""
        results = [(tuple(own), self._outcome(number)) for number, (own, _) in enumerate(self.filled)]
        results += [((loop,), reason) for loop, reason, _ in self.holes.left]
        parts = [each for _, each in results if not isinstance(each, Diagnostic)]
        left = [(loop, why) for own, why in results if isinstance(why, Diagnostic) for loop in own]
        if not parts:
            raise MeshError(left[0][1])
        values = _joined(self.count, parts)
        quads = _quads(values)
        values.pop("pairs", None)
        values["warnings"] += self._warnings(results)
        return FillResult(
            **values,
            quads=quads,
            loops=tuple(loop for own, each in results if not isinstance(each, Diagnostic) for loop in own),
            left_open=tuple(loop for loop, _ in left),
            left_because=tuple(reason for _, reason in left),
            holes=tuple(_hole(own, each) for own, each in results),
        )

    def _outcome(self, number: int) -> dict[str, Any] | Diagnostic:
        """The fields of one surface, or why there is none."""
        _, report = self.filled[number]
        curves = self.curves[number] if self.curves else None
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

    def _warnings(self, results: Sequence[tuple[Any, Any]]) -> tuple[Diagnostic, ...]:
        """One for all outer borders, and one for each other loop that stays open."""
        others = [reason for _, reason, is_outer in self.holes.left if not is_outer]
        others += [each for _, each in results[: len(self.filled)] if isinstance(each, Diagnostic)]
        outer = self.holes.outer
        return tuple(others) if outer is None else (outer, *others)


def _hole(loops: tuple[IntArray, ...], outcome: dict[str, Any] | Diagnostic) -> Hole:
    if isinstance(outcome, Diagnostic):
        return Hole(loops, None, outcome)
    values = {name: value for name, value in outcome.items() if name not in ("pairs", "base")}
    return Hole(loops, FillResult(**values, quads=_quads(outcome), loops=loops, left_open=()), None)


def _quads(values: dict[str, Any]) -> PairedQuads | None:
    pairs = values.get("pairs")
    return None if pairs is None else quads_of(values["triangles"], pairs)


def _joined(count: int, parts: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The fields of a result (see `FillResult`) with those of all parts; count: of the caller's vertices."""
    parts = [{name: value for name, value in part.items() if name != "base"} for part in parts]
    if len(parts) == 1:
        return parts[0]
    sizes = [len(part["vertices"]) for part in parts]
    firsts = np.concatenate([[0], np.cumsum(sizes)])[:-1].tolist()
    result = dict(max(parts, key=lambda part: _rank(_ORDER, part["provenance"])))
    for name in ("vertices", "mean_curvature", "boundary_angle", "join"):
        result[name] = np.concatenate([part[name] for part in parts])
    for name in ("fixed", "triangles"):
        moved = [_moved(part[name], count, first) for part, first in zip(parts, firsts, strict=True)]
        result[name] = np.concatenate(moved)
    if all("pairs" in part for part in parts):
        rows = np.cumsum([0, *(len(part["triangles"]) for part in parts)])[:-1].tolist()
        result["pairs"] = np.concatenate([part["pairs"] + first for part, first in zip(parts, rows, strict=True)])
    result["marked"] = tuple(each for part in parts for each in part.get("marked", ()))
    result["curves"] = tuple(
        _moved(curve, count, first)
        for part, first in zip(parts, firsts, strict=True)
        for curve in part.get("curves", ())
    )
    result["bands"] = tuple(
        tuple(_moved(row, count, first) for row in band)
        for part, first in zip(parts, firsts, strict=True)
        for band in part.get("bands", ())
    )
    for name in ("converged", "polished"):
        result[name] = all(part[name] for part in parts)
    result["cut"] = any(part["cut"] for part in parts)
    for name in ("iterations", "residual", "initial_residual"):
        result[name] = max(part[name] for part in parts)
    result["termination"] = max((part["termination"] for part in parts), key=_WORST.index)
    result["way"] = tuple(each for part in parts for each in part["way"])
    result["seconds"] = _sums([part["seconds"] for part in parts])
    result["warnings"] = tuple(
        _renamed(warning, count, first)
        for part, first in zip(parts, firsts, strict=True)
        for warning in part["warnings"]
    )
    return _once({name: _read_only(value) for name, value in result.items()})


def _rank(order: Sequence[str], name: str) -> int:
    return order.index(name) if name in order else len(order)


def _moved(numbers: IntArray, count: int, first: int) -> IntArray:
    moved: IntArray = np.where(numbers < count, numbers, numbers + first).astype(np.int32)
    moved.flags.writeable = False
    return moved


def _renamed(warning: Diagnostic, count: int, first: int) -> Diagnostic:
    """New vertices have other numbers; of triangles those of the mesh that was solved are named in any case."""
    if warning.kind != "vertex" or not first:
        return warning
    return Diagnostic(warning.code, warning.message, _moved(warning.elements, count, first), "vertex", warning.figures)


def _sums(seconds: Sequence[dict[str, float]]) -> dict[str, float]:
    names = dict.fromkeys(name for each in seconds for name in each)
    return {name: sum(each.get(name, 0.0) for each in seconds) for name in names}


def _once(values: dict[str, Any]) -> dict[str, Any]:
    """Each fixed vertex once, with its largest angles: loops may share some."""
    fixed, place = np.unique(values["fixed"], return_inverse=True)
    if len(fixed) == len(values["fixed"]):
        return values
    result = {**values, "fixed": _read_only(fixed)}
    for name in ("boundary_angle", "join"):
        worst = np.zeros(len(fixed))
        np.maximum.at(worst, place, values[name])
        result[name] = _read_only(worst)
    return result


def _read_only(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        value.flags.writeable = False
    return value
