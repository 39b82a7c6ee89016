"""A run as one verdict and a list of figures. Plain Python, no bpy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.types import Ints
from ..fair.engine import Result
from ..options.options import FairOptions
from ..words.words import joined, said
from .looks import judges_join
from .outcome import Fairing
from .quality import Join, Quality
from .verdict import GOOD, GRADES, LOOK, UNUSABLE, Verdict

MET, MISSED, TOLD = "MET", "MISSED", "TOLD"
MOST_DISTORTED = 10.0  # of texture distortion; beyond, more of it means nothing
SHAPES = {"harmonic": "Harmonic", "least_variation": "Least Variation"}  # that Automatic takes, by the engine's names
GRADE_NAMES = {GOOD: "Good", LOOK: "Look here", UNUSABLE: "Not usable"}

Named = tuple[str, Fairing]


@dataclass(frozen=True)
class Check:
    """One line of the report."""

    name: str
    value: str
    state: str = TOLD  # MET, MISSED or TOLD
    detail: bool = False  # for those who want to know more


@dataclass(frozen=True)
class Report:
    """What one run over one or several objects did; of each figure the worst."""

    objects: tuple[str, ...]
    free_vertices: int
    converged: bool
    residual: float
    boundary_angle: float  # degrees
    distortion: float
    seconds: float
    checks: tuple[Check, ...]
    warnings: tuple[str, ...]
    verdict: Verdict  # of the object with the worst; its spots are that object's
    written: bool
    join: tuple[float, float]  # degrees: typical, worst
    deed: str = "done_faired"  # the sentence on what was done


def make_report(named: list[Named], options: FairOptions, seconds: float, notes: tuple[str, ...] = ()) -> Report:
    """Sum up the outcomes of one run, by object name; `seconds` as the user waited, `notes` on other objects."""
    outcomes = [outcome for _, outcome in named]
    results = [outcome.result for outcome in outcomes]
    sizes = [outcome.free_count for outcome in outcomes]
    return Report(
        objects=tuple(name for name, _ in named),
        free_vertices=sum(sizes),
        converged=all(result.converged for result in results),
        residual=max(result.residual for result in results),
        boundary_angle=max(_widest(result) for result in results),
        distortion=float(np.average([outcome.distortion for outcome in outcomes], weights=sizes)),
        seconds=seconds,
        checks=_checks(outcomes, options) + _details(outcomes),
        warnings=_warnings(named) + _bulge_note(named, options) + notes,
        verdict=_worst_verdict(named),
        written=is_written(outcomes, options),
        join=_worst_join(outcomes),
    )


def is_written(outcomes: list[Fairing], options: FairOptions) -> bool:
    """Return whether the run changes its meshes: all of them, or none."""
    return options.allow_folds or all(outcome.verdict.grade != UNUSABLE for outcome in outcomes)


def standing(report: Report) -> tuple[int, float]:
    """Return what two runs are compared by, the smaller the better: the verdict, then the worst kink in degrees."""
    return GRADES.index(report.verdict.grade), report.join[1]


def _widest(result: Result) -> float:
    return float(result.boundary_angle.max(initial=0.0))


def _worst_join(outcomes: list[Fairing]) -> tuple[float, float]:
    worst = max((outcome.join for outcome in outcomes), key=lambda join: join.worst)
    return worst.typical, worst.worst


def _worst_verdict(named: list[Named]) -> Verdict:
    name, outcome = max(named, key=lambda pair: GRADES.index(pair[1].verdict.grade))
    verdict = outcome.verdict
    if len(named) == 1 or not verdict.reason:
        return verdict
    return replace(verdict, reason=said("named", name=name, text=verdict.reason))


def _warnings(named: list[Named]) -> tuple[str, ...]:
    texts = [(name, text) for name, outcome in named for text in outcome.warnings]
    return tuple(said("named", name=name, text=text) if len(named) > 1 else text for name, text in texts)


def _bulge_note(named: list[Named], options: FairOptions) -> tuple[str, ...]:
    """Explain the usual reason why a bulge isn't found: there is no such surface."""
    results = [outcome.result for _, outcome in named]
    found = all(result.converged or result.termination == "folded" for result in results)
    if options.bulge == 0.0 or found:
        return ()
    shares = [
        warning.figures["load_share"] for r in results for warning in r.warnings if "load_share" in warning.figures
    ]
    if not shares:
        return (said("bulge_tried", bulge=options.bulge),)
    return (said("bulge_found", bulge=options.bulge, most=min(shares) * options.bulge),)


def shape_checks(results: Sequence[Result], equation: str) -> tuple[Check, ...]:
    """Return the line on the shapes that Automatic has taken; none where the shape was asked for."""
    taken = dict.fromkeys(SHAPES[result.equation] for result in results if result.equation in SHAPES)
    return (Check("Shape", ", ".join(taken)),) if equation == "automatic" and taken else ()


