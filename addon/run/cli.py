"""`blender --background FILE --command fair …`: fairing without a window."""

from __future__ import annotations

import argparse
import json
import sys
import time
from typing import Any

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.engine import REFUSALS
from ..core.fill_report import make_fill_report
from ..core.filling import FillOptions
from ..core.options import FairOptions, option_names
from ..core.report import Report, make_report, summary
from ..core.verdict import UNUSABLE
from .fair_mesh import fair_faces
from .fill_mesh import fill_borders

WRITTEN, NOT_USABLE, REFUSED = 0, 1, 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="blender --background FILE --command fair",
        description="Fair faces of a mesh, or fill its holes. Exit status: 0 done, 1 the result is not usable (written "
        "only with --accept ALL), 2 refused.",
    )
    parser.add_argument("--object", required=True, help="name of the mesh object")
    parser.add_argument(
        "--vertex-group",
        help="fair the faces inside this vertex group; default: the faces that are selected in the file. With --fill: "
        "fill the holes that have a vertex in it; default: all",
    )
    parser.add_argument("--fill", action="store_true", help="fill holes instead")
    parser.add_argument("--bridge", action="store_true", help="with --fill: join their boundary loops in one surface")
    parser.add_argument("--hard-edges", default="RUN_ON", help="with --fill: IGNORED rounds them off")
    parser.add_argument("--output", required=True, help="the .blend file to write")
    parser.add_argument("--report", choices=("text", "json"), default="text")
    defaults = FairOptions()
    for name in option_names():
        value = getattr(defaults, name)
        flag = "--" + name.replace("_", "-")
        if isinstance(value, bool):
            parser.add_argument(flag, dest=name, action="store_true")
        else:
            parser.add_argument(flag, dest=name, type=type(value), default=value)
    return parser


def _mesh_object(name: str) -> bpy.types.Object:
    obj = bpy.data.objects.get(name)
    if obj is None or obj.type != "MESH":
        raise ValueError(f"--object: the file has no mesh object named {name!r}")
    return obj


def _members(obj: bpy.types.Object, group: str) -> list[bool]:
    """Return for each vertex whether it is in the vertex group."""
    if group not in obj.vertex_groups:
        raise ValueError(f"--vertex-group: {obj.name} has no vertex group named {group!r}")
    index = obj.vertex_groups[group].index
    return [any(e.group == index and e.weight > 0.0 for e in v.groups) for v in obj.data.vertices]


def _faces(obj: bpy.types.Object, group: str | None) -> list[int]:
    polygons = obj.data.polygons
    if group is None:
        return [polygon.index for polygon in polygons if polygon.select]
    member = _members(obj, group)
    return [polygon.index for polygon in polygons if all(member[v] for v in polygon.vertices)]


def _figures(report: Report) -> dict[str, Any]:
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
    }


def _print(report: Report, form: str) -> None:
    if form == "json":
        print(json.dumps(_figures(report)))
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
    """Run the command and return its exit status."""
    chosen = _parser().parse_args(arguments)
    try:
        report = _filled(chosen) if chosen.fill else _faired(chosen)
    except REFUSALS as error:
        print(f"fair: {error}", file=sys.stderr)
        return REFUSED
    if report.written:
        bpy.ops.wm.save_as_mainfile(filepath=chosen.output, copy=True)
    _print(report, chosen.report)
    return NOT_USABLE if report.verdict.grade == UNUSABLE else WRITTEN


def _faired(chosen: Any) -> Report:
    options = FairOptions.of(chosen)
    obj = _mesh_object(chosen.object)
    faces = _faces(obj, chosen.vertex_group)
    begin = time.perf_counter()
    outcome = fair_faces(obj.data, faces, _matrix(obj), options, _Progress())
    return make_report([(obj.name, outcome)], options, time.perf_counter() - begin)


def _filled(chosen: Any) -> Report:
    options = FillOptions.of(chosen)
    obj = _mesh_object(chosen.object)
    group = chosen.vertex_group
    vertices = None if group is None else np.flatnonzero(_members(obj, group)).tolist()
    begin = time.perf_counter()
    done = fill_borders(obj.data, vertices, _matrix(obj), options, _Progress())
    added = [] if done.added is None else [done.added]
    return make_fill_report([(obj.name, done.pieces)], options, time.perf_counter() - begin, added, done.notes)


def _matrix(obj: bpy.types.Object) -> Floats:
    return np.array(obj.matrix_world, dtype=np.float64)
