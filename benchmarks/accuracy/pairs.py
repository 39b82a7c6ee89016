"""Three meshes of one boundary: how far apart their surfaces are, and their H along the boundary."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from scipy.spatial import cKDTree

import blend
import connectivity
import measures
import shapes
import tetrathing
from blend import Blend
from engine import FloatArray, Outcome
from exact import TIGHT, Scope
from report import Row
from shapes import Patch, Style

Made = Blend | Patch


@dataclass(frozen=True)
class Solved:
    """A mesh and what came of it."""

    mesh: Made
    outcome: Outcome

    @property
    def boundary_curvature(self) -> FloatArray:
        """(k,) H at the fixed vertices."""
        return self.outcome.mean_curvature[self.mesh.fixed]


def three_cylinders(size: int) -> list[Made]:
    """Regular, irregular and strongly irregular."""
    return [blend.cylinder_blend(n, jitter=j, seed=k) for k, (n, j) in enumerate(_sizes(size))]


def _sizes(size: int) -> list[tuple[int, float]]:
    return [(size, 0.0), (round(0.92 * size), 0.6), (round(1.4 * size), 0.9)]


def tetrathings(size: int) -> list[Made]:
    """13k vertices (3.3k below a size of 4000), and the same with 15 % and 30 % of the edges flipped at random."""
    made = tetrathing.tetrathing(times=3 if size < 4000 else 4)
    return [made, flipped(made, 0.15, 1), flipped(made, 0.3, 2)]


def mixed_tetrathings(size: int) -> list[Made]:
    """3.3k vertices, a rather coarse mesh, beside 13k; and 3.3k with flips."""
    coarse = tetrathing.tetrathing(times=3)
    return [coarse, tetrathing.tetrathing(times=4), flipped(coarse, 0.3, 1)]


def flipped(mesh: Blend, share: float, seed: int) -> Blend:
    """The same vertices with other triangles between them."""
    return replace(mesh, triangles=connectivity.shuffled(mesh.triangles, mesh.fixed, share, seed))


def torus_patches(size: int) -> list[Made]:
    """An oval piece of a torus in rows, strongly jittered, and of random points."""
    styles = (Style(jitter=0.2), Style(jitter=1.0, seed=1), Style(layout="random", seed=2))
    sizes = (size, round(0.92 * size), round(1.4 * size))
    return [shapes.torus(n, style, shape="oval") for n, style in zip(sizes, styles, strict=True)]


CASES: dict[str, Callable[[int], list[Made]]] = {
    "three-cylinder blend": three_cylinders,
    "tetrathing": tetrathings,
    "tetrathing, 3.3k and 13k": mixed_tetrathings,
    "torus patch": torus_patches,
}


def rows(scope: Scope) -> Iterator[Row]:
    """Two rows for each case and λ: the two-sided distance over D, and the difference of H."""
    for name, make in CASES.items():
        meshes = make(min(4000, scope.largest))
        for weights in ("uniform", "inverse_distance", "conformal") if name == "torus patch" else ("uniform",):
            yield from _compared(name, weights, [_solved(scope, mesh, weights) for mesh in meshes])


def _solved(scope: Scope, mesh: Made, weights: str) -> Solved:
    start = shapes.membrane(mesh.vertices, mesh.triangles, mesh.fixed)
    outcome = scope.engine.fair(
        start, mesh.triangles, fixed=mesh.fixed, fixed_normals=mesh.fixed_normals, inner_fairness=weights,
        tolerance=TIGHT, reference=mesh.vertices,
    )  # fmt: skip
    return Solved(mesh, outcome)


def _compared(name: str, weights: str, solved: list[Solved]) -> Iterator[Row]:
    size = max(len(made.mesh.vertices) - len(made.mesh.fixed) for made in solved)
    state = " / ".join(made.outcome.state for made in solved)
    converged = all(made.outcome.converged for made in solved)
    cpu = sum(made.outcome.cpu for made in solved)
    refused = any(made.outcome.refused for made in solved)
    away = np.nan if refused else max(_distance(*pair) for pair in combinations(solved, 2))
    bent = np.nan if refused else max(_difference(*pair) for pair in combinations(solved, 2))
    yield Row(f"three meshes, {name}: distance", size, weights, 2e-3, away, state, converged, cpu)
    note = "" if refused else f"H on the boundary in {_ranges(solved)}"
    yield Row(f"three meshes, {name}: boundary H", size, weights, 0.02, bent, state, converged, np.nan, note)


def _distance(one: Solved, other: Solved) -> float:
    pairs = [(made.outcome.vertices, made.mesh.triangles) for made in (one, other)]
    return measures.two_sided_distance(pairs[0], pairs[1], 2) / one.mesh.diameter


def _difference(one: Solved, other: Solved) -> float:
    """Largest difference of H as functions on the boundary, over the largest |H| there."""
    largest = float(np.abs(one.boundary_curvature).max())
    return max(float(_apart(*pair).max()) for pair in ((one, other), (other, one))) / largest


def _apart(at: Solved, other: Solved) -> FloatArray:
    """|ΔH| at the fixed vertices of `at`; H of the other is linear between its two nearest ones."""
    points, nodes = at.mesh.vertices[at.mesh.fixed], other.mesh.vertices[other.mesh.fixed]
    near = cKDTree(nodes).query(points, k=2)[1]
    start, ahead = nodes[near[:, 0]], nodes[near[:, 1]] - nodes[near[:, 0]]
    share = np.clip(((points - start) * ahead).sum(axis=1) / (ahead**2).sum(axis=1), 0, 1)
    values = other.boundary_curvature[near]
    return np.asarray(np.abs((1 - share) * values[:, 0] + share * values[:, 1] - at.boundary_curvature))


def _ranges(solved: list[Solved]) -> str:
    ranges = [made.boundary_curvature for made in solved]
    return ", ".join(f"[{values.min():.4f}, {values.max():.4f}]" for values in ranges)
