"""What becomes of a run's answer: written and reported, or left out with a word on why."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

import bpy

from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..core.report import GRADE_NAMES, Report, make_report, summary
from ..host.status import redraw_sidebars
from ..translations import translated
from . import compare, job, labels, last_run
from .preview import Preview
from .report_properties import store, store_refusal

Say = Callable[[set[str], str], object]  # an operator's report


class Asked:
    """What one run was asked for: a change in the redo panel, if it is one."""

    def __init__(
        self, tasks: list[job.Task], options: FairOptions, notes: tuple[str, ...], begin: float, way: str = ""
    ) -> None:
        """notes: on objects that there is nothing to do for; begin: of the performance counter.

        way: tried after a run that was not good, and written only where the verdict improves.
        """
        self.tasks, self.options, self.notes, self.begin, self.way = tasks, options, notes, begin, way
        self.names, self.size = tuple(task.object_name for task in tasks), job.size(tasks)
        self.preview = Preview(tasks)
        self.work: Callable[..., list[Fairing]] = partial(job.solve, tasks, options, give=self.preview.give)

    @property
    def is_shown(self) -> bool:
        """Whether anything is shown in place of the answer."""
        return self.preview.is_shown

    def show_last(self) -> None:
        """Show the last run's result, where it began from the same meshes."""
        for task in self.tasks:
            found = compare.result_from(task.object_name, task.mesh.positions)
            if found is not None:
                self.preview.give(task.object_name, *found)
        self.preview.show()

    def show(self) -> None:
        """Show the first surfaces that are there by now."""
        self.preview.show()

    def take_back(self) -> None:
        """Let the meshes be as they were read."""
        self.preview.take_back()

    def is_as_read(self, context: bpy.types.Context) -> bool:
        """Return whether the meshes are as they were read."""
        return job.is_current(context, self.tasks)

    def is_as_shown(self, context: bpy.types.Context) -> bool:
        """Return whether they are as they were read, but for what is shown."""
        return job.is_current(context, self.preview.tasks_as_shown())

    def settle(self, context: bpy.types.Context, answer: Callable[[], list[Fairing]], say: Say) -> set[str]:
        """Write and report the answer, or why it is not written; return an operator's status."""
        try:
            return finish(context, self, answer(), say)
        except job.Refused as refusal:
            return refuse(context, self.tasks, refusal, say)


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
