"""The engine's warnings as sentences: one for each kind, however many islands have it. Plain Python, no bpy."""

from __future__ import annotations

import re

import fairing

# Of several islands: which number stands for all. Of those that are not listed the numbers are added.
_LARGEST = ("SHARP_BOUNDARY",)  # degrees
_NOT_CONVERGED = (
    "{islands} islands, of {total} free vertices in all, did not converge; their positions are the best found"
)

# What the engine says of one, and how it should. A text that it has no more is left as it is.
_SINGULAR = (
    ("1 triangles of the result are turned", "1 triangle of the result is turned"),
    ("1 triangles of the result pass", "1 triangle of the result passes"),
    ("1 triangles have no area", "1 triangle has no area"),
    ("1 triangles name a vertex twice and were", "1 triangle names a vertex twice and was"),
    (
        "1 triangles between fixed vertices have a corner that is NaN or infinite and were",
        "1 triangle between fixed vertices has a corner that is NaN or infinite and was",
    ),
    ("1 triangles are wound", "1 triangle is wound"),
    ("turns 1 triangles over", "turns 1 triangle over"),
    ("1 triangles of the reference mesh are needles", "1 triangle of the reference mesh is a needle"),
    (
        "1 vertices on an open border were not given as fixed and stay where they are",
        "1 vertex on an open border was not given as fixed and stays where it is",
    ),
    (
        "1 fixed vertices have no fixed neighbour: their position counts, their normal",
        "1 fixed vertex has no fixed neighbour: its position counts, its normal",
    ),
    (
        "1 prescribed normals point against the winding of their triangles: turn them round",
        "1 prescribed normal points against the winding of its triangles: turn it round",
    ),
    ("of 1 free vertices", "of 1 free vertex"),
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
    return tuple(f"{code}: {_singular(_joined(code, messages))}" for (code, _), messages in alike.items())


def _joined(code: str, messages: list[str]) -> str:
    """Return one message for those of several islands, which differ in their numbers alone."""
    islands = len(messages)
    if islands == 1:
        return messages[0]
    rows = [[int(number) for number in _NUMBER.findall(message)] for message in messages]
    if code == "NOT_CONVERGED":
        return _NOT_CONVERGED.format(islands=islands, total=sum(map(sum, rows)))
    choose = max if code in _LARGEST else sum
    numbers = iter([choose(column) for column in zip(*rows, strict=True)])
    return _NUMBER.sub(lambda _: str(next(numbers)), messages[0]) + f" ({islands} islands)"


def _singular(text: str) -> str:
    for many, one in _SINGULAR:
        text = re.sub(rf"(?<!\d){re.escape(many)}", one, text)
    return text
