"""Errors that name a property of the operator, for those who see its label."""

from __future__ import annotations

import re
from dataclasses import replace

from ..options.options import FairOptions
from ..options.table import named
from ..verdict.report import Check, Report

_NAMED = re.compile(r"^([a-z_]+): (.*)$", re.DOTALL)
_REFUSED = "is not accepted"
IDLE = "Without effect"  # a line of the report


def reason_of(cause: Exception) -> str:
    """Return what an error says with the label of the property that it begins with: `Pin Group: …`, not `pin_group: …`.

    Where a value is not accepted, what the property is for follows.
    """
    text = str(cause)
    named = _NAMED.match(text)
    words = _words(named[1]) if named else None
    if named is None or words is None:
        return text
    label, description = words
    return f"{label}: {named[2]}" + (f" ({description})" if _REFUSED in text else "")


def with_idle(report: Report, options: FairOptions) -> Report:
    """Return the report with the labels of options that are set and have no effect, if there are any."""
    idle = ", ".join(words[0] for words in map(_words, options.idle) if words)
    if not idle:
        return report
    return replace(report, checks=(*report.checks, Check(IDLE, idle, detail=True)))


def idle_in(report: Report) -> tuple[str, ...]:
    return tuple(check.value for check in report.checks if check.name == IDLE)


def _words(name: str) -> tuple[str, str] | None:
    """Return the label and the description of the option that has this name."""
    found = named(FairOptions, name)
    return None if found is None else (found.label, found.description)
