"""Calls by keyword, as they were before there were groups of options."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy.typing as npt

from fairing import _arguments, _core
from fairing._groups import GROUP_OF, Boundary, Options
from fairing._parts import by_parts

_OF_BOUNDARY = {
    "fixed": "vertices", "fixed_normals": "normals", "fixed_curvatures": "curvatures", "outside": "outside",
}  # fmt: skip


def adopted(
    call: str,
    boundary: Boundary | npt.ArrayLike | None,
    options: Options | None,
    before: dict[str, Any],
    level: int = 3,
) -> tuple[Boundary, Options]:
    """The boundary and the options of a call.

    before: keyword arguments by their names of before, for which the line that called warns; TypeError for others.
    ValueError where a group is something else.
    """
    known = boundary if isinstance(boundary, Boundary) else Boundary(boundary)
    chosen = Options() if options is None else options
    if not isinstance(chosen, Options):
        raise ValueError(f"options: a fairing.Options is needed, not {options!r}")
    for name, group in vars(chosen).items():
        if not isinstance(group, type(getattr(Options(), name))):
            raise ValueError(f"options: {name} has to be a fairing.{name.capitalize()}, not {group!r}")
    if not before:
        return by_parts(known, chosen)
    unknown = [name for name in before if name not in _OF_BOUNDARY and name not in GROUP_OF]
    if unknown:
        raise TypeError(f"{call}() got an unexpected keyword argument {unknown[0]!r}")
    warnings.warn(
        f"{call}: {', '.join(before)}: given in groups now, as in {_example(before)}; the old name goes in 0.2",
        DeprecationWarning,
        stacklevel=level,
    )
    if "inner_fairness" in before and before["inner_fairness"] is None:  # means something in Layout only
        _arguments.choice("inner_fairness", None, _core.WORDS["inner_fairness"])
    held = {new: before.get(old, getattr(known, new)) for old, new in _OF_BOUNDARY.items()}
    chosen = chosen.changed(**{name: before[name] for name in before if name in GROUP_OF})
    return by_parts(replace(known, **held), chosen)


def taken(call: str, options: Options | None, before: dict[str, Any], threads: int) -> dict[str, Any]:
    """The options of a call that makes its own boundary, those that differ from the defaults, by name."""
    made_here: dict[str, Any] = {
        name: before.pop(name) for name in ("fixed", "fixed_normals", "outside") if name in before
    }
    curvatures = before.pop("fixed_curvatures", None)
    _, chosen = adopted(call, None, options, before, level=4)
    return {**made_here, **flat(chosen, threads, Boundary(curvatures=curvatures))}


def flat(chosen: Options, threads: int, boundary: Boundary | None = None) -> dict[str, Any]:
    """Options by name, with ``threads`` and, as "fixed_…", how the boundary is joined, where these are given."""
    found = chosen.chosen
    if threads:
        found["threads"] = threads
    joined = () if boundary is None else ("curvatures", "continuity", "tension")
    given = {f"fixed_{name}": getattr(boundary, name) for name in joined}
    return {**found, **{name: value for name, value in given.items() if value is not None}}


def _example(before: dict[str, Any]) -> str:
    name = next(iter(before))
    if name in _OF_BOUNDARY:
        return f"fairing.Boundary({_OF_BOUNDARY[name]}=...)"
    group = GROUP_OF[name]
    return f"fairing.Options({group}=fairing.{group.capitalize()}({name}=...))"
