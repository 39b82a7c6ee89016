"""What a caller gives by name: known names only, and each value of the kind that its default has."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from difflib import get_close_matches
from numbers import Integral, Real
from typing import Any

import numpy as np

_KINDS: dict[str, tuple[str, tuple[type, ...]]] = {
    "bool": ("True or False", (bool, np.bool_)),
    "int": ("a whole number", (Integral,)),
    "float": ("a number", (Real,)),
    "str": ("a text", (str,)),
}


def refuse_unknown(known: Iterable[str], given: Iterable[str]) -> None:
    """Raise TypeError for a property that does not exist, with those that may be meant."""
    names = tuple(known)
    for name in given:
        if name not in names:
            meant = get_close_matches(name, names, n=1)
            hint = f"did you mean {meant[0]!r}?" if meant else f"there are {', '.join(names)}"
            raise TypeError(f"There is no property {name!r}: {hint}")


def refuse_negative(options: Any, name: str) -> None:
    """Raise ValueError where a number for which 0 stands for a choice of its own is less."""
    value = getattr(options, name)
    if value < 0:
        raise ValueError(f"{name}: expected 0 or a positive number, got {value!r}")


def kind_problem(default: Any, value: Any) -> str:
    """Say why a value is of another kind than the default; empty where it is not."""
    words, kinds = _KINDS[type(default).__name__]
    return "" if isinstance(value, kinds) else f"expected {words}, got {value!r}"


def refuse_other_kinds(options: Any) -> None:
    """Raise TypeError for a value of a dataclass that is of another kind than its default."""
    for field in fields(options):
        problem = kind_problem(field.default, getattr(options, field.name))
        if problem:
            raise TypeError(f"{field.name}: {problem}")
