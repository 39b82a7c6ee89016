"""Measured figures of the first release beside their goals, as Markdown.

    python benchmarks/accuracy.py            # all sizes; about two minutes
    python benchmarks/accuracy.py --quick    # up to 4k free vertices

Distances are over D (twice the largest distance of the fixed vertices from their centroid), starts
are membranes, meshes jittered and irregular, `tolerance=1e-10` unless the column says otherwise.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

import blend
import measures
import shapes
from solving import fair_blend, fair_patch


@dataclass(frozen=True)
class Row:
    """One line of the table."""

    case: str
    size: int
    goal: float
    measured: float
    at_default: float | None = None
    order: float | None = None
    angle: float | None = None
    iterations: int | None = None
    seconds: float | None = None

    def line(self) -> str:
        """The Markdown of the row."""
        met = "yes" if self.measured <= self.goal else "**no**"
        optional = (
            _text(self.at_default, ".1e"), _text(self.order, ".2f"), _text(self.angle, ".3f"),
            _text(self.iterations, "d"), _text(self.seconds, ".2f"),
        )  # fmt: skip
        cells = (self.case, str(self.size), f"{self.goal:.0e}", f"{self.measured:.1e}", met)
        return f"| {' | '.join(cells + optional)} |"


def _text(value: float | None, pattern: str) -> str:
    return "" if value is None else format(value, pattern)


HEADER = (
    "| case | free vertices | goal | max distance / D | met | at default tolerance "
    "| order in h | boundary angle, ° | iterations | seconds |\n" + "| --- " * 10 + "|"
)
GOALS: list[tuple[str, list[tuple[int, float]]]] = [
    ("hemisphere", [(1000, 1e-6), (4000, 1e-6), (10000, 1e-6)]),
    ("cylinder", [(1000, 2e-6), (4000, 2e-6), (16000, 2e-6)]),
    ("catenoid", [(1000, 5e-5), (4000, 1e-5), (16000, 1e-5)]),
    ("unduloid", [(1000, 2e-4), (4000, 2e-4), (16000, 2e-4)]),
    ("clothoid", [(1000, 1e-3), (4000, 2e-4), (16000, 2e-4)]),
    ("linear_flux", [(1000, 1e-3), (4000, 2e-4), (16000, 2e-4)]),
]


def closed_form_rows(family: str, goals: list[tuple[int, float]]) -> Iterator[Row]:
    """One family at growing sizes, with the order between neighbouring ones."""
    previous: tuple[int, float] | None = None
    for n_free, goal in goals:
        patch = shapes.FAMILIES[family](n_free)
        result = fair_patch(patch)
        error, count = patch.error(result.vertices), len(patch.free)
        order = None
        if previous and error > 1e-8:
            order = measures.observed_order((previous[0], count), (previous[1], error))
        previous = count, error
        default = patch.error(fair_patch(patch, tolerance=1e-6).vertices)
        yield Row(
            family + _state(result.converged), count, goal, error, default, order,
            float(result.boundary_angle.max()), result.iterations, result.seconds.get("total"),
        )  # fmt: skip


def _state(converged: bool) -> str:
    return "" if converged else " (not converged)"


def conformal_rows(sizes: list[int]) -> Iterator[Row]:
    """The hemisphere with conformal weights of the exact surface's Delaunay mesh."""
    for n_free in sizes:
        patch = shapes.cap(n_free)
        options = {"inner_fairness": "conformal", "reference": patch.vertices}
        result = fair_patch(patch, **options)
        default = fair_patch(patch, tolerance=1e-6, **options)
        yield Row(
            "hemisphere, conformal" + _state(result.converged), len(patch.free), 1e-6,
            patch.error(result.vertices), patch.error(default.vertices), None,
            float(result.boundary_angle.max()), result.iterations, result.seconds.get("total"),
        )  # fmt: skip


def blend_rows() -> Iterator[Row]:
    """Two-sided distances between two meshes of the three-cylinder blend."""
    for name, jitter in (("regular", 0.0), ("mildly irregular", 0.6)):
        meshes = [blend.cylinder_blend(n, jitter=jitter, seed=n) for n in (4000, 3700)]
        results = [fair_blend(made) for made in meshes]
        pairs = [(r.vertices, m.triangles) for r, m in zip(results, meshes, strict=True)]
        distance = measures.two_sided_distance(pairs[0], pairs[1]) / meshes[0].diameter
        state = _state(all(result.converged for result in results))
        yield Row(
            f"three-cylinder blend, two {name} meshes{state}", 4000, 3e-3, distance, None, None,
            max(float(r.boundary_angle.max()) for r in results),
            max(r.iterations for r in results), max(r.seconds.get("total", 0.0) for r in results),
        )  # fmt: skip


def rows(largest: int) -> Iterator[Row]:
    """All rows up to this many free vertices."""
    for family, goals in GOALS:
        yield from closed_form_rows(family, [goal for goal in goals if goal[0] <= largest])
    yield from conformal_rows([n for n in (1000, 10000) if n <= largest])
    yield from blend_rows()


def main() -> int:
    """Print the table; 1 if a goal is missed."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--quick", action="store_true", help="only up to 4k free vertices")
    largest = 4000 if parser.parse_args().quick else 16000
    print(HEADER)
    missed = 0
    for row in rows(largest):
        print(row.line(), flush=True)
        missed += row.measured > row.goal
    return int(missed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
