"""What a call is given: groups of options, or fields of them by name."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy.typing as npt

from fairing._groups import Boundary, Options
from fairing._parts import by_parts

_OF_BOUNDARY = {
    "fixed": "vertices", "fixed_normals": "normals", "fixed_curvatures": "curvatures", "outside": "outside",
}  # fmt: skip


def given(
    boundary: Boundary | npt.ArrayLike | None, options: Options | None, named: dict[str, Any]
) -> tuple[Boundary, Options]:
    """The boundary and the options of a call; ``named`` are fields of either, which count more.

    Raises TypeError for a name that there isn't, ValueError where a group is something else.
    """
    known = boundary if isinstance(boundary, Boundary) else Boundary(boundary)
    chosen = Options() if options is None else options
    if not isinstance(chosen, Options):
        raise ValueError(f"options: a fairing.Options is needed, not {options!r}")
    for name, group in vars(chosen).items():
        if not isinstance(group, type(getattr(Options(), name))):
            raise ValueError(f"options: {name} has to be a fairing.{name.capitalize()}, not {group!r}")
    held = {_OF_BOUNDARY[name]: value for name, value in named.items() if name in _OF_BOUNDARY}
    others = {name: value for name, value in named.items() if name not in _OF_BOUNDARY}
    return by_parts(replace(known, **held), chosen.changed(**others))


def of_own_boundary(options: Options | None, named: dict[str, Any], threads: int) -> dict[str, Any]:
    """The options of a call that makes its boundary itself, those that differ from the defaults, by name."""
    for name in _OF_BOUNDARY:
        if name in named:
            raise ValueError(f"{name}: not accepted here; the mesh and its boundary are made by this call")
    return flat(given(None, options, named)[1], threads)


def flat(chosen: Options, threads: int, boundary: Boundary | None = None) -> dict[str, Any]:
    """Options by name, with ``threads`` and, as "fixed_…", how the boundary is joined, where these are given."""
    found = chosen.chosen
    if threads:
        found["threads"] = threads
    joined = () if boundary is None else ("curvatures", "continuity")
    by_vertex = {f"fixed_{name}": getattr(boundary, name) for name in joined}
    return {**found, **{name: value for name, value in by_vertex.items() if value is not None}}
