"""What becomes of a run's answer: written and reported, or left out with a word on why."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import bpy

from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..core.report import GRADE_NAMES, Report, make_report, summary
from ..host.status import redraw_sidebars
from ..translations import translated
from . import compare, job, labels, last_run
from .report_properties import store, store_refusal

Say = Callable[[set[str], str], object]  # an operator's report


@dataclass(frozen=True)
class Asked:
    """What one run was asked for."""

    tasks: list[job.Task]
    options: FairOptions
    notes: tuple[str, ...]  # on objects that there is nothing to do for
    begin: float  # of the performance counter
    way: str = ""  # tried after a run that was not good: written only where the verdict improves


def finish(context: bpy.types.Context, asked: Asked, outcomes: list[Fairing], say: Say) -> set[str]:
    """Write and report what a run came to; return an operator's status."""
    named = [(task.object_name, outcome) for task, outcome in zip(asked.tasks, outcomes, strict=True)]
    report = make_report(named, asked.options, time.perf_counter() - asked.begin, asked.notes)
    report = labels.with_idle(report, asked.options)
    if asked.way and not last_run.is_improved_by(report):
        return _keep(context, asked.way, report, say)
    store(context.window_manager.fairing_report, report)
    last_run.remember(asked.tasks, outcomes, asked.options, report)
    if not report.written:
        last_run.select_spots(context)
        say({"ERROR"}, translated(summary(report)))
        return {"CANCELLED"}
    compare.remember(asked.tasks, outcomes)
    last_run.renumber(job.write(context, asked.tasks, outcomes))
    for warning in report.warnings:
        say({"WARNING"}, translated(warning))
    for idle in labels.idle_in(report):
        say({"INFO"}, f"{labels.IDLE} with these options: {idle}")
    say({"INFO"}, translated(summary(report)))
    return {"FINISHED"}


def refuse(context: bpy.types.Context, tasks: list[job.Task], refusal: job.Refused, say: Say) -> set[str]:
    """Show what a refusal is about, and leave every mesh as it is."""
    job.show_vertices(context, refusal.object_name, refusal.elements)
    store_refusal(context.window_manager.fairing_report, refusal.object_name, refusal.reason)
    last_run.refused(tasks)
    say({"ERROR"}, translated(str(refusal)))
    return {"CANCELLED"}


def _keep(context: bpy.types.Context, way: str, report: Report, say: Say) -> set[str]:
    """Leave what the last run has left, offer this change no more, and report how it would have come out."""
    last_run.select_region(context)
    shown = context.window_manager.fairing_report
    shown.remedies = ",".join(name for name in shown.remedies.split(",") if name != way)
    outcome = ": ".join(filter(None, (GRADE_NAMES[report.verdict.grade], report.verdict.reason)))
    say({"INFO"}, translated(f"That is no better and was not written ({outcome})"))
    redraw_sidebars(context)
    return {"CANCELLED"}
