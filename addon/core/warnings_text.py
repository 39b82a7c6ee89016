"""The engine's warnings as sentences: one for each kind, however many islands have it. Plain Python, no bpy."""

from __future__ import annotations

import re

import fairing

# Of several islands: which number stands for all. Of those that are not listed the numbers are added.
_LARGEST = ("SHARP_BOUNDARY",)  # degrees
_NOT_CONVERGED = (
    "{islands} islands, of {total} free vertices in all, did not converge; their positions are the best found"
)

_NUMBER = re.compile(r"\d+")


def counted(count: int, one: str, many: str) -> str:
    """Return the number with the phrase that goes with it."""
    return f"{count} {one if count == 1 else many}"


def sentences(warnings: tuple[fairing.Diagnostic, ...]) -> tuple[str, ...]:
    """Return one sentence for each kind of warning, in the order in which they first came."""
    alike: dict[tuple[str, str], list[str]] = {}
    for warning in warnings:
        alike.setdefault((warning.code, _NUMBER.sub("#", warning.message)), []).append(warning.message)
    return tuple(f"{code}: {_joined(code, messages)}" for (code, _), messages in alike.items())


def _joined(code: str, messages: list[str]) -> str:
    """Return one message for those of several islands, which differ in their numbers alone."""
    islands = len(messages)
    if islands == 1:
        return messages[0]
    rows = [[int(number) for number in _NUMBER.findall(message)] for message in messages]
    if code == "NOT_CONVERGED" and "the best that were found" in messages[0]:
        return _NOT_CONVERGED.format(islands=islands, total=sum(map(sum, rows)))
    choose = max if code in _LARGEST or "%" in messages[0] else sum
    numbers = iter([choose(column) for column in zip(*rows, strict=True)])
    return _NUMBER.sub(lambda _: str(next(numbers)), messages[0]) + f" ({islands} islands)"
