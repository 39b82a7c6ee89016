"""Fairing of exact patches from their boundary alone, cached for the tests that look at it."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import blend
import fairing
import shapes
from shapes import Patch, Style

TIGHT = 1e-10


def fair_patch(patch: Patch, **options: Any) -> fairing.FairResult:
    """The patch from its outline and the normals there, starting from a membrane."""
    settings: dict[str, Any] = {"tolerance": TIGHT, **options}
    boundary = fairing.Boundary(patch.fixed, patch.fixed_normals)
    return called(shapes.start_from_nothing(patch), patch.triangles, boundary, settings)


def called(vertices: Any, triangles: Any, boundary: fairing.Boundary, settings: dict[str, Any]) -> fairing.FairResult:
    """A call with options by name, those of the boundary among them."""
    if "fixed_curvatures" in settings:
        boundary = replace(boundary, curvatures=settings.pop("fixed_curvatures"))
    if "outside" in settings:
        boundary = replace(boundary, outside=settings.pop("outside"))
    apart = {name: settings.pop(name) for name in ("progress", "threads") if name in settings}
    return fairing.fair(vertices, triangles, boundary, fairing.Options.of(**settings), **apart)


@lru_cache(maxsize=64)
def solved(family: str, n_free: int, style: Style | None = None) -> tuple[Patch, fairing.FairResult]:
    """A patch of the family and its fair surface with uniform inner fairness."""
    patch = shapes.FAMILIES[family](n_free, style or Style())
    return patch, fair_patch(patch)


def fair_blend(patch: blend.Blend, **options: Any) -> fairing.FairResult:
    """The three-cylinder blend from its rims."""
    settings: dict[str, Any] = {"tolerance": TIGHT, **options}
    return called(patch.vertices, patch.triangles, fairing.Boundary(patch.fixed, patch.fixed_normals), settings)


def codes(result: fairing.FairResult) -> set[str]:
    """Codes of the warnings."""
    return {warning.code for warning in result.warnings}
