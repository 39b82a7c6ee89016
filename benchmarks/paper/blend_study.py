"""Figs. 1 and 2: one blend on two meshes with two parameterisations, faired linearly and by Δ_B H = 0."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Any

import curved
import fairing
from cases import Case, blend_case, reduced
from linear_bilaplacian import linear_bilaplacian
from polygon_mesh import FloatArray

WEIGHTS = ("uniform", "conformal")
Variant = tuple[int, str]  # vertices, weights
METHODS: dict[str, dict[str, Any]] = {
    "global, fitted normals": {},
    "global, averaged normals": {"normals": "averaged"},
}


@dataclass(frozen=True)
class BlendStudy:
    """Cases by number of vertices; linear solutions and results of each method by variant."""

    cases: dict[int, Case]
    linear: dict[Variant, FloatArray]
    results: dict[str, dict[Variant, fairing.FairResult]]

    def ours(self, variant: Variant) -> FloatArray:
        """Positions by the default method."""
        return self.results["global, fitted normals"][variant].vertices


@lru_cache(maxsize=1)
def blend_study() -> BlendStudy:
    """All of them solved."""
    full = blend_case()
    meshes = {len(case.vertices): case for case in (full, reduced(full, 400), reduced(full, 118))}
    variants = [(count, weights) for count in meshes for weights in WEIGHTS]
    linear = {v: linear_bilaplacian(meshes[v[0]], v[1]) for v in variants}
    results = {
        name: {v: meshes[v[0]].fair(inner_fairness=v[1], **options) for v in variants}
        for name, options in METHODS.items()
    }
    return BlendStudy(meshes, linear, results)


def sensitivity_table() -> str:
    """Two-sided distances over D of pairs that share mesh or weights, and how much less sensitive the methods are."""
    study = blend_study()
    lines = [f"| pair | linear bilaplacian | {' | '.join(f'{name} | ratio' for name in METHODS)} |"]
    lines.append("| --- " * (2 + 2 * len(METHODS)) + "|")
    for one, other in combinations(study.linear, 2):
        if one[0] != other[0] and one[1] != other[1]:
            continue
        first, second = study.cases[one[0]], study.cases[other[0]]
        far = curved.distance(first, study.linear[one], second, study.linear[other])
        cells = []
        for name in METHODS:
            runs = study.results[name]
            near = curved.distance(first, runs[one].vertices, second, runs[other].vertices)
            star = "" if runs[one].converged and runs[other].converged else "\\*"
            cells.append(f"{near:.1e}{star} | {far / near:.1f}")
        lines.append(f"| {_name(one)}; {_name(other)} | {far:.1e} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _name(variant: Variant) -> str:
    return f"{variant[0]} {variant[1]}"
