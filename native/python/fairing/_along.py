"""Surfaces over holes through which curves run: each side finds its slope there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from fairing import _arguments, _core, _cut_loops, _loops, _short_edges
from fairing._fair import fair
from fairing._loops import Outline
from fairing._new_mesh import FillResult, read_only, report_fields
from fairing._run_on import Curves
from fairing._types import Diagnostic, FairResult, FloatArray, IntArray
from fairing._watch import Progress, Watch

_TAKEN = ("tolerance", "max_iterations", "threads", "normals", "otherwise")  # by the surface of least variation

Task = tuple[Outline, FloatArray, IntArray, tuple[float, int, bool], dict[str, Any]]
"""Loops, normals (Σ k, 3), the triangles around, the lengths wanted, and the options of :func:`fairing.fair`."""

Others = Callable[[Outline, FloatArray, Any, "Progress | None"], FillResult]
"""Fills the other loops; the third argument are their rows of ``fixed_curvatures``, or None."""


def filled_along(curves: Curves, task: Task, others: Others, progress: Progress | None) -> FillResult:
    """Fill loops: with creases those through which curves run, the others as they are always filled."""
    outline, normals, around, wanted, options = task
    mine = [k for k, cut in enumerate(curves.cut) if cut is not None]
    rest = [k for k, cut in enumerate(curves.cut) if cut is None]
    watch = Watch(progress)
    share = len(mine) / len(curves.cut)
    along = _Along(curves, _some(outline, mine), _rows(outline, normals, mine), wanted, options)
    result = along.filled(around, outline, watch, share)
    if not result.converged:
        return _without(
            curves, outline, others(outline, normals, options.get("fixed_curvatures"), watch.part(share, 1.0))
        )
    if rest:
        given = options.get("fixed_curvatures")
        rows = None if given is None else _rows(outline, given, rest)
        other = others(_some(outline, rest), _rows(outline, normals, rest), rows, watch.part(share, 1.0))
        result = _joined(result, other, curves)
    return result


def _without(curves: Curves, outline: Outline, result: FillResult) -> FillResult:
    """The result for all loops as they are always filled, with a warning for those of curves."""
    loops = [loop for loop, cut in zip(outline.loops, curves.cut, strict=True) if cut is not None]
    bands = [side for band in curves.bands for side in band]
    held = np.intersect1d(np.concatenate(loops), np.concatenate([curves.vertices, *bands])).astype(np.int32)
    text = f"no surface holds the edges that would run on from {_loops.listed(held)}: they are left alone"
    figures = {"ends": float(len(held)), "no_surface": 1.0}
    warning = Diagnostic("EDGES_LEFT_ALONE", text, held, "vertex", figures)
    return replace(result, warnings=(*result.warnings, *curves.warnings, warning))


def _some(outline: Outline, which: list[int]) -> Outline:
    names = ("loops", "turned", "bare")
    return Outline(*(tuple(getattr(outline, name)[k] for k in which) for name in names))


def _rows(outline: Outline, rows: FloatArray, which: list[int]) -> FloatArray:
    parts = outline.split(rows)
    return np.concatenate([parts[k] for k in which])


@dataclass(frozen=True, eq=False)
class _Along:
    curves: Curves
    outline: Outline
    normals: FloatArray
    wanted: tuple[float, int, bool]
    options: dict[str, Any]

    def filled(self, around: IntArray, whole: Outline, watch: Watch, share: float) -> FillResult:
        film = self._film(watch.part(0.0, 0.2 * share))
        watch.lap("first")
        mesh = self._meshed(film, watch.part(0.2 * share, 0.4 * share))
        watch.lap("mesh")
        _loops.check_doubles(mesh[1], around)
        report = self._solved(around, mesh, watch.part(0.4 * share, share))
        values = report_fields(report, self.curves.old_count)
        at_loops = np.isin(report.fixed, whole.vertices)
        values["join"] = read_only(np.where(at_loops, report.join, 0.0))
        values["seconds"] = {**values["seconds"], **watch.seconds}
        values["warnings"] += self.curves.warnings
        return FillResult(
            **values,
            triangles=read_only(mesh[1]),
            loops=tuple(read_only(loop) for loop in whole.loops),
            left_open=(),
            curves=tuple(read_only(curve) for curve in self.curves.curves),
            marked=self.curves.marked,
            bands=tuple((read_only(one), read_only(other)) for one, other in self.curves.bands),
        )

    def _film(self, progress: Progress | None) -> tuple[FloatArray, IntArray]:
        """A soap film over each side, on a coarse mesh: vertices (all of them) and triangles."""
        points = self.curves.points
        cut, normals = _cut_loops.outline_of([each for each in self.curves.cut if each is not None])
        thin = _short_edges.thinned(cut, points, normals)
        rows = thin.outline.split(thin.normals)
        found = _core.fill_loops(points, list(thin.outline.loops), rows, False, "minimal", progress)
        return np.concatenate([points, found["vertices"]]), thin.with_all(found["triangles"])

    @property
    def _held(self) -> tuple[IntArray, FloatArray, IntArray]:
        """Fixed vertices, their normals, and those of them that lie on creases, whose normals don't count."""
        creases = self.curves.vertices
        inside = np.setdiff1d(creases, self.outline.vertices)
        normals = np.concatenate([self.normals, np.tile(self.normals[:1], (len(inside), 1))])
        return np.concatenate([self.outline.vertices, inside]).astype(np.int32), normals, creases

    def _meshed(self, film: tuple[FloatArray, IntArray], progress: Progress | None) -> tuple[FloatArray, IntArray]:
        """A mesh as it is wanted on the film."""
        points, triangles = film
        threads = _arguments.whole("threads", self.options.get("threads", 0), 0)
        mesh = _core.remesh(points, triangles, self._held[0], None, _arguments.NO_EDGES, self.wanted, threads, progress)
        count = len(self.curves.points)
        made = mesh["triangles"].copy()
        made[made >= len(points)] -= len(points) - count
        return np.concatenate([points[:count], mesh["vertices"]]), made

    def _solved(self, around: IntArray, mesh: tuple[FloatArray, IntArray], progress: Progress | None) -> FairResult:
        fixed, normals, creases = self._held
        chosen = {name: self.options[name] for name in _TAKEN if name in self.options}
        return fair(
            *mesh, fixed=fixed, fixed_normals=normals, creases=creases, equation="least_variation",
            inner_fairness=self.options.get("inner_fairness", "conformal"),
            outside=around if len(around) else None, progress=progress, **chosen,
        )  # fmt: skip


