"""How one option is described, and what becomes of the names that it had before.

Blender's properties, the redo panel, the command line, the tables of docs/blender.md and the deprecation warnings are
all made from such descriptions, which option_list.py holds. Plain Python, no bpy.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from math import isclose
from pathlib import Path
from typing import Any

from .checked import kind_problem, refuse_unknown

Item = tuple[str, str, str]  # identifier, label, description
_PACKAGE = str(Path(__file__).parents[1])
_UNTIL = "0.2"  # the version without the names before


def always(_options: Any) -> bool:
    """Show an option in any case."""
    return True


@dataclass(frozen=True)
class Before:
    """A name that an option had, with the values that stood for off and on where it was no checkbox."""

    name: str
    values: tuple[str, ...] = ()


@dataclass(frozen=True)
class Option:
    """One option as it is offered."""

    name: str
    label: str
    description: str
    default: bool | int | float | str
    group: str
    items: tuple[Item, ...] = ()  # of a choice
    bounds: tuple[float, float] | None = None  # what is accepted
    slider: tuple[float, float] | None = None  # what a slider offers
    digits: int = 3
    step: int = 3
    kind: str = ""  # FACTOR, DISTANCE, or VERTEX_GROUP for the name of one
    shown: Callable[[Any], bool] = always  # given the other options: whether this one can affect anything
    field: str = ""  # of the options that the engine's side reads, where that has another name
    values: tuple[str, str] | None = None  # what that field is for off and on
    before: tuple[Before, ...] = ()

    @property
    def target(self) -> str:
        """The field that it sets."""
        return self.field or self.name

    def check(self, value: Any) -> Any:
        """Return the value; raises TypeError for another kind, ValueError for a choice that there isn't."""
        problem = kind_problem(self.default, value)
        if problem:
            raise TypeError(f"{self.name}: {problem}")
        if self.items and value not in (accepted := [item[0] for item in self.items]):
            raise ValueError(f"{self.name}: expected one of {', '.join(accepted)}, got {value!r}")
        return value


Table = tuple[Option, ...]


def defaults(table: Table) -> dict[str, Any]:
    """Return every option with its default."""
    return {option.name: option.default for option in table}


def named(table: Table, name: str) -> Option | None:
    """Return the option that has, had or sets this name."""
    for option in table:
        if name in (option.name, option.target, *(before.name for before in option.before)):
            return option
    return None


def names_before(table: Table) -> dict[str, tuple[Option, Before]]:
    """Return the names that are no longer used, with what they were."""
    return {before.name: (option, before) for option in table for before in option.before}


def fields_of(table: Table, read: Callable[[str], Any]) -> dict[str, Any]:
    """Return the fields that the options set; read: returns an option's value by its name."""
    fields: dict[str, Any] = {}
    for option in table:
        value = option.check(read(option.name))
        fields[option.target] = option.values[int(value)] if option.values else value
    return _with_equation(fields)


def options_of(table: Table, fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options that set these fields."""
    known = {option.target: fields[option.target] for option in table}
    known = _with_shape(known)
    return {
        option.name: option.values.index(known[option.target]) == 1 if option.values else known[option.target]
        for option in table
    }


def differing(table: Table, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return those that are not the default; Blender's numbers have single precision."""
    return {option.name: options[option.name] for option in table if not _is_default(option, options[option.name])}


def _is_default(option: Option, value: Any) -> bool:
    if isinstance(option.default, float):
        return isclose(value, option.default, rel_tol=1e-6)
    return bool(value == option.default)


def from_names_before(table: Table, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return what options have to be for what names before were set to; raises ValueError and TypeError."""
    known, found = names_before(table), {}
    for name, value in given.items():
        option, before = known[name]
        if before.values:
            if value not in before.values:
                raise ValueError(f"{name}: expected one of {', '.join(before.values)}, got {value!r}")
            if option.values is not None:
                value = before.values.index(value) == 1
        found[option.name] = value
    return found if "equation" not in given else _continued(table, found, given["equation"])


def read_named(table: Table, given: Mapping[str, Any], what: str) -> dict[str, Any]:
    """Return the fields that a caller's keyword arguments set, by names of now or before.

    what: is called, for the warning. Raises TypeError for an option that does not exist.
    """
    old = names_before(table)
    names = [option.name for option in table]
    refuse_unknown(names, [name for name in given if name not in old])
    used = {name: value for name, value in given.items() if name in old}
    warn_of_names_before(table, used, what)
    now = {name: value for name, value in given.items() if name not in old}
    values = {**defaults(table), **now, **from_names_before(table, used)}
    return fields_of(table, values.__getitem__)


def warn_of_names_before(table: Table, used: Iterable[str], what: str) -> None:
    """Warn of each, at the line outside the add-on that has used it."""
    for name in used:
        option, before = names_before(table)[name]
        warnings.warn(
            f"{what}: {name} is {advice(option, before)} now; the old name goes in {_UNTIL}",
            DeprecationWarning,
            stacklevel=_levels_to_caller(),
        )


def advice(option: Option, before: Before) -> str:
    """Say what to write instead of a name before."""
    if before.name == "equation":
        return "shape, with x and bulge alone for CONSTANT"
    if option.values is None:
        return option.name
    off, on = before.values
    return f"{option.name} (True for {on}, False for {off})"


def _levels_to_caller() -> int:
    """Return how many frames up the first one outside the add-on and Blender's own modules is."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and _is_inside(frame.f_code.co_filename):
        level, frame = level + 1, frame.f_back
    return level


def _is_inside(path: str) -> bool:
    return path.startswith(_PACKAGE) or path.replace("\\", "/").endswith(("/bpy/ops.py", "/_bpy_internal/ops.py"))


def _continued(table: Table, found: dict[str, Any], equation: str) -> dict[str, Any]:
    """Turn `equation` into what stands for it now; a bulge had no effect but with its own."""
    if equation == "SOAP_FILM":
        return {**found, "shape": "AUTOMATIC", "continuity": "G0"}
    if equation == "CONSTANT":
        return {**found, "shape": "HARMONIC"}
    flat = {"bulge": 0.0} if named(table, "bulge") and equation in ("AUTOMATIC", "HARMONIC") else {}
    return {**found, "shape": equation, **flat}


def _with_equation(fields: dict[str, Any]) -> dict[str, Any]:
    """Take positions alone for the soap film, and a bulge for pressure."""
    if fields.get("continuity") == "G0":
        return {**fields, "equation": "SOAP_FILM", "continuity": "G1"}
    bulges = fields.get("bulge") and fields["equation"] in ("AUTOMATIC", "HARMONIC") and fields["continuity"] == "G1"
    return {**fields, "equation": "CONSTANT"} if bulges else fields


def _with_shape(fields: dict[str, Any]) -> dict[str, Any]:
    """Do the reverse."""
    equation = fields.get("equation")
    if equation == "SOAP_FILM":
        return {**fields, "equation": "AUTOMATIC", "continuity": "G0"}
    return {**fields, "equation": "HARMONIC"} if equation == "CONSTANT" else fields
