"""The triangles around a patch, and a noisy boundary that is moved onto their fit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.results import FOLDS, Diagnostic, FloatArray, IntArray

Answer = dict[str, Any]


@dataclass(frozen=True)
class Boundary:
    """What a solve is given: vertices (n, 3), ``fixed`` (k,), its normals (k, 3) and curvatures (k,).

    None where left out.
    """

    vertices: FloatArray
    fixed: IntArray | None
    normals: FloatArray | None
    curvatures: FloatArray | None = None


@dataclass(frozen=True)
class Surroundings:
    """Triangles between free vertices, and those around them that stay."""

    inside: IntArray
    outside: IntArray
    rim: IntArray
    """Vertices of both, ascending."""

    @classmethod
    def of(cls, vertices: FloatArray, triangles: IntArray, fixed: IntArray | None, given: Any) -> Surroundings:
        """Outside are the triangles ``given``; without these those of the patch's whose corners are all fixed.

        None are where that leaves most fixed vertices without any: single triangles at the boundary's corners.
        """
        if given is not None:
            return cls.between(vertices, triangles, arguments.vertices_of("outside", given, len(vertices), 3))
        held = marked(np.empty(0, np.int32) if fixed is None else fixed, vertices.shape[0])  # the engine names others
        corners = held[triangles]
        idle = corners[:, 0] & corners[:, 1] & corners[:, 2]
        around = cls.between(vertices, triangles[~idle], triangles[idle]) if idle.any() else None
        if around is None or 2 * len(around.rim) < (held & marked(around.inside, len(held))).sum():
            return cls(triangles, triangles[:0], np.empty(0, np.int32))
        return around

    @classmethod
    def between(cls, vertices: FloatArray, inside: IntArray, outside: IntArray) -> Surroundings:
        """Without triangles outside that have a corner which is not finite."""
        finite = arguments.finite_triangles(vertices, outside)
        rim = marked(inside, len(vertices)) & marked(finite, len(vertices))
        return cls(inside, finite, np.flatnonzero(rim).astype(np.int32))


def marked(vertices: npt.NDArray[Any], count: int) -> npt.NDArray[np.bool_]:
    """Marks (count,) of those of the vertices that exist."""
    marks = np.zeros(count, dtype=bool)
    if vertices.size and (vertices.min() < 0 or vertices.max() >= count):
        vertices = vertices[(vertices >= 0) & (vertices < count)]
    marks[vertices] = True
    return marks


def refuse_creases(creases: Any, around: Surroundings) -> None:
    """Fits would look across a crease that runs on outside, and round it off: only the ends inside are known."""
    ends = np.intersect1d([] if creases is None else creases, around.rim)
    if len(ends):
        raise ValueError(
            f"outline: 'mended' can't follow creases outside, and {len(ends)} of `creases` lie on the boundary, "
            f"vertex {int(ends[0])} among them: pass boundary 'given', or leave `creases` out"
        )


def solve_fitted(
    call: Callable[[Boundary], Answer], given: Boundary, triangles: IntArray, around: Surroundings
) -> Answer:
    """The better answer: the fitted boundary's, unless the given one is solved, or folds less, or joins better.

    The given one is solved only where the fitted one has a fault.
    """
    if not len(around.rim):
        raise ValueError(
            "outline: 'mended' needs the triangles outside: pass them as `outside`, or among the triangles with all "
            "their vertices in `fixed`"
        )
    fitted = _core.mend_outline(given.vertices, around.outside, around.rim)
    if not len(fitted["moved"]):
        return call(given)
    answer = call(_moved(given, triangles, around.rim, fitted))
    worth = _worth(answer, around)
    if worth != _FLAWLESS:
        kept = call(given)
        if _worth(kept, around) > worth:
            why = "the fitted positions give folds, a larger kink or no solution"
            return _reported(kept, fitted["moved"], why, worse=1.0)
    answer["moved"] = fitted["moved"]
    return _reported(answer, fitted["held"], "moving it would turn triangles over")


def _moved(given: Boundary, triangles: IntArray, rim: IntArray, fitted: Answer) -> Boundary:
    """The fitted positions, and the fitted normals at the rim."""
    fixed = rim if given.fixed is None else given.fixed
    if given.normals is None:
        normals = _core.vertex_normals(given.vertices, triangles, "averaged")[fixed]
    else:
        normals = given.normals.copy()
    place = np.searchsorted(rim, fixed).clip(max=len(rim) - 1)
    found = (rim[place] == fixed) & fitted["fitted"][place]
    normals[found] = fitted["normals"][place[found]]
    return replace(given, vertices=fitted["vertices"], fixed=fixed, normals=normals)


_FLAWLESS = (True, 0, 0.0)


def _worth(answer: Answer, around: Surroundings) -> tuple[bool, int, float]:
    """What two answers are compared by: solved; folds; the worst kink in degrees, as far as it may be visible.

    Below, none is worth a second solve.
    """
    if not answer["converged"]:
        return False, -_folds(answer), 0.0
    degrees, _, seen = _core.visible_join(answer["vertices"], around.inside, around.outside, around.rim)
    return True, -_folds(answer), -float(np.max(degrees[seen], initial=0.0))


def _folds(answer: Answer) -> int:
    return sum(len(warning.elements) for warning in answer["warnings"] if warning.code in FOLDS)


def _reported(answer: Answer, vertices: IntArray, why: str, **figures: float) -> Answer:
    if len(vertices):
        text = f"{len(vertices)} vertices of a noisy boundary keep their positions: {why}"
        figures = {"vertices": len(vertices), **figures}
        answer["warnings"] += (Diagnostic("OUTLINE_KEPT", text, vertices, "vertex", figures),)
    return answer


def with_join(answer: Answer, around: Surroundings) -> Answer:
    """The join measured on the triangles outside, at the vertices that have some."""
    if len(around.rim):
        fixed = answer["fixed"]
        degrees, _, _ = _core.visible_join(answer["vertices"], around.inside, around.outside, fixed)
        answer["join"] = np.where(np.isin(fixed, around.rim), degrees, answer["join"])
        answer["join"].flags.writeable = False
    return answer
