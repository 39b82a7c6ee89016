"""Rows whose surface is known: largest distance to it over D, from a membrane."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import graded
import measures
import shapes
from engine import Engine, FloatArray, Outcome
from report import WEIGHTS, Row, solved_row
from shapes import Patch, Style

TIGHT = 1e-10


@dataclass(frozen=True)
class Scope:
    """Sizes up to `largest` free vertices, so many random patches of a seed; where plots and CSV files go."""

    engine: Engine
    largest: int
    patches: int
    seed: int
    folder: Path

    def sizes(self, *wanted: int) -> list[int]:
        """Those of the wanted sizes that are not too large."""
        return [n for n in wanted if n <= self.largest]


def solve(scope: Scope, patch: Patch, **options: Any) -> Outcome:
    """The patch from its boundary and the normals there; weights belong to the exact mesh."""
    settings: dict[str, Any] = {
        "tolerance": TIGHT, "fixed": patch.fixed, "fixed_normals": patch.fixed_normals,
        "reference": patch.vertices, **options,
    }  # fmt: skip
    return scope.engine.fair(shapes.start_from_nothing(patch), patch.triangles, **settings)


def error(patch: Patch, outcome: Outcome) -> float:
    """Largest distance to the exact surface over D, nan for a refusal."""
    return np.nan if outcome.refused else patch.error(outcome.vertices)


def row(scope: Scope, case: str, patch: Patch, goal: float, weights: str = "uniform") -> Row:
    """One solve of one mesh."""
    outcome = solve(scope, patch, inner_fairness=weights)
    return solved_row(case, len(patch.free), weights, goal, error(patch, outcome), outcome)


BASES: dict[str, Callable[[int], Patch]] = {
    "hemisphere": shapes.cap,
    "cylinder, length 3": partial(shapes.cylinder, length=3.0),
    "catenoid": shapes.catenoid,
}


def graded_rows(scope: Scope) -> Iterator[Row]:
    """Edge ratio 40, aspect 12; every λ. The last row is the median of all."""
    errors, converged = [], True
    for name, base in BASES.items():
        for n_free in scope.sizes(1000, 5000):
            patch = graded.regraded(base(60), n_free)
            for weights in WEIGHTS:
                made = row(scope, f"graded {name}", patch, 1e-3, weights)
                errors.append(made.measured)
                converged &= made.converged
                yield made
    middle = float(np.median(errors))
    yield Row("graded, median", 0, "all", 5e-5, middle, "", converged, np.nan)


JITTERED: dict[str, list[tuple[int, float]]] = {
    "hemisphere": [(1000, 1e-8), (4000, 1e-8), (16000, 1e-8)],
    "cylinder": [(1000, 1e-6), (4000, 1e-6), (16000, 1e-7)],
    "catenoid": [(1000, 5e-5), (4000, 5e-5), (16000, 3e-6)],
    "unduloid": [(1000, 2e-4), (4000, 2e-4), (16000, 1e-5)],
}


def jittered_rows(scope: Scope) -> Iterator[Row]:
    """Growing jittered meshes, and the order from the first to the last."""
    for family, goals in JITTERED.items():
        done: list[Row] = []
        for n_free, goal in goals:
            if n_free <= scope.largest:
                done.append(row(scope, f"jittered {family}", shapes.FAMILIES[family](n_free), goal))
                yield done[-1]
        if len(done) > 1 and done[0].measured > 1e-8:
            yield _order(family, done)


def _order(family: str, rows: list[Row]) -> Row:
    first, last = rows[0], rows[-1]
    order = measures.observed_order((first.size, last.size), (first.measured, last.measured))
    converged = all(made.converged for made in rows)
    note = f"observed order {order:.2f}"
    return Row(f"jittered {family}, 1.7 ÷ order in h", 0, "uniform", 1.0, 1.7 / order, "", converged, np.nan, note)


def strong_rows(scope: Scope) -> Iterator[Row]:
    """Quads of ±0.6 h of jitter in each direction, split by random diagonals, every λ."""
    style = Style(jitter=1.2, layout="grid", seed=1)
    makers: dict[str, Callable[..., Patch]] = {
        "clothoid cylinder": partial(shapes.clothoid, shape="rectangle"),
        "r H′ = 0.35": shapes.linear_flux,
    }
    for name, make in makers.items():
        for n_free, goal in ((4000, 5e-5), (16000, 1e-5)):
            if n_free <= scope.largest:
                patch = make(n_free, style)
                for weights in WEIGHTS:
                    yield row(scope, f"strongly jittered {name}", patch, goal, weights)


def pipe_rows(scope: Scope) -> Iterator[Row]:
    """Straight round pipes; several surfaces fit beyond 2π radii, the straight one is wanted."""
    for length in range(3, 13):
        regular = shapes.cylinder(min(250 * length, scope.largest), Style(jitter=0.0), length=float(length))
        yield row(scope, f"pipe, {length} radii, regular", regular, 1e-4)
        uneven = graded.regraded(regular, min(500 * length, scope.largest))
        yield row(scope, f"pipe, {length} radii, graded", uneven, 1e-4)


def special_rows(scope: Scope) -> Iterator[Row]:
    """Anisotropy, clusters of valence 3, shallow and deep caps."""
    yield from _weighted(scope, "5:1 anisotropic cap", shapes.cap(2000, Style(aspect=5.0)), 1e-5)
    yield from _weighted(scope, "valence-3 clusters, cap", shapes.cap(2000, Style(valence3=0.4, clusters=6)), 1e-5)
    for degrees in (30, 50, 70, 90, 110, 130, 140):
        yield row(scope, f"cap of {degrees}°", shapes.cap(1500, half_angle=float(degrees)), 1e-5)


def _weighted(scope: Scope, case: str, patch: Patch, goal: float) -> Iterator[Row]:
    for weights in WEIGHTS:
        yield row(scope, case, patch, goal, weights)


def noisy_normal_rows(scope: Scope) -> Iterator[Row]:
    """Boundary normals turned by Gaussian angles of 0.05 rad."""
    makers: dict[str, Callable[[int], Patch]] = {
        "cap of 60°": partial(shapes.cap, half_angle=60.0), "hemisphere": shapes.cap,
        "cylinder": shapes.cylinder, "catenoid": shapes.catenoid,
    }  # fmt: skip
    for name, make in makers.items():
        patch = make(4000)
        for seed in range(3):
            normals = tilted(patch.fixed_normals, 0.05, seed)
            outcome = solve(scope, patch, fixed_normals=normals)
            case = f"boundary normals noisy by 0.05 rad, {name}, {seed}"
            yield solved_row(case, len(patch.free), "uniform", 5e-3, error(patch, outcome), outcome)


def tilted(normals: FloatArray, radians: float, seed: int) -> FloatArray:
    """Unit normals (k, 3) turned by Gaussian angles of this standard deviation in both directions."""
    noise = np.random.default_rng(seed).standard_normal(normals.shape)
    noise -= (noise * normals).sum(axis=1)[:, None] * normals
    turned = normals + radians * noise
    return np.asarray(turned / np.linalg.norm(turned, axis=1)[:, None])
