# mypy: disable-error-code="valid-type"
"""The last run and the run under way, on the window manager: no part of the file or its undo."""

from collections.abc import Sequence
from typing import Any

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .report import GRADE_NAMES, MET, MISSED, TOLD, Report
from .verdict import LOOK, UNUSABLE, Verdict

_GRADES = tuple((grade, name, "") for grade, name in GRADE_NAMES.items())
_STATES = ((MET, "Met", ""), (MISSED, "Missed", ""), (TOLD, "Told", ""))


class FairCheck(bpy.types.PropertyGroup):
    """One line of the report."""

    value: StringProperty()
    state: EnumProperty(items=_STATES)
    detail: BoolProperty()


class FairReport(bpy.types.PropertyGroup):
    """What the last run did."""

    verdict: EnumProperty(items=_GRADES, default=UNUSABLE)  # nothing is good before it has been looked at
    reason: StringProperty()
    remedies: StringProperty()
    written: BoolProperty()
    undone: BoolProperty()
    objects: StringProperty()
    free_vertices: IntProperty()
    seconds: FloatProperty()
    residual: FloatProperty()
    boundary_angle: FloatProperty()
    distortion: FloatProperty()
    join_typical: FloatProperty()
    join_worst: FloatProperty()
    converged: BoolProperty()
    warnings: StringProperty()
    checks: CollectionProperty(type=FairCheck)


class FairProgress(bpy.types.PropertyGroup):
    """The run under way."""

    running: BoolProperty()
    following: BoolProperty()  # a change in the redo panel, while Blender goes on
    fraction: FloatProperty()
    stage: StringProperty()


_said: dict[str, str] = {}  # messages by their letters, which are all that Blender keeps


def kept(said: str) -> str:
    """Keep a message while its letters are in a report."""
    _said[said] = said
    return said


def message(text: str) -> str:
    """Return the message of a report that reads so: other languages word it anew."""
    return _said.get(text, text)


def clear(shown: Any) -> None:
    """Let a FairReport show no run."""
    for known in shown.bl_rna.properties:
        if known.identifier != "rna_type":
            shown.property_unset(known.identifier)


def store_refusal(shown: Any, object_name: str, reason: str) -> None:
    """Let a FairReport show a run that was refused, and nothing of the one before."""
    clear(shown)
    shown.objects, shown.verdict, shown.reason = object_name, UNUSABLE, kept(reason)


def store_awaited(shown: Any, objects: Sequence[str], size: float, reason: str) -> None:
    """Let a FairReport show that the result before is there, and why no other one."""
    clear(shown)
    shown.objects, shown.free_vertices, shown.written = ", ".join(objects), max(1, round(size)), True
    shown.verdict, shown.reason = LOOK, kept(reason)


def store_word(shown: Any, objects: Sequence[str], count: int, verdict: Verdict) -> None:
    """Let a FairReport show the word on a run of another operator, which has no figures; count: of vertices."""
    clear(shown)
    shown.objects, shown.free_vertices, shown.written = ", ".join(objects), count, True
    shown.verdict, shown.reason = verdict.grade, kept(verdict.reason)


def store(shown: Any, report: Report) -> None:
    """Copy a report to the FairReport that the panel shows."""
    shown.objects = ", ".join(report.objects)
    for name in ("free_vertices", "seconds", "residual", "boundary_angle", "distortion", "converged"):
        setattr(shown, name, getattr(report, name))
    shown.verdict, shown.reason = report.verdict.grade, kept(report.verdict.reason)
    shown.remedies = ",".join(report.verdict.remedies)
    shown.written, shown.undone = report.written, False
    shown.join_typical, shown.join_worst = report.join
    shown.warnings = "\n".join(map(kept, report.warnings))
    shown.checks.clear()
    for check in report.checks:
        line = shown.checks.add()
        line.name, line.value, line.state, line.detail = check.name, kept(check.value), check.state, check.detail
