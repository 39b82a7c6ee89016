"""Fairing of exact patches from their boundary alone, cached for the tests that look at it."""

from functools import lru_cache
from typing import Any

import blend
import fairing
import shapes
from shapes import Patch, Style

TIGHT = 1e-10


def fair_patch(patch: Patch, **options: Any) -> fairing.FairResult:
    """The patch from its boundary and the normals there, starting from a membrane."""
    given = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals, "tolerance": TIGHT}
    return fairing.fair(shapes.start_from_nothing(patch), patch.triangles, **{**given, **options})


@lru_cache(maxsize=64)
def solved(family: str, n_free: int, style: Style | None = None) -> tuple[Patch, fairing.FairResult]:
    """A patch of the family and its fair surface with uniform inner fairness."""
    patch = shapes.FAMILIES[family](n_free, style or Style())
    return patch, fair_patch(patch)


def fair_blend(patch: blend.Blend, **options: Any) -> fairing.FairResult:
    """The three-cylinder blend from its rims."""
    given = {"fixed": patch.fixed, "fixed_normals": patch.fixed_normals, "tolerance": TIGHT}
    return fairing.fair(patch.vertices, patch.triangles, **{**given, **options})


def codes(result: fairing.FairResult) -> set[str]:
    """Codes of the warnings."""
    return {warning.code for warning in result.warnings}
