"""How one option is described, once: it is a field of a dataclass of options, with all that is said of it.

Blender's properties, the redo panel, the command line, docs/options.md, checks and presets are made from that. Plain
Python, no bpy.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields, replace
from difflib import get_close_matches
from math import isclose
from numbers import Integral, Real
from typing import Any, Self

import numpy as np

Item = tuple[str, str, str]  # identifier, label, description

SURFACE, VERTICES, TRANSITION = "Surface", "Vertices", "Transition"
GROUPS = (SURFACE, VERTICES, TRANSITION)
PARTS, PINS, SOLVER = "Parts and Masks", "Pins and Borders", "Solver"
FOLDED = (PARTS, PINS, SOLVER)  # under Advanced

SINGLE = 1e-6  # relative: Blender's numbers have single precision
_KINDS: dict[type, tuple[str, tuple[type, ...]]] = {
    bool: ("True or False", (bool, np.bool_)),
    int: ("a whole number", (Integral,)),
    float: ("a number", (Real,)),
    str: ("a text", (str,)),
}


def always(_options: Any) -> bool:
    """Say that an option counts whatever the others are."""
    return True


@dataclass(frozen=True)
class Option:
    """One option as it is offered."""

    group: str
    label: str
    description: str
    default: bool | int | float | str
    items: tuple[Item, ...] = ()  # of a choice
    bounds: tuple[float, float] = (-1e9, 1e9)  # what is accepted
    slider: tuple[float, float] | None = None  # what a slider offers
    digits: int = 3
    step: int = 3
    kind: str = ""  # FACTOR, DISTANCE, or VERTEX_GROUP for the name of one
    counts: Callable[[Any], bool] = always  # given all options: whether this one can affect anything
    name: str = ""

    def check(self, value: Any) -> None:
        """Raise TypeError for another kind of value, ValueError for one that is not accepted."""
        words, kinds = _KINDS[type(self.default)]
        if not isinstance(value, kinds):
            raise TypeError(f"{self.name}: expected {words}, got {value!r}")
        if self.items and value not in (accepted := [item[0] for item in self.items]):
            raise ValueError(f"{self.name}: expected one of {', '.join(accepted)}, got {value!r}")
        least, most = self.bounds
        if isinstance(value, Real) and not least - SINGLE * abs(least) <= float(value) <= most + SINGLE * abs(most):
            raise ValueError(f"{self.name}: expected {least:g} … {most:g}, got {value!r}")

    def is_set(self, options: Any) -> bool:
        value = getattr(options, self.name)
        if isinstance(self.default, float):
            return not isclose(value, self.default, rel_tol=SINGLE)
        return bool(value != self.default)


Table = tuple[Option, ...]


def option(group: str, label: str, description: str, default: Any, **rest: Any) -> Any:
    """Describe a field."""
    return field(default=default, metadata={"option": Option(group, label, description, default, **rest)})


_tables: dict[type, Table] = {}


def table(of: type[Chosen]) -> Table:
    if of not in _tables:
        _tables[of] = tuple(replace(each.metadata["option"], name=each.name) for each in fields(of))
    return _tables[of]


@dataclass(frozen=True)
class Chosen:
    """What was chosen of the options that a subclass has as its fields.

    Raises ValueError for a value that is not accepted, TypeError for one of another kind. What can't affect anything
    given the others takes its default, one after the other in the order of the fields; `idle` names it.
    """

    def __post_init__(self) -> None:
        for each in table(type(self)):
            each.check(getattr(self, each.name))
        idle = []
        for each in table(type(self)):
            if each.is_set(self) and not each.counts(self):
                idle.append(each.name)
                object.__setattr__(self, each.name, each.default)
        object.__setattr__(self, "_idle", tuple(idle))

    @property
    def idle(self) -> tuple[str, ...]:
        """The names of options that were set, but that nothing looks at, given the others."""
        names: tuple[str, ...] = getattr(self, "_idle")  # noqa: B009 - no field: what differs in it alone is the same
        return names

    @classmethod
    def named(cls, given: dict[str, Any]) -> Self:
        _refuse_unknown([each.name for each in table(cls)], given)
        return cls(**given)

    @classmethod
    def of(cls, properties: Any) -> Self:
        """Take every option from an object that has them as attributes."""
        return cls(**{each.name: getattr(properties, each.name) for each in table(cls)})

    @classmethod
    def parsed(cls, text: str) -> Self:
        """Read what `json.dumps(asdict(options))` wrote; names that another version had are left out.

        Raises TypeError and ValueError for a text that is something else, ValueError for a value it does not know.
        """
        stored = json.loads(text)
        if not isinstance(stored, dict):
            raise TypeError(f"options: expected names with values, got {text!r}")
        return cls(**{each.name: stored[each.name] for each in table(cls) if each.name in stored})


def named(of: type[Chosen], name: str) -> Option | None:
    return next((each for each in table(of) if each.name == name), None)


def _refuse_unknown(names: list[str], given: Iterable[str]) -> None:
    for name in given:
        if name not in names:
            meant = get_close_matches(name, names, n=1)
            hint = f"did you mean {meant[0]!r}?" if meant else f"there are {', '.join(names)}"
            raise TypeError(f"There is no property {name!r}: {hint}")
