"""The same boundary from different interiors: given, flattened, folded, noisy. Positions must agree."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

import blend
import shapes
from engine import Outcome
from exact import TIGHT, Scope
from report import WEIGHTS, Row
from shapes import Patch, Style
from specimens import STARTS, moved


def rows(scope: Scope) -> Iterator[Row]:
    """Largest distance between vertices of the same number, over D, from the mesh given."""
    patches: dict[str, Callable[[int], Patch]] = {
        "hemisphere": shapes.cap,
        "cylinder, length 3": partial(shapes.cylinder, length=3.0),
        "clothoid, strongly jittered": partial(
            shapes.clothoid, style=Style(jitter=1.2, layout="grid"), shape="rectangle"
        ),
        "catenoid, random": partial(shapes.catenoid, style=Style(layout="random")),
    }
    for name, make in patches.items():
        patch = make(2000)
        for weights in WEIGHTS:
            yield _compared(scope, name, patch, patch.diameter, weights)
    made = blend.cylinder_blend(2000)
    yield _compared(scope, "three-cylinder blend", made, made.diameter, "uniform")


def _compared(scope: Scope, name: str, patch: Patch | blend.Blend, diameter: float, weights: str) -> Row:
    results: list[Outcome] = []
    for kind in STARTS:
        start = moved(kind, patch.vertices, patch.triangles, patch.fixed)
        options = {} if weights == "uniform" else {"reference": patch.vertices}
        results.append(
            scope.engine.fair(
                start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
                inner_fairness=weights, tolerance=TIGHT, **options,
            )
        )  # fmt: skip
    refusals = [outcome for outcome in results if outcome.refused]
    size = len(patch.vertices) - len(patch.fixed)
    case = f"four starts, {name}"
    if refusals:
        return Row(case, size, weights, 1e-6, np.nan, refusals[0].state, False, np.nan, refusals[0].refused[:90])
    away = [np.abs(outcome.vertices - results[0].vertices).max() / diameter for outcome in results]
    note = ", ".join(f"{kind} {value:.1e}" for kind, value in zip(STARTS, away, strict=True) if value > 1e-6)
    state = " / ".join(sorted({outcome.state for outcome in results}))
    converged = all(outcome.converged for outcome in results)
    return Row(case, size, weights, 1e-6, float(max(away)), state, converged, sum(o.cpu for o in results), note)