def _joined(one: FillResult, other: FillResult, curves: Curves) -> FillResult:
    """Both results, the new vertices of the second one behind those of the first."""
    added = len(one.vertices)

    def behind(indices: IntArray) -> IntArray:
        return np.where(indices >= curves.old_count, indices + added, indices).astype(np.int32)

    def moved(told: Diagnostic) -> Diagnostic:
        by = behind(told.elements) if told.kind == "vertex" else told.elements + len(one.triangles)
        return replace(told, elements=by)

    values: dict[str, Any] = {each.name: getattr(one, each.name) for each in fields(FillResult)}
    for name in ("vertices", "mean_curvature", "boundary_angle", "join"):
        values[name] = read_only(np.concatenate([getattr(one, name), getattr(other, name)]))
    for name in ("triangles", "fixed"):
        values[name] = read_only(np.concatenate([getattr(one, name), behind(getattr(other, name))]))
    for name in ("converged", "polished", "cut"):
        values[name] = getattr(one, name) and getattr(other, name)
    for name in ("iterations", "residual", "initial_residual"):
        values[name] = max(getattr(one, name), getattr(other, name))
    if one.converged and not other.converged:
        values["termination"] = other.termination
    values["warnings"] = one.warnings + tuple(map(moved, other.warnings))
    values["way"] = one.way + other.way
    seconds = one.seconds.keys() | other.seconds.keys()
    values["seconds"] = {name: one.seconds.get(name, 0.0) + other.seconds.get(name, 0.0) for name in seconds}
    return FillResult(**values)
