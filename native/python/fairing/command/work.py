"""What is done with one file, and whether the result may be used without looking at it."""

from __future__ import annotations

import shutil
import sys
import time
from argparse import Namespace
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np

from fairing import looks
from fairing.borders import hole_loops, outer_borders
from fairing.command import files
from fairing.measure import hard_edges, self_intersections
from fairing.objects.calls import Made, fair_faces, fill_accepted, fillet_edges, once
from fairing.objects.parts import Parts
from fairing.results import FOLDS, Cancelled, FillResult, FloatArray, Hole, IntArray, MeshError, Progress, SolverError

GOOD, LOOK, UNUSABLE = "good", "look", "unusable"
Report = dict[str, Any]
_NOTHING = {"NO_BOUNDARY", "NOT_A_HOLE"}  # codes of a mesh without holes
SUFFIX = {"fill": "_filled", "fair": "_fair", "fillet": "_fillet"}
_OPTIONS = {
    "fill": ("longest", "longest_length", "bridge", "spacing", "faces", "edges", "continuity", "equation", "threads"),
    "fair": ("continuity", "equation", "detail", "feather", "side", "threads"),
    "fillet": ("width", "width_2", "profile", "spacing", "faces", "continuity", "threads"),
}


def done_with(file: Path | str, to: Path | str | None, given: Namespace, progress: Progress | None) -> Report:
    """Read the file, work, write; never raises but for a bug: what is wrong with a file is in its report."""
    begin = time.perf_counter()
    report: Report = {"file": str(file)}
    source, target = Path(file), None if to is None else Path(to)
    try:
        with redirect_stdout(sys.stderr):  # libraries that read files print what they like
            parts, write = files.read(source)
            if target is None:
                report.update(verdict=GOOD, **measured(parts))
            else:
                files.check(target.suffix.lower())
                target.parent.mkdir(parents=True, exist_ok=True)
                report.update(_made((source, parts, write), target, given, progress))
    except (ValueError, OSError, SolverError, MemoryError) as error:
        report.update(verdict=UNUSABLE, reason=str(error), code=getattr(error, "code", type(error).__name__))
    except Cancelled:
        report.update(verdict=UNUSABLE, reason="cancelled", code="Cancelled")
    report["seconds"] = round(time.perf_counter() - begin, 3)
    return report


def _made(opened: tuple[Path, Parts, files.Write], target: Path, given: Namespace, progress: Progress | None) -> Report:
    source, parts, write = opened
    options = {name: value for name in _OPTIONS[given.command] if (value := getattr(given, name)) is not None}
    options["progress"] = progress
    try:
        made, report = _worked(parts, given, options)
    except MeshError as error:
        if error.code not in _NOTHING or given.command != "fill" or given.bridge:
            raise
        if source.suffix.lower() == target.suffix.lower():
            shutil.copyfile(source, target)
        else:
            write(target, parts)
        return {"verdict": GOOD, "reason": f"nothing to fill: {error.diagnostic.message}", "written": str(target)}
    report |= _figures(made.result)
    if report["verdict"] != UNUSABLE or given.accept_all:
        report["not_written"] = sorted({name.strip("\0") for name in write(target, made.mesh)} - {"place"})
        report["written"] = str(target)
    return report


def _worked(parts: Parts, given: Namespace, options: dict[str, Any]) -> tuple[Made[Any], Report]:
    """Holes whose surface can't be used stay open."""
    if given.command == "fill":
        made = fill_accepted(parts, lambda each: given.accept_all or judged(each)[0] != UNUSABLE, **options)
        verdict, reason, each = judged_holes(made.result)
        holes = [_hole(parts, *row) for row in zip(made.result.holes, each, strict=True)]
        return made, {"verdict": verdict, "reason": reason, "holes": holes}
    done: Made[Any]
    done = (
        fair_faces(parts, selection(parts, given), **options)
        if given.command == "fair"
        else fillet_edges(parts, **options)
    )
    verdict, reason = judged(done.result)
    return done, {"verdict": verdict, "reason": reason}


def _hole(parts: Parts, hole: Hole, verdict: tuple[str, str]) -> Report:
    around = np.concatenate(hole.loops)
    at = parts.points[around].mean(axis=0).round(6).tolist()
    return {"edges": len(around), "at": at, "verdict": verdict[0], "reason": verdict[1]}


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
            {"code": each.code, "message": each.message, "figures": dict(each.figures), "count": count}
            for each, count in once(result.warnings)
        ],
    }


def selection(parts: Parts, given: Namespace) -> Any:
    """The faces that the arguments name."""
    if given.select is not None:
        return given.select
    if given.faces is not None:
        return np.loadtxt(given.faces, dtype=np.int64, ndmin=1)
    middle = np.add.reduceat(parts.points[parts.faces.corners], parts.faces.first) / parts.faces.sizes[:, None]
    return np.linalg.norm(middle - given.sphere[:3], axis=1) < given.sphere[3]


def measured(parts: Parts) -> Report:
    """What there is to fill, to round and to mend."""
    triangles = parts.triangles[parts.sound]
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


def judged(result: Any) -> tuple[str, str]:
    """GOOD, LOOK or UNUSABLE, and why; of what `fair`, `fill` or `fillet` give back."""
    broken = [each for each in result.warnings if each.code in FOLDS and "others" not in each.figures]
    share = np.count_nonzero(result.join > looks.LIMITS["visible_kink"]) / max(len(result.join), 1)
    kinked = share > looks.LIMITS["kink_share"]
    name = looks.fault(result, folded=bool(broken), crossing=False, kinked=kinked)
    if name in looks.UNUSABLE:
        return UNUSABLE, broken[0].message if broken else f"no surface was found: {result.termination}"
    return (LOOK if name else GOOD), name.replace("_", " ")


def judged_holes(result: FillResult) -> tuple[str, str, list[tuple[str, str]]]:
    """The same of all holes together, and of each."""
    each = [_of_hole(hole) for hole in result.holes]
    bad, odd = ([reason for grade, reason in each if grade == wanted] for wanted in (UNUSABLE, LOOK))
    odd += [warning.message for warning in result.warnings if "others" in warning.figures]
    notes = [reason for grade, reason in each if grade == GOOD and reason]
    reasons = [f"{len(bad)} of {len(each)} holes can't be filled: {bad[0]}"] if bad else []
    grade = UNUSABLE if bad and len(bad) + len(notes) == len(each) else LOOK if bad or odd else GOOD
    return grade, "; ".join(reasons + odd[:1] + notes[:1]), each


def _of_hole(hole: Hole) -> tuple[str, str]:
    if hole.surface is not None:
        return judged(hole.surface)
    because = hole.left_because
    assert because is not None
    return (GOOD if because.code in ("NOT_A_HOLE", "DEGENERATE_FACE") else UNUSABLE), because.message
