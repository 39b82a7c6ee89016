"""What is done with one file."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from fairing._borders import outer_borders
from fairing._hard_edges import hard_edges
from fairing._hole_loops import hole_loops
from fairing._measure import self_intersections
from fairing._types import Cancelled, FloatArray, IntArray, SolverError
from fairing.command import files
from fairing.command.verdict import GOOD, UNUSABLE, judged
from fairing.objects import fair_faces, fill_holes, fillet_edges
from fairing.objects.hosts import opened

Report = dict[str, Any]
Progress = Callable[[float, str], "bool | None"]
SUFFIX = {"fill": "_filled", "fair": "_fair", "fillet": "_fillet"}
_OPTIONS = {
    "fill": ("longest", "longest_length", "bridge", "spacing", "faces", "edges", "continuity", "equation", "threads"),
    "fair": ("continuity", "equation", "detail", "feather", "side", "threads"),
    "fillet": ("width", "width_2", "profile", "spacing", "faces", "continuity", "threads"),
}


def done_with(source: Path, target: Path | None, given: Namespace, progress: Progress | None) -> Report:
    """Read the file, work, write; never raises but for a bug: what is wrong with a file is in its report."""
    begin = time.perf_counter()
    report: Report = {"file": str(source)}
    try:
        if target is None:
            report.update(verdict=GOOD, **measured(files.read(source, files.library_for(source, source))))
        else:
            report.update(_made(source, target, given, progress))
    except (ValueError, OSError, SolverError, MemoryError) as error:
        report.update(verdict=UNUSABLE, reason=str(error), code=getattr(error, "code", type(error).__name__))
    except Cancelled:
        report.update(verdict=UNUSABLE, reason="cancelled", code="Cancelled")
    report["seconds"] = round(time.perf_counter() - begin, 3)
    return report


def _made(source: Path, target: Path, given: Namespace, progress: Progress | None) -> Report:
    mesh = files.read(source, files.library_for(source, target))
    options = {name: value for name in _OPTIONS[given.command] if (value := getattr(given, name)) is not None}
    options["progress"] = progress
    if given.command == "fill":
        made: Any = fill_holes(mesh, **options)
    elif given.command == "fair":
        made = fair_faces(mesh, selection(mesh, given), **options)
    else:
        made = fillet_edges(mesh, **options)
    verdict, reason = judged(made.result)
    report = {"verdict": verdict, "reason": reason, **_figures(made.result)}
    if verdict != UNUSABLE or given.accept_all:
        files.write(made.mesh, target)
        report["written"] = str(target)
    return report


def _figures(result: Any) -> Report:
    return {
        "converged": bool(result.converged),
        "termination": result.termination,
        "equation": result.equation,
        "provenance": result.provenance,
        "vertices": len(result.vertices),
        "worst_join": round(float(np.max(result.join, initial=0.0)), 3),
        "worst_boundary_angle": round(float(np.max(result.boundary_angle, initial=0.0)), 3),
        "left_open": len(getattr(result, "left_open", ())),
        "warnings": [
            {"code": each.code, "message": each.message, "figures": dict(each.figures)} for each in result.warnings
        ],
    }


def selection(mesh: Any, given: Namespace) -> Any:
    """The faces that the arguments name."""
    if given.select is not None:
        return given.select
    if given.faces is not None:
        return np.loadtxt(given.faces, dtype=np.int64, ndmin=1)
    parts, _ = opened(mesh)
    middle = np.add.reduceat(parts.points[parts.faces.corners], parts.faces.first) / parts.faces.sizes[:, None]
    return np.linalg.norm(middle - given.sphere[:3], axis=1) < given.sphere[3]


def measured(mesh: Any) -> Report:
    """What there is to fill, to round and to mend."""
    parts, _ = opened(mesh)
    triangles = parts.triangles
    found = hole_loops(parts.points, triangles)
    outer = outer_borders(parts.points, triangles, found.loops) if found.loops else np.zeros(0, bool)
    holes = [loop for loop, is_outer in zip(found.loops, outer, strict=True) if not is_outer]
    return {
        "vertices": len(parts.points),
        "faces": len(parts.faces.sizes),
        "holes": [{"edges": len(loop), "length": round(_length(parts.points, loop), 6)} for loop in holes],
        "outer_borders": int(outer.sum()),
        "torn_borders": len(found.torn),
        "hard_edges": len(hard_edges(parts.points, triangles)),
        "crossing_triangles": len(np.unique(self_intersections(parts.points, triangles))),
    }


def _length(points: FloatArray, loop: IntArray) -> float:
    return float(np.linalg.norm(points[loop] - points[np.roll(loop, -1)], axis=1).sum())
