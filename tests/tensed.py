"""Surfaces of revolution with Δ_B (w (H − H₀)) = 0, integrated in one dimension: exact patches with tensions.

w and H₀ are those of docs/joins.md. Along a profile of radius r, with F = r φ′, all of it is ordinary: (r q′)′ = 0 for
q = w (H − H₀), F′ = −r, (r T′)′ = 0 for T = ln t, (r H₀′)′ = 0. Both ends are where φ = 0.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

import shapes
from curves import Arc, OdeCurve
from domains import Domain, Style
from meshing import mesh
from surfaces import Revolution, Sphere

R, ANGLE, Q, F, PHI, T, STRAIGHT = 0, 2, 3, 4, 5, 6, 7  # places in the state


def _over(numerator: Any, radius: Any) -> Any:
    """What vanishes at the axis, over the distance from it."""
    at_axis = np.abs(radius) < 1e-9
    return np.where(at_axis, 0.0, numerator / np.where(at_axis, 1.0, radius))


def _curvature(_: Any, state: Any) -> Any:
    steepness = 0.5 * _over(state[F], state[R]) ** 2
    depth = state[PHI] / (state[PHI] + steepness)
    mean = state[STRAIGHT] + state[Q] * np.exp(-3.0 * state[T] * (1.0 - depth))
    return np.where(np.abs(state[R]) < 1e-9, mean, 2.0 * mean - _over(np.sin(state[ANGLE]), state[R]))


class _Profile:
    """A profile from its first state up to where φ comes back to zero; rates: r q′, r T′ and r H₀′."""

    def __init__(self, initial: tuple[float, ...], rates: tuple[float, float, float]) -> None:
        def extra(_: Any, state: Any) -> tuple[Any, ...]:
            q, t, straight = (_over(rate, state[R]) for rate in rates)
            return q, -state[R], _over(state[F], state[R]), t, straight

        def back(s: float, state: Any) -> float:
            return float(state[PHI]) if s > 0.01 else 1.0

        back.terminal = True  # type: ignore[attr-defined]
        slope = OdeCurve(0.0, 1.0, initial, _curvature, extra).slope
        found = solve_ivp(slope, (0.0, 6.0), initial, method="DOP853", rtol=1e-12, atol=1e-13, events=back)
        self.last = found.y[:, -1]
        self.curve = OdeCurve(0.0, float(found.t[-1]), initial, _curvature, extra)

    @property
    def excess(self) -> float:
        """Of H₀ over half the curvature along the last end."""
        return float(self.last[STRAIGHT] - 0.5 * np.sin(self.last[ANGLE]) / self.last[R])


def dome(n_free: int, tension: float, style: Style | None = None, *, bend: float = 0.5) -> shapes.Patch:
    """A cap over a circle with the same tension all along it; bend: w (H − H₀) in its middle, where φ = 0.2."""

    def profile(straight: float) -> _Profile:
        return _Profile((0.0, 0.0, 0.0, -bend, 0.0, 0.2, np.log(tension), straight), (0.0, 0.0, 0.0))

    found = root(lambda x: profile(float(x[0])).excess, [-0.5], tol=1e-12)
    curve = profile(float(found.x[0])).curve
    # Where its vertices go is read off a ball.
    ball = Domain(Sphere(Arc(0.0, curve.stop, -curve.stop)), "disc")
    return shapes.patch_of(Domain(Revolution(curve, 1), "disc"), mesh(ball, n_free, style or Style()))


def tube(n_free: int, tensions: tuple[float, float], style: Style | None = None) -> shapes.Patch:
    """A tube with a tension at each end."""
    first, last = np.log(tensions)
    lean = 0.5 * np.pi - 0.5

    def profile(unknown: Any) -> _Profile:
        climb, straight = unknown
        return _Profile((1.0, 0.0, lean, 0.5, 0.9, 0.0, first, 0.5 * np.sin(lean)), (-0.6, climb, straight))

    def missed(unknown: Any) -> list[float]:
        found = profile(unknown)
        return [found.last[T] - last, found.excess]

    found = root(missed, [last - first, 0.0], tol=1e-12)
    return shapes.on_domain(Domain(Revolution(profile(found.x).curve, -1), "tube"), n_free, style)
