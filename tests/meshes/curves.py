"""Plane curves by arc length: the profiles and cross-sections of the exact test surfaces.

A curve has the tangent (cos angle, sin angle) and the signed curvature d angle / d s,
positive where it turns left. All lengths share one unit; every array argument is (k,).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial import cKDTree

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Frame:
    """Points of a curve with their tangent angle and curvature, each (k,)."""

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    curvature: FloatArray


class Curve:
    """A curve over [start, stop]; it continues on both sides by `margin` for projections."""

    start: float
    stop: float

    def frame(self, s: FloatArray) -> Frame:
        """The curve at arc length s."""
        raise NotImplementedError

    @property
    def margin(self) -> float:
        """Continuation past either end, a tenth of the length."""
        return 0.1 * (self.stop - self.start)

    @cached_property
    def _samples(self) -> tuple[FloatArray, Any]:
        s = np.linspace(self.start - self.margin, self.stop + self.margin, 2001)
        frame = self.frame(s)
        return s, cKDTree(np.column_stack([frame.x, frame.y]))

    def nearest(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Arc length of the point nearest to each (x, y): best of 2001 samples, then Newton."""
        samples, tree = self._samples
        s = samples[tree.query(np.column_stack([x, y]))[1]]
        for _ in range(8):
            s = np.clip(s + self._newton_step(s, x, y), samples[0], samples[-1])
        return np.asarray(s)

    def _newton_step(self, s: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
        at = self.frame(s)
        cos, sin = np.cos(at.angle), np.sin(at.angle)
        dx, dy = x - at.x, y - at.y
        slope = 1.0 - at.curvature * (dy * cos - dx * sin)
        limit = 0.02 * (self.stop - self.start)
        return np.clip((dx * cos + dy * sin) / np.maximum(slope, 0.1), -limit, limit)


@dataclass(frozen=True)
class Line(Curve):
    """The line x = offset, upwards."""

    start: float
    stop: float
    offset: float = 0.0

    def frame(self, s: FloatArray) -> Frame:
        zero = np.zeros_like(s)
        return Frame(zero + self.offset, s + 0.0, zero + np.pi / 2, zero)


@dataclass(frozen=True)
class Arc(Curve):
    """A circle of signed curvature 1/turn about (centre, 0), with angle s/turn."""

    start: float
    stop: float
    turn: float
    centre: float = 0.0

    def frame(self, s: FloatArray) -> Frame:
        angle = s / self.turn
        x = self.centre + self.turn * np.sin(angle)
        return Frame(x, -self.turn * np.cos(angle), angle, np.full_like(s, 1 / self.turn))


@dataclass(frozen=True)
class Catenary(Curve):
    """x = c cosh(y/c), upwards, s = 0 at the waist."""

    start: float
    stop: float
    waist: float = 1.0

    def frame(self, s: FloatArray) -> Frame:
        c = self.waist
        x = np.hypot(c, s)
        return Frame(x, c * np.arcsinh(s / c), np.arctan2(c, s), -c / x**2)


@dataclass(frozen=True)
class OdeCurve(Curve):
    """x' = cos angle, y' = sin angle, angle' = curvature(s, state); extra states by `extra`.

    state = (x, y, angle, extras…) with `initial` at s = 0. DOP853 at relative tolerance 1e-13.
    """

    start: float
    stop: float
    initial: tuple[float, ...]
    curvature: Callable[[Any, Any], Any]
    extra: Callable[[Any, Any], tuple[Any, ...]] = field(default=lambda s, state: ())

    def slope(self, s: float, state: Any) -> list[Any]:
        """The derivatives of the states."""
        angle = state[2]
        return [np.cos(angle), np.sin(angle), self.curvature(s, state), *self.extra(s, state)]

    @cached_property
    def _branches(self) -> tuple[Any, Any]:
        below = min(self.start - self.margin, 0.0) - 1e-6
        above = max(self.stop + self.margin, 0.0) + 1e-6
        return self._integrate(below), self._integrate(above)

    def _integrate(self, end: float) -> Any:
        solved = solve_ivp(
            self.slope, (0.0, end), self.initial, method="DOP853", rtol=1e-13, atol=1e-14,
            dense_output=True, max_step=0.02,
        )  # fmt: skip
        if not solved.success:
            raise RuntimeError(f"profile not integrated: {solved.message}")
        return solved.sol

    def states(self, s: FloatArray) -> FloatArray:
        """All states at s, (number of states, k)."""
        below, above = self._branches
        return np.asarray(np.where(s < 0, below(np.minimum(s, 0.0)), above(np.maximum(s, 0.0))))

    def frame(self, s: FloatArray) -> Frame:
        state = self.states(np.asarray(s, dtype=float))
        curvature = np.broadcast_to(self.curvature(s, state), np.shape(s))
        return Frame(state[0], state[1], state[2], np.asarray(curvature, dtype=float))


def clothoid(start: float, stop: float, a: float, b: float) -> OdeCurve:
    """The curve with curvature a + b s through the origin."""
    return OdeCurve(start, stop, (0.0, 0.0, 0.0), lambda s, _: a + b * s)


def delaunay_profile(start: float, stop: float, neck: float, bulge: float) -> OdeCurve:
    """Profile (r, z) of the unduloid between these radii, s = 0 at the neck.

    r sin(angle) − H r² is conserved, so H = 1/(neck + bulge), for the normal left of the profile.
    """
    mean = 1.0 / (neck + bulge)
    return OdeCurve(start, stop, (neck, 0.0, np.pi / 2), lambda _, q: 2 * mean - np.sin(q[2]) / q[0])


def linear_flux_profile(start: float, stop: float, flux: float, mean: float = 0.5) -> OdeCurve:
    """Profile (r, z) with r H' = flux, H for the normal left of the profile; r = 1, H = mean at 0.

    Revolved, Δ_B H = (r H')'/r = 0. The fourth state is H.
    """
    return OdeCurve(
        start, stop, (1.0, 0.0, np.pi / 2, mean),
        lambda _, q: 2 * q[3] - np.sin(q[2]) / q[0],
        lambda _, q: (flux / q[0],),
    )  # fmt: skip
