"""`blender --background FILE --command fair …`: fairing without a window."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np

from ..arrays.border import Left
from ..arrays.types import Floats, Ints, Mask
from ..fair.engine import REFUSALS
from ..fair.script import fair_faces
from ..fill.report import make_fill_report
from ..fill.script import fill_borders
from ..fillet.script import fillet_edges
from ..mesh.columns import column, faces_within
from ..mesh.weights import group_weights
from ..options.options import FairOptions
from ..options.other_options import FillOptions
from ..verdict.report import Report, make_report, summary
from ..verdict.verdict import UNUSABLE
from .cli_parser import fillet_options, parse

WRITTEN, NOT_USABLE, REFUSED = 0, 1, 2


def _mesh_object(name: str) -> bpy.types.Object:
    obj = bpy.data.objects.get(name)
    if obj is None or obj.type != "MESH":
        raise ValueError(f"--object: the file has no mesh object named {name!r}")
    return obj


def _members(obj: bpy.types.Object, group: str) -> Mask:
    if group not in obj.vertex_groups:
        raise ValueError(f"--vertex-group: {obj.name} has no vertex group named {group!r}")
    return group_weights(obj.data, obj.vertex_groups[group].index) > 0.0


def _faces(obj: bpy.types.Object, group: str | None) -> Ints:
    if group is None:
        return np.flatnonzero(column(obj.data.polygons, "select", 1, bool))
    return faces_within(obj.data, _members(obj, group))


def _figures(report: Report, left: Sequence[Left]) -> dict[str, Any]:
    return {
        "verdict": report.verdict.grade,
        "reason": report.verdict.reason,
        "written": report.written,
        "free_vertices": report.free_vertices,
        "converged": report.converged,
        "residual": report.residual,
        "boundary_angle": report.boundary_angle,
        "join_typical": report.join[0],
        "join_worst": report.join[1],
        "texture_distortion": report.distortion,
        "seconds": report.seconds,
        "checks": {check.name: {"value": check.value, "state": check.state} for check in report.checks},
        "warnings": list(report.warnings),
        "left_open": [{"vertices": each.vertices.tolist(), "reason": each.reason} for each in left],
    }


def _print(report: Report, left: Sequence[Left], form: str) -> None:
    if form == "json":
        print(json.dumps(_figures(report, left)))
        return
    print(summary(report))
    for check in report.checks:
        print(f"  {check.state.lower():6}  {check.name}: {check.value}")
    for warning in report.warnings:
        print(f"  warning: {warning}")


class _Progress:
    """Prints a line to stderr for each whole per cent and each stage."""

    def __init__(self) -> None:
        self._last = ""

    def __call__(self, fraction: float, stage: str) -> None:
        line = f"{100 * fraction:3.0f} % {stage}"
        if line != self._last:
            print(line, file=sys.stderr)
        self._last = line


def execute(arguments: list[str]) -> int:
    chosen = parse(arguments)
    try:
        if chosen.fillet:
            return _rounded(chosen)
        report, left = _filled(chosen) if chosen.fill else (_faired(chosen), ())
    except REFUSALS as error:
        print(f"fair: {error}", file=sys.stderr)
        return REFUSED
    if report.written:
        bpy.ops.wm.save_as_mainfile(filepath=chosen.output, copy=True)
    _print(report, left, chosen.report)
    return NOT_USABLE if report.verdict.grade == UNUSABLE else WRITTEN


def _faired(chosen: Any) -> Report:
    options = FairOptions.of(chosen)
    obj = _mesh_object(chosen.object)
    faces = _faces(obj, chosen.region_group).tolist()
    begin = time.perf_counter()
    outcome = fair_faces(obj.data, faces, _matrix(obj), options, _Progress())
    return make_report([(obj.name, outcome)], options, time.perf_counter() - begin)


def _filled(chosen: Any) -> tuple[Report, Sequence[Left]]:
    options = FillOptions.of(chosen)
    obj = _mesh_object(chosen.object)
    group = chosen.region_group
    vertices = None if group is None else np.flatnonzero(_members(obj, group)).tolist()
    begin = time.perf_counter()
    done = fill_borders(obj.data, vertices, _matrix(obj), options, _Progress())
    added = [] if done.added is None else [done.added]
    seconds = time.perf_counter() - begin
    return make_fill_report([(obj.name, done.filled)], options, seconds, added, done.notes), done.filled.left


def _rounded(chosen: Any) -> int:
    """Round edges, write the file, and print how it went; returns the exit status."""
    options = fillet_options(chosen)
    obj = _mesh_object(chosen.object)
    edges = None
    if chosen.region_group is not None:
        member = _members(obj, chosen.region_group)
        edges = [edge.index for edge in obj.data.edges if all(member[v] for v in edge.vertices)]
    begin = time.perf_counter()
    outcome = fillet_edges(obj.data, edges, _matrix(obj), options, _Progress())
    usable = outcome.verdict.grade != UNUSABLE
    if usable:
        bpy.ops.wm.save_as_mainfile(filepath=chosen.output, copy=True)
    figures = {
        "verdict": outcome.verdict.grade,
        "reason": outcome.verdict.reason,
        "written": usable,
        "new_vertices": len(outcome.result.vertices),
        "seam_edges": len(outcome.result.seam),
        "seconds": time.perf_counter() - begin,
        "warnings": list(outcome.warnings),
    }
    lines = [f"{name}: {value}" for name, value in figures.items() if value not in ("", [])]
    print(json.dumps(figures) if chosen.report == "json" else "\n".join(lines))
    return WRITTEN if usable else NOT_USABLE


def _matrix(obj: bpy.types.Object) -> Floats:
    return np.array(obj.matrix_world, dtype=np.float64)
