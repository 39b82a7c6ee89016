"""Where a surface does not continue its surroundings although it is the equation's."""

from __future__ import annotations

import numpy as np

from fairing._types import Diagnostic, FairResult

_OFF = 20.0  # degrees off the prescribed normal; a loft's kinks are counted from there, too
_BACK = 90.0  # degrees of a visible kink from which the surface runs back over the triangles around
_TOLD_ELSEWHERE = ("loft", "smoothed")  # by NO_SOLUTION, with their kinks


def not_tangent(report: FairResult) -> tuple[Diagnostic, ...]:
    """A warning with the outline's vertices where the surface leaves the tangent planes, or turns back."""
    bad = (report.boundary_angle > _OFF) | (report.join > _BACK)
    if not report.converged or report.equation in _TOLD_ELSEWHERE or not bad.any():
        return ()
    back = bool((report.join[bad] > _BACK).any())
    degrees = float(np.maximum(report.boundary_angle, report.join)[bad].max())
    why = "triangles around are folded over there" if back else "edges are longer there than the wall is thick"
    advice = "unfold or remove them" if back else "refine the outline and what is around"
    text = f"the surface leaves its surroundings by up to {degrees:.0f}° at {bad.sum()} vertices of the outline; maybe "
    figures = {"vertices": float(bad.sum()), "degrees": degrees, "folded_back" if back else "coarse": 1.0}
    return (Diagnostic("NOT_TANGENT", f"{text}{why}: {advice}", report.fixed[bad], "vertex", figures),)
