"""`blender --background FILE --command fair …`: fairing without a window."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterable, Sequence
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
from ..options.other_options import FilletOptions, FillOptions
from ..options.table import Option, table
from ..verdict.report import Report, make_report
from ..verdict.verdict import UNUSABLE

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
        run = _rounded if chosen.fillet else _filled if chosen.fill else _faired
        figures = run(chosen)
    except REFUSALS as error:
        print(f"fair: {error}", file=sys.stderr)
        return REFUSED
    if figures["written"]:
        bpy.ops.wm.save_as_mainfile(filepath=chosen.output, copy=True)
    lines = [f"{name}: {value}" for name, value in figures.items() if value not in ("", [])]
    print(json.dumps(figures) if chosen.report == "json" else "\n".join(lines))
    return NOT_USABLE if figures["verdict"] == UNUSABLE else WRITTEN


def _faired(chosen: Any) -> dict[str, Any]:
    options, obj, begin = FairOptions.of(chosen), _mesh_object(chosen.object), time.perf_counter()
    outcome = fair_faces(obj.data, _faces(obj, chosen.region_group).tolist(), _matrix(obj), options, _Progress())
    return _figures(make_report([(obj.name, outcome)], options, time.perf_counter() - begin), ())


def _filled(chosen: Any) -> dict[str, Any]:
    options, obj, begin = FillOptions.of(chosen), _mesh_object(chosen.object), time.perf_counter()
    group = chosen.region_group
    vertices = None if group is None else np.flatnonzero(_members(obj, group)).tolist()
    done = fill_borders(obj.data, vertices, _matrix(obj), options, _Progress())
    added = [] if done.added is None else [done.added]
    seconds = time.perf_counter() - begin
    return _figures(make_fill_report([(obj.name, done.filled)], options, seconds, added, done.notes), done.filled.left)


def _rounded(chosen: Any) -> dict[str, Any]:
    options, obj, begin = fillet_options(chosen), _mesh_object(chosen.object), time.perf_counter()
    edges = None
    if chosen.region_group is not None:
        member = _members(obj, chosen.region_group)
        edges = np.flatnonzero(member[column(obj.data.edges, "vertices", 2, np.int32)].all(axis=1)).tolist()
    outcome = fillet_edges(obj.data, edges, _matrix(obj), options, _Progress())
    return {
        "verdict": outcome.verdict.grade,
        "reason": outcome.verdict.reason,
        "written": outcome.verdict.grade != UNUSABLE,
        "new_vertices": len(outcome.result.vertices),
        "seam_edges": len(outcome.result.seam),
        "seconds": time.perf_counter() - begin,
        "warnings": list(outcome.warnings),
    }


def _matrix(obj: bpy.types.Object) -> Floats:
    return np.array(obj.matrix_world, dtype=np.float64)


EDGE_LENGTH = "edge_length"  # the fillet's spacing, which is a length


def parse(arguments: list[str]) -> Any:
    """Return what was asked for, with every option by its name."""
    return _parser().parse_args(arguments)


def fillet_options(chosen: Any) -> FilletOptions:
    """Return the options of fillets."""
    names = [option.name for option in table(FilletOptions)]
    return FilletOptions(**{name: getattr(chosen, EDGE_LENGTH if name == "spacing" else name) for name in names})


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="blender --background FILE --command fair",
        description="Fair faces of a mesh, fill its holes or round its edges. Exit status: 0 done, 1 the result is not "
        "usable (written only with --allow-folds), 2 refused.",
    )
    parser.add_argument("--object", required=True, help="name of the mesh object")
    parser.add_argument(
        "--vertex-group",
        dest="region_group",
        help="fair the faces inside this vertex group; default: the faces that are selected in the file. With --fill: "
        "fill the holes that have a vertex in it; with --fillet: round the edges inside it; default: all holes, all "
        "hard edges",
    )
    parser.add_argument("--fill", action="store_true", help="fill holes instead")
    parser.add_argument("--fillet", action="store_true", help="round edges instead")
    parser.add_argument("--output", required=True, help="the .blend file to write")
    parser.add_argument("--report", choices=("text", "json"), default="text")
    known: set[str] = set()
    for of, when in ((FairOptions, ""), (FillOptions, "with --fill: "), (FilletOptions, "with --fillet: ")):
        _add(parser, (option for option in table(of) if option.name not in known), when)
        known |= {option.name for option in table(of)}
    spacing = next(option for option in table(FilletOptions) if option.name == "spacing")
    parser.add_argument("--edge-length", type=float, default=spacing.default, help=f"with --fillet: {_help(spacing)}")
    return parser


def _add(parser: argparse.ArgumentParser, options: Iterable[Option], when: str) -> None:
    for option in options:
        kind: dict[str, Any] = {"type": type(option.default)}
        if isinstance(option.default, bool):
            kind = {"action": argparse.BooleanOptionalAction}
        flag = "--factor-group" if option.name == "vertex_group" else "--" + option.name.replace("_", "-")
        parser.add_argument(flag, dest=option.name, default=option.default, help=when + _help(option), **kind)


def _help(option: Option) -> str:
    accepted = f" ({', '.join(item[0] for item in option.items)})" if option.items else ""
    return (option.description + accepted).replace("%", "%%")
