"""What becomes of a fair surface: written and reported, or left out with a word on why."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial

import bpy

from ..host.status import redraw_sidebars
from ..mirror.symmetry import NOT_SYMMETRIC
from ..run import compare, job, last_run
from ..run.preview import Preview
from ..run.request import RequestInEditMode, Say, Work, done
from ..translations import translated
from ..verdict.outcome import Fairing
from ..verdict.properties import store
from ..verdict.report import GRADE_NAMES, Report, make_report, summary
from ..words import labels
from ..words.words import said
from .engine import Progress


@dataclass
class Request(RequestInEditMode):
    notes: tuple[str, ...] = ()  # on objects that there is nothing to do for
    remedy: str = ""  # tried after a run that was not good, and written only where the verdict improves
    again: bool = False  # on faces of the last run, which are selected where the result is written
    keeps_vertices = True

    def work(self, progress: Progress) -> list[Fairing]:
        return job.solve(self.tasks, self.options, progress)

    def work_aside(self, large: bool) -> Work:
        """Find them with a preview, and where they are large, prepare for a change of options."""
        self.preview = preview = Preview(self.tasks)
        return partial(job.solve, self.tasks, self.options, ahead=large, give=preview.give)

    def finish(self, context: bpy.types.Context, outcomes: list[Fairing], say: Say) -> set[str]:
        """Write and report what the run came to; return an operator's status."""
        named = [(task.object_name, outcome) for task, outcome in zip(self.tasks, outcomes, strict=True)]
        report = make_report(named, self.options, time.perf_counter() - self.begin, self.notes)
        report = labels.with_idle(report, self.options)
        if self.remedy and not last_run.is_improved_by(report):
            return _keep(context, self.remedy, report, say)
        store(context.window_manager.fairing_report, report)
        last_run.remember(self.tasks, outcomes, self.options, report)
        if not report.written:
            say({"ERROR"}, translated(summary(report)))
            return {"CANCELLED"}
        if self.again:
            last_run.select_region(context)
            bpy.ops.ed.undo_push(message="Select Region")  # what the redo panel goes back to
        compare.remember(self.tasks, outcomes)
        written = job.write_each(context, zip(self.names, outcomes, strict=True), job.write_one)
        last_run.renumber(written)
        if any(each is not None and not each.is_symmetric for each in written):
            say({"WARNING"}, translated(NOT_SYMMETRIC))
        for idle in labels.idle_in(report):
            say({"INFO"}, f"{labels.IDLE} with these options: {idle}")
        return done(say, report.warnings, summary(report))


def _keep(context: bpy.types.Context, remedy: str, report: Report, say: Say) -> set[str]:
    """Leave what the last run has left, offer this change no more, and report how it would have come out."""
    shown = context.window_manager.fairing_report
    shown.remedies = ",".join(name for name in shown.remedies.split(",") if name != remedy)
    outcome = ": ".join(filter(None, (GRADE_NAMES[report.verdict.grade], report.verdict.reason)))
    say({"INFO"}, translated(said("no_better", outcome=outcome)))
    redraw_sidebars(context)
    return {"CANCELLED"}
