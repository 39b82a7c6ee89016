"""How each loop is filled: by curves, one face, a fan, or a surface with several vertices inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import (
    _core,
    _holes,
    _hub,
    _loops,
    _pinches,
    _run_on,
    _short_edges,
    _sides,
    _single_face,
)
from fairing._along import filled_along
from fairing._chosen import Chosen
from fairing._joined import joined
from fairing._new_mesh import read_only, report_fields
from fairing._patch import LEAST_COUNT, Patch, Spacing, carried, cut_fields
from fairing._proportion import Limit
from fairing._rows import Rows, no_rows, rows_over, with_pairs
from fairing._tangency import not_tangent
from fairing._types import FairResult, FloatArray, IntArray, MeshError
from fairing._watch import Progress, Watch


@dataclass(frozen=True)
class Task:
    """What one call asks for, but for the loops."""

    points: FloatArray
    around: IntArray
    bridge: bool
    length: Spacing
    max_vertices: Any
    broken: _run_on.Edges
    options: dict[str, Any]
    progress: Progress | None
    in_rows: bool = False
    """Whether faces are quads in rows."""

    def filled(self, chosen: Chosen) -> dict[str, Any]:
        """The fields of a result but for the loops: curves, faces, fans and surfaces, as each loop asks for."""
        Limit.of(0.0, self.max_vertices)
        loops = chosen.outline.loops
        plain = [k for k, loop in enumerate(loops) if not self.bridge and self._is_single(loop)]
        rest = [k for k in range(len(loops)) if k not in set(plain)]
        curves, through = self._curves(chosen, rest)
        rest = [k for k in rest if k not in set(through)]
        fans, hubs = self._fans(chosen, [] if self.bridge else self._hubs(chosen, rest))
        others = [k for k in rest if k not in set(hubs)]
        watch = Watch(self.progress)
        share = len(through) / max(1, len(through) + len(others))
        along = self._along(chosen.part(through), curves, watch.part(0.0, share)) if curves and through else None
        if curves and along is not None and not along["converged"]:
            curves, along = curves.left_alone([loops[k] for k in through]), None
            others = sorted([*others, *through])
        made = [
            along,
            *self._each_solved(chosen, others, watch.part(share, 1.0)),
            fans,
            self._single_faces(chosen.part(plain)) if plain else None,
        ]
        parts = [fields for fields in made if fields is not None]
        if self.in_rows:
            if along is not None:
                along["warnings"] += tuple(no_rows(chosen.outline.loops[k], "curves") for k in through)
            parts = [with_pairs(fields, self.points) for fields in parts]
        values = joined(len(self.points), parts)
        if curves:
            values["warnings"] += curves.warnings
            bands = tuple(tuple(map(read_only, band)) for band in curves.bands)
            values |= {"curves": tuple(map(read_only, curves.curves)), "marked": curves.marked, "bands": bands}
        return values

    def _curves(self, chosen: Chosen, numbers: list[int]) -> tuple[_run_on.Curves | None, list[int]]:
        """What runs through these loops, and through which."""
        if not numbers:
            return None, []
        part = chosen.part(numbers)
        length = (self.length.length, self.length.even)
        curves = self.broken.run_on(part.outline, self._shared(part), (self.points, self.around), length)
        return curves, [k for k, cut in zip(numbers, curves.cut, strict=True) if cut is not None]

    def _along(self, chosen: Chosen, curves: _run_on.Curves, progress: Progress | None) -> dict[str, Any]:
        task = (chosen.outline, self._shared(chosen), self.around, self.length.wanted(0), self.options)
        return filled_along(curves, task, progress)

    def _shared(self, chosen: Chosen) -> FloatArray:
        return _short_edges.with_shared_normals(chosen.outline, self.points, chosen.normals)

    def _hubs(self, chosen: Chosen, numbers: list[int]) -> list[int]:
        """The loops over which one vertex is enough."""
        plain = self.options.get("equation", "harmonic") in ("harmonic", "automatic")
        if self.in_rows or self.length.length or not plain or self.options.get("continuity", "G1") != "G1":
            return []
        loops, rows = chosen.outline.loops, chosen.outline.split(chosen.normals)
        fit = [k for k in numbers if len(loops[k]) < 9 and len(np.unique(loops[k])) == len(loops[k])]
        points = [self.points[loop] for loop in loops]
        return [k for k in fit if _hub.takes_hub(points[k], rows[k], points[k].mean(axis=0))]

    def _fans(self, chosen: Chosen, numbers: list[int]) -> tuple[dict[str, Any] | None, list[int]]:
        """The fans over these loops, and those over which they are good."""
        if not numbers:
            return None, []
        part = chosen.part(numbers)
        outline, rows = part.outline, part.outline.split(part.normals)
        Limit.of(float(len(numbers)), self.max_vertices).check(float(len(numbers)), outline.vertices)
        watch = Watch(self.progress)
        split = _pinches.split(outline, self.points, part.normals, False)
        hubs = np.stack([self.points[loop].mean(axis=0) for loop in outline.loops])
        triangles = read_only(_hub.fans(split.outline.loops, split.count))
        patch = Patch(np.concatenate([split.points, hubs]), triangles, split.outline.vertices, part.normals)
        options = {**self.options, "otherwise": "stop"}
        report = patch.faired("given", self.around, options, watch.part(0.0, 1.0))
        found = report.vertices[split.count :]
        good = [
            _hub.takes_hub(self.points[loop], row, hub)
            for loop, row, hub in zip(outline.loops, rows, found, strict=True)
        ]
        if not report.converged or not all(good):
            kept = [k for k, fits in zip(numbers, good, strict=True) if fits] if report.converged else []
            return self._fans(chosen, kept)
        values = report_fields(report, split.count)
        watch.lap("fans")
        values["seconds"] = {**values["seconds"], **watch.seconds}
        return split.welded({**values, "triangles": patch.triangles}), numbers

    def _is_single(self, loop: IntArray) -> bool:
        return _single_face.is_single(self.points[loop], self.length.length)

    def _single_faces(self, chosen: Chosen) -> dict[str, Any]:
        loops = chosen.outline.loops
        rows = chosen.outline.split(chosen.normals)
        edges = _single_face.edges_among(self.around, chosen.outline.vertices)
        faces = [_single_face.face_over(each, self.points, row, edges) for each, row in zip(loops, rows, strict=True)]
        _loops.check_doubles(np.concatenate(faces), self.around)
        angles = [
            _single_face.angles_at(loop, self.points, row, face)
            for loop, row, face in zip(loops, rows, faces, strict=True)
        ]
        values = _single_face.fields_of(faces, angles, loops, self.around, self.points)
        equation, continuity = (self.options.get(*each) for each in (("equation", "harmonic"), ("continuity", "G1")))
        arrays = {name: read_only(array) for name, array in values.items()}
        return {**_single_face.report_of(str(equation), str(continuity)), **arrays}

    def _each_solved(self, chosen: Chosen, numbers: list[int], progress: Progress | None) -> list[dict[str, Any]]:
        """Surfaces with vertices inside: all in one solve, but one by one where each has its own pattern of quads."""
        if not self.in_rows or self.bridge:
            return [self._solved(chosen.part(numbers), progress)] if numbers else []
        watch = Watch(progress)
        return [
            self._solved(chosen.part([number]), watch.part(k / len(numbers), (k + 1) / len(numbers)))
            for k, number in enumerate(numbers)
        ]

    def _solved(self, chosen: Chosen, progress: Progress | None) -> dict[str, Any]:
        """The same without curves, where there are vertices inside."""
        options, bridge, length = dict(self.options), self.bridge, self.length
        normals = self._shared(chosen)
        split = _pinches.split(chosen.outline, self.points, normals, bridge)
        outline, points, around = split.outline, split.parted, self.around
        rims = [points[loop] for loop in outline.loops]
        most = Limit.of(_holes.flat_count(rims, length.length, bridge), self.max_vertices)
        least = most.flat if bridge else _holes.least_count(rims, outline.split(chosen.normals), length.length)
        most.check(least, chosen.outline.vertices)
        if chosen.curvatures is not None:
            options["fixed_curvatures"] = chosen.curvatures
        watch = Watch(progress)
        first = _first_surface(points, outline, normals, bridge, options, watch.part(0, 0.2))
        watch.lap("first")
        slopes = None if options.get("equation") == "minimal" else normals
        patch = Patch(np.concatenate([points, first["vertices"]]), first["triangles"], outline.vertices, slopes)
        count = patch.expected_count(length)
        most.check(count, chosen.outline.vertices, first["converged"])
        fine, _ = patch.remeshed(split.count, length, LEAST_COUNT, options, watch.part(0.2, 0.4))
        fine = fine.with_old(split.points)
        watch.lap("mesh")
        _loops.check_doubles(fine.triangles, around)
        coarser = count < 0.9 * LEAST_COUNT * (1 if bridge else len(outline.loops))
        trying = options if first["converged"] else {**options, "otherwise": "stop"}  # it was sought in vain once
        report = fine.faired(_start(first["start"], options), around, trying, watch.part(0.4, 0.9 if coarser else 1.0))
        values = report_fields(report, split.count)
        values["warnings"] += not_tangent(report, outline, split.points, around)
        solved = Patch(report.vertices, fine.triangles, outline.vertices, slopes)
        rows = rows_over(solved, split.count, watch.part(0.9, 1.0)) if self.in_rows else None
        if self.in_rows and rows is None:
            values["warnings"] += (no_rows(outline.vertices, "several" if len(outline.loops) > 2 else "shape"),)
        if rows is not None:
            values.update(_on_rows(rows, (report, solved), around, trying, split.count))
        elif coarser:
            coarse, origin = solved.remeshed(split.count, length, 0, options, watch.part(0.9, 1.0))
            values.update(cut_fields(coarse, split.count))
            values["mean_curvature"] = carried(report.mean_curvature, fine.triangles, origin)
        else:
            values["triangles"] = fine.triangles
        watch.lap("coarser")
        values["seconds"] = {**values["seconds"], **watch.seconds}
        return split.welded(values)


def _on_rows(
    rows: Rows, solved: tuple[FairResult, Patch], around: IntArray, options: dict[str, Any], old_count: int
) -> dict[str, Any]:
    """The fields that a pattern changes: solved on it, or on the solved surface where it is too coarse for that."""
    report, patch = solved
    own = {"triangles": rows.patch.triangles, "pairs": rows.pairs}
    if len(rows.patch.vertices) - old_count >= 0.9 * LEAST_COUNT and report.converged:
        again = rows.patch.faired("given", around, {**options, "otherwise": "stop"}, None)
        if again.converged:
            return {**report_fields(again, old_count), **own}
    curvature = carried(report.mean_curvature, patch.triangles, rows.origin)
    return {**cut_fields(rows.patch, old_count), "mean_curvature": curvature, **own}


def _first_surface(
    points: FloatArray,
    outline: _loops.Outline,
    normals: FloatArray,
    bridge: bool,
    options: dict[str, Any],
    progress: Progress | None,
) -> Any:
    """On a coarse mesh: `vertices`, `triangles`, `converged`, and how the solve on a fine one `start`s."""
    thin = _short_edges.thinned(outline, points, normals)
    rows = thin.outline.split(thin.normals)
    try:
        found = _core.fill_loops(points, list(thin.outline.loops), rows, bridge, _first_equation(options), progress)
        return {**found, "triangles": thin.with_all(found["triangles"])}
    except MeshError as error:
        if not bridge or error.code != "NONMANIFOLD_EDGE":
            raise
        raise _sides.not_joined(outline, points, normals) from error


def _start(first: str, options: dict[str, Any]) -> str:
    """Where the solve on the fine mesh begins; ``first``: what suits the first surface, which is a harmonic one.

    Automatic chooses that of least variation by itself: there it stands in for nothing.
    """
    equation = options.get("equation", "harmonic")
    chosen = equation == "automatic" and first == "least_variation"
    same = equation in ("harmonic", "automatic") and options.get("otherwise") != "stop" and not chosen
    return first if same else "given"


def _first_equation(options: dict[str, Any]) -> str:
    """Of the first surface: harmonic but for the equation that joins what no harmonic surface does."""
    asked = str(options.get("equation", "harmonic"))
    joins_curvature = options.get("continuity", "G1") == "G2"
    own = asked in ("least_variation", "minimal") or (asked == "automatic" and not joins_curvature)
    return asked if own else "harmonic"
