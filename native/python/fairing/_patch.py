"""Patches that are meshed anew and solved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import (
    _arguments,
    _core,
    _options,
)
from fairing._fair import solved
from fairing._groups import Boundary, Options
from fairing._new_mesh import Origin, read_only
from fairing._types import FairResult, FloatArray, IntArray
from fairing._watch import Progress

INNER = ("outline", "even")


@dataclass(frozen=True)
class Spacing:
    """How long new edges are to be."""

    length: float
    even: bool
    flat: bool = False
    """Whether the old triangles are the surface as they are, broken along seams, and small angles may stay."""

    def wanted(self, least: int) -> tuple[float, int, bool, bool]:
        return self.length, least, self.even, self.flat


@dataclass(frozen=True)
class Patch:
    """A mesh to be solved or meshed anew, with its boundary and the normals there."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray | None
    normals: FloatArray | None

    def expected_new(self, spacing: Spacing) -> float:
        """About how many vertices of a mesh of that spacing are new: half as many as the boundary has are not."""
        mine = self.triangles[_core.components(self.triangles, self.fixed, len(self.vertices)) >= 0]
        count = _core.expected_count(self.vertices, self.triangles, self.fixed, self.normals, spacing.wanted(0))
        return count - 0.5 * sum(map(len, _core.boundary_loops(mine)))

    def remeshed(
        self, old_count: int, spacing: Spacing, least: int, options: dict[str, Any], progress: Progress | None
    ) -> tuple[Patch, Origin]:
        """On the first ``old_count`` of these vertices and new ones."""
        new, origin, _ = self.meshed_anew(old_count, _arguments.NO_EDGES, (spacing, least), options, progress)
        return new, origin

    def meshed_anew(
        self,
        old_count: int,
        lines: IntArray,
        wanted: tuple[Spacing, int],
        options: dict[str, Any],
        progress: Progress | None,
    ) -> tuple[Patch, Origin, IntArray]:
        """The same with edges that stay, and with the old vertex that each new one is, or −1."""
        mesh = _core.remesh(
            self.vertices, self.triangles, self.fixed, self.normals, free_slopes(options), lines,
            wanted[0].wanted(wanted[1]),
            _arguments.whole("threads", options.get("threads", 0), 0), progress,
        )  # fmt: skip
        triangles = mesh["triangles"].copy()
        triangles[triangles >= len(self.vertices)] -= len(self.vertices) - old_count
        placed = np.concatenate([self.vertices[:old_count], mesh["vertices"]])
        new = Patch(placed, read_only(triangles), self.fixed, self.normals)
        return new, (mesh["triangle"], mesh["weights"]), mesh["old"]

    def faired(self, start: str, outside: Any, options: dict[str, Any], progress: Progress | None) -> FairResult:
        chosen = {"inner_fairness": "conformal", **options}
        threads = chosen.pop("threads", 0)
        joined = {name: chosen.pop(f"fixed_{name}", None) for name in ("curvatures", "continuity")}
        around = outside if outside is not None and len(outside) else None
        boundary = Boundary(self.fixed, self.normals, outside=around, **joined)
        return solved(self.vertices, self.triangles, boundary, Options.of(**chosen, start=start), progress, threads)


def free_slopes(options: dict[str, Any]) -> tuple[IntArray, IntArray]:
    """Fixed vertices on creases, and on smooth curves."""
    given = {name: options.get(name) for name in ("creases", "smooth_curves")}
    creases, curves = (_arguments.integers(name, [] if at is None else at, None) for name, at in given.items())
    return creases, curves


_MADE_HERE = ("reference", "neighbours", "outline", "start")


def refuse_made_here(options: dict[str, Any], progress: Any) -> None:
    for name in _MADE_HERE:
        if name in options:
            raise ValueError(f"{name}: not accepted here; the mesh and its boundary are made by this call")
    _options.continuity(
        options.get("continuity", "G1"), options.get("equation", "harmonic"), options.get("method", "global")
    )
    _options.callback(progress)


def own_mesh_options(chosen: Options, threads: int) -> _core.Options:
    """What the engine is told about a mesh that a call makes itself, checked."""
    if vars(chosen.skin).keys() & chosen.chosen.keys():
        raise ValueError("detail, feather and weights: not accepted here, where the mesh is made by this call")
    fairness = chosen.layout.inner_fairness
    if not isinstance(fairness, str | None):
        raise ValueError("inner_fairness: rows of weights are not accepted here, where the mesh is made by this call")
    return _options.engine_options(chosen.changed(inner_fairness=fairness or "conformal"), threads, 0)


def spacing_of(value: Any, inner: str | None) -> Spacing:
    if _arguments.finite("spacing", value) < 0:
        raise ValueError(f"spacing: a length, or 0 for that of the boundary's edges, is needed, not {value!r}")
    chosen = ("even" if value else "outline") if inner is None else inner
    return Spacing(float(value), _arguments.choice("inner", chosen, INNER) == "even")


def carried(values: FloatArray, triangles: IntArray, origin: Origin) -> FloatArray:
    """(k,) values at vertices (n,), interpolated at places on triangles."""
    carried: FloatArray = read_only((values[triangles[origin[0]]] * origin[1]).sum(axis=1))
    return carried
