"""Surfaces over holes through which curves run: each side finds its slope there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import _arguments, _core, _cut_loops, _loops, _short_edges
from fairing._fair import solved
from fairing._groups import Boundary, Options
from fairing._loops import Outline
from fairing._new_mesh import read_only, report_fields
from fairing._run_on import Curves
from fairing._types import FairResult, FloatArray, IntArray
from fairing._watch import Progress, Watch

_TAKEN = ("tolerance", "max_iterations", "threads", "normals", "otherwise")  # by the surface of least variation

Task = tuple[Outline, FloatArray, IntArray, tuple[float, int, bool, bool], dict[str, Any]]
"""Loops, normals (Σ k, 3), the triangles around, the lengths wanted, and the options of :func:`fairing.fair`."""


def filled_along(curves: Curves, task: Task, progress: Progress | None) -> dict[str, Any]:
    """The fields of a result but for the loops, all of which curves cut: each side finds its slope at them."""
    outline, normals, around, wanted, options = task
    return _Along(curves, outline, normals, wanted, options).filled(around, Watch(progress))


@dataclass(frozen=True, eq=False)
class _Along:
    curves: Curves
    outline: Outline
    normals: FloatArray
    wanted: tuple[float, int, bool, bool]
    options: dict[str, Any]

    def filled(self, around: IntArray, watch: Watch) -> dict[str, Any]:
        film = self._film(watch.part(0.0, 0.2))
        watch.lap("first")
        mesh = self._meshed(film, watch.part(0.2, 0.4))
        watch.lap("mesh")
        _loops.check_doubles(mesh[1], around)
        report = self._solved(around, mesh, watch.part(0.4, 1.0))
        values = report_fields(report, self.curves.old_count)
        at_loops = np.isin(report.fixed, self.outline.vertices)
        values["join"] = read_only(np.where(at_loops, report.join, 0.0))
        values["triangles"] = read_only(mesh[1])
        values["seconds"] = {**values["seconds"], **watch.seconds}
        return values

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
        fixed, _, creases = self._held
        slopes = creases, np.empty(0, np.int32)
        mesh = _core.remesh(
            points, triangles, fixed, None, slopes, _arguments.NO_EDGES, self.wanted, threads, progress
        )  # fmt: skip
        count = len(self.curves.points)
        made = mesh["triangles"].copy()
        made[made >= len(points)] -= len(points) - count
        return np.concatenate([points[:count], mesh["vertices"]]), made

    def _solved(self, around: IntArray, mesh: tuple[FloatArray, IntArray], progress: Progress | None) -> FairResult:
        fixed, normals, creases = self._held
        chosen = {name: self.options[name] for name in _TAKEN if name in self.options}
        threads = chosen.pop("threads", 0)
        options = Options.of(
            **chosen, creases=creases, equation="least_variation",
            inner_fairness=self.options.get("inner_fairness", "conformal"),
        )  # fmt: skip
        boundary = Boundary(fixed, normals, outside=around if len(around) else None)
        return solved(*mesh, boundary, options, progress, threads)
