"""A run as a list of figures, each met, missed or just told. Plain Python, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .options import FairOptions
from .outcome import Fairing
from .words import counted

SMOOTH_ANGLE = 2.0  # degrees at the outline that the eye takes for tangent
ANGLE = "Angle at the outline"
CURVATURE_SLACK = 1.01  # of the outline's largest |H|: discretisation

MET, MISSED, TOLD = "MET", "MISSED", "TOLD"


@dataclass(frozen=True)
class Check:
    """One line of the report."""

    name: str
    value: str
    state: str  # MET, MISSED or TOLD


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


def make_report(
    named: list[tuple[str, Fairing]], options: FairOptions, seconds: float, notes: tuple[str, ...] = ()
) -> Report:
    """Sum up the outcomes of one run, by object name; `seconds` as the user waited, `notes` on other objects."""
    outcomes = [outcome for _, outcome in named]
    results = [outcome.result for outcome in outcomes]
    sizes = [len(outcome.vertices) for outcome in outcomes]
    return Report(
        objects=tuple(name for name, _ in named),
        free_vertices=sum(sizes),
        converged=all(result.converged for result in results),
        residual=max(result.residual for result in results),
        boundary_angle=max(float(result.boundary_angle.max(initial=0.0)) for result in results),
        distortion=float(np.average([outcome.distortion for outcome in outcomes], weights=sizes)),
        seconds=seconds,
        checks=_checks(outcomes, options),
        warnings=_warnings(named) + _bulge_note(named, options) + notes,
    )


def _warnings(named: list[tuple[str, Fairing]]) -> tuple[str, ...]:
    several = len(named) > 1
    return tuple(f"{name}: {text}" if several else text for name, outcome in named for text in outcome.warnings)


def _bulge_note(named: list[tuple[str, Fairing]], options: FairOptions) -> tuple[str, ...]:
    """Explain the usual reason why a bulge isn't found: there is no such surface."""
    results = [outcome.result for _, outcome in named]
    found = all(result.converged or result.termination == "folded" for result in results)
    if options.equation != "CONSTANT" or options.bulge == 0.0 or found:
        return ()
    return (
        f"There may be no surface with a bulge of {options.bulge:g} on this outline: half a sphere has none "
        "above 0.06, a flat disc none above 1.15. Try less",
    )


def _state(met: bool) -> str:
    return MET if met else MISSED


def _checks(outcomes: list[Fairing], options: FairOptions) -> tuple[Check, ...]:
    results = [outcome.result for outcome in outcomes]
    widest = max(float(result.boundary_angle.max(initial=0.0)) for result in results)
    return (
        Check("Equation solved", _endings(outcomes), _state(all(result.converged for result in results))),
        *((_angle_check(widest),) if options.equation != "MINIMAL" else ()),  # a soap film promises positions only
        _curvature_check(outcomes),
        Check("Residual", _residual_text(max(results, key=lambda result: result.residual)), TOLD),
        _count_check("Flipped triangles", [(o.before.flipped, o.after.flipped) for o in outcomes]),
        _count_check("Degenerate triangles", [(o.before.degenerate, o.after.degenerate) for o in outcomes]),
        _count_check("Self-intersections", [(o.before.intersections, o.after.intersections) for o in outcomes]),
        Check("Texture distortion", f"{max(o.distortion for o in outcomes):.1%}", TOLD),
    )


def _endings(outcomes: list[Fairing]) -> str:
    words = {
        "converged": "yes",
        "iteration_limit": "out of iterations",
        "stalled": "no further progress",
        "folded": "found, but with folds",
    }
    endings = dict.fromkeys(outcome.result.termination for outcome in outcomes)
    told = ", ".join(words[ending] for ending in endings)
    # Then the vertices lie on a surface that was computed on the engine's own mesh.
    by_proxy = any(outcome.result.converged and not outcome.result.polished for outcome in outcomes)
    return f"{told}, on a proxy" if by_proxy else told


def _residual_text(result: fairing.FairResult) -> str:
    """Say how far down the residual came: alone its size, which grows with the mesh's resolution, tells little."""
    return f"{result.initial_residual:.0e} → {result.residual:.0e}"


def _angle_check(degrees: float) -> Check:
    return Check(ANGLE, angle_text(degrees), _state(degrees <= SMOOTH_ANGLE))


def _curvature_check(outcomes: list[Fairing]) -> Check:
    """Compare the largest |H| inside with the outline's: a harmonic H has its extremes there (maximum principle)."""
    name = "Curvature inside"
    inside, outline = max((o.curvature for o in outcomes), key=lambda pair: pair[0] - pair[1])
    value = f"{inside:.3g} {'≤' if inside <= outline else '>'} {outline:.3g}"
    if any(outcome.result.equation != "harmonic" for outcome in outcomes):
        return Check(name, value, TOLD)
    return Check(name, value, _state(inside <= CURVATURE_SLACK * outline))


def _count_check(name: str, counts: list[tuple[int | None, int | None]]) -> Check:
    """Compare counts before and after; None before: not looked for, as there are none after."""
    after = sum(new or 0 for _, new in counts)
    known = [old for old, _ in counts if old is not None]
    value = f"{sum(known)} → {after}" if len(known) == len(counts) else f"{after}"
    return Check(name, value, _state(all((new or 0) <= (old or 0) for old, new in counts)))


def angle_text(degrees: float) -> str:
    """Return an angle with two digits that count, and with more where it would look like the limit that it misses."""
    if degrees >= 10.0:
        return f"{degrees:.0f}°"
    digits = 2
    while degrees > SMOOTH_ANGLE >= float(f"{degrees:.{digits}g}"):
        digits += 1
    return f"{degrees:.{digits}g}°"


def summary(report: Report) -> str:
    """Return the one line that the status bar shows."""
    state = "Faired" if report.converged else "Not converged:"
    text = f"{state} {counted(report.free_vertices, 'vertex', 'vertices')} in {report.seconds:.2f} s"
    if all(check.name != ANGLE for check in report.checks):
        return text
    return f"{text}, largest angle at the outline {angle_text(report.boundary_angle)}"