def _checks(outcomes: list[Fairing], options: FairOptions) -> tuple[Check, ...]:
    return (
        *shape_checks([outcome.result for outcome in outcomes], options.equation),
        *(kink_checks([outcome.join for outcome in outcomes]) if judges_join(options) else ()),
        _count_check("Folded faces", outcomes, lambda quality: quality.folded),
        _count_check("Faces that cross", outcomes, lambda quality: quality.crossing),
        Check("Texture distortion", distortion_text(max(o.distortion for o in outcomes))),
    )


def kink_checks(joins: Sequence[Join]) -> tuple[Check, ...]:
    """Return the lines on how the surfaces join what is around; none where nothing is."""
    if not any(len(join.vertices) for join in joins):
        return ()
    worst, seen = max(joins, key=lambda join: join.worst), any(len(join.seen) for join in joins)
    few = ", few" if worst.worst > worst.limit and not seen else ""
    return (
        Check("Kink at the boundary", f"≤ {angle_text(worst.worst)}{few}", _state(not seen)),
        Check("Kink limit", f"{worst.limit:.0f}°"),
    )


def _state(met: bool) -> str:
    return MET if met else MISSED


def _count_check(name: str, outcomes: list[Fairing], faces: Callable[[Quality], Ints | None]) -> Check:
    """Compare the faces before and after; None before: not looked for, as there are none after."""
    pairs = [(faces(outcome.before), faces(outcome.after)) for outcome in outcomes]
    after = sum(len(new) for _, new in pairs if new is not None)
    known = [len(old) for old, _ in pairs if old is not None]
    value = f"{sum(known)} → {after}" if len(known) == len(pairs) else f"{after}"
    added = any(new is not None and len(np.setdiff1d(new, () if old is None else old)) for old, new in pairs)
    return Check(name, value, MISSED if added else MET if after == 0 else TOLD)


def _details(outcomes: list[Fairing]) -> tuple[Check, ...]:
    """Return what is of interest where something is to be found out; none of it is good or bad by itself."""
    results = [outcome.result for outcome in outcomes]
    inside, boundary = max((o.curvature for o in outcomes), key=lambda pair: pair[0] - pair[1])
    codes = sorted({warning.code for result in results for warning in result.warnings})
    lines = (
        ("Surface found", _endings(outcomes)),
        ("Residual", _residual_text(max(results, key=lambda result: result.residual))),
        ("Usual kink", angle_text(_worst_join(outcomes)[0])),
        ("Slope error", angle_text(max(_widest(result) for result in results))),
        ("Curvature inside", f"{inside:.3g} {'≤' if inside <= boundary else '>'} {boundary:.3g}"),
        (
            "Strategies tried",
            ", ".join(f"{name} {seconds:.2f} s" for result in results for name, seconds in result.way),
        ),
        ("Codes", ", ".join(codes)),
    )
    return tuple(Check(name, value, detail=True) for name, value in lines if value)


def _endings(outcomes: list[Fairing]) -> str:
    endings = dict.fromkeys(outcome.result.termination for outcome in outcomes)
    ended = joined([said(f"ended_{ending}") for ending in endings])
    # Then the vertices lie on a surface that was computed on the proxy mesh.
    by_proxy = any(outcome.result.converged and not outcome.result.polished for outcome in outcomes)
    return said("on_proxy", ended=ended) if by_proxy else ended


def _residual_text(result: Result) -> str:
    """Say how far the residual came down: its size alone means little, since it grows with the mesh's resolution."""
    return f"{result.initial_residual:.0e} → {result.residual:.0e}"


def distortion_text(distortion: float) -> str:
    """Return it in per cent, as far as that says something: slivers in the old mesh make it as large as one likes."""
    return f"{distortion:.1%}" if distortion <= MOST_DISTORTED else f"> {MOST_DISTORTED:.0%}"


def angle_text(degrees: float) -> str:
    """Return an angle with two digits that count, and with more where it would look like the limit that it misses."""
    if degrees < 0.1:
        return "0°"
    digits = 2
    while degrees > fairing.looks.LIMITS["visible_kink"] >= float(f"{degrees:.{digits}g}"):
        digits += 1
    return f"{float(f'{degrees:.{digits}g}'):g}°"


def summary(report: Report) -> str:
    """Return the one line that the status bar shows."""
    verdict = report.verdict
    grade = said(verdict.grade)
    if not report.written:
        return said("nothing_changed", grade=grade, reason=verdict.reason)
    text = said(report.deed, grade=grade, n=report.free_vertices, seconds=report.seconds)
    return said("and_advice", reason=text, advice=verdict.reason) if verdict.reason else text
