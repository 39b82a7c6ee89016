"""Results over several loops as one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from fairing._types import Diagnostic, IntArray

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


def joined(count: int, parts: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The fields of a result (see `FillResult`) with those of all parts; count: of the caller's vertices."""
    if len(parts) == 1:
        return parts[0]
    sizes = [len(part["vertices"]) for part in parts]
    firsts = np.concatenate([[0], np.cumsum(sizes)])[:-1].tolist()
    result = dict(max(parts, key=lambda part: _rank(_ORDER, part["provenance"])))
    for name in ("vertices", "mean_curvature", "boundary_angle", "join"):
        result[name] = np.concatenate([part[name] for part in parts])
    assert not any(part.get("curves") for part in parts[1:])  # their vertices come first
    for name in ("fixed", "triangles"):
        moved = [_moved(part[name], count, first) for part, first in zip(parts, firsts, strict=True)]
        result[name] = np.concatenate(moved)
    if all("pairs" in part for part in parts):
        rows = np.cumsum([0, *(len(part["triangles"]) for part in parts)])[:-1].tolist()
        result["pairs"] = np.concatenate([part["pairs"] + first for part, first in zip(parts, rows, strict=True)])
    for name in ("curves", "marked"):
        result[name] = tuple(each for part in parts for each in part.get(name, ()))
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
    return once({name: _read_only(value) for name, value in result.items()})


def _rank(order: Sequence[str], name: str) -> int:
    return order.index(name) if name in order else len(order)


def _moved(numbers: IntArray, count: int, first: int) -> IntArray:
    moved: IntArray = np.where(numbers < count, numbers, numbers + first).astype(np.int32)
    return moved


def _renamed(warning: Diagnostic, count: int, first: int) -> Diagnostic:
    """New vertices have other numbers; of triangles those of the mesh that was solved are named in any case."""
    if warning.kind != "vertex" or not first:
        return warning
    return Diagnostic(warning.code, warning.message, _moved(warning.elements, count, first), "vertex", warning.figures)


def _sums(seconds: Sequence[dict[str, float]]) -> dict[str, float]:
    names = dict.fromkeys(name for each in seconds for name in each)
    return {name: sum(each.get(name, 0.0) for each in seconds) for name in names}


def once(values: dict[str, Any]) -> dict[str, Any]:
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
