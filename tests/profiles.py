"""Surfaces of revolution of least variation, in one dimension: a reference for the two-dimensional solver.

The profile (r, z) has the tangent angle φ: r′ = cos φ, z′ = sin φ. Its principal curvatures are φ′ along it
and sin φ / r around, their derivatives along it a = φ″ and b = (cos φ / r)(φ′ − sin φ / r), and the mean over all
directions of the squared derivative of the normal curvature is (5a² + 6ab + 9b²) / 16.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.optimize import minimize

FloatArray = NDArray[np.float64]
Functional = Literal["all directions", "principal lines", "mean curvature"]
_NODES, _WEIGHTS = legendre.leggauss(96)
DEGREE = 20


@dataclass(frozen=True)
class Profile:
    """Points of a profile at the nodes of a quadrature, from the first end to the last."""

    r: FloatArray
    z: FloatArray


@dataclass(frozen=True)
class Ends:
    """Radii of both ends, their distance, and how far the surface leans inwards there, degrees."""

    first: float
    last: float
    length: float
    lean: float = 0.0

    @property
    def angles(self) -> tuple[float, float]:
        """Tangent angles at both ends."""
        return 0.5 * np.pi + np.radians(self.lean), 0.5 * np.pi - np.radians(self.lean)


class _Curve:
    """A profile with φ = Σ c_k P_k over its length."""

    def __init__(self, unknowns: FloatArray, first: float) -> None:
        coefficients, self.length = unknowns[:-1], unknowns[-1]
        rate = 2.0 / self.length
        self.phi = legendre.legval(_NODES, coefficients)
        self.turn = rate * legendre.legval(_NODES, legendre.legder(coefficients))
        self.a = rate**2 * legendre.legval(_NODES, legendre.legder(coefficients, 2))
        steps = [legendre.legint(_fitted(f(self.phi)), lbnd=-1) for f in (np.cos, np.sin)]
        along = [legendre.legval(np.append(_NODES, 1.0), step) / rate for step in steps]
        self.r, self.r_end = first + along[0][:-1], first + along[0][-1]
        self.z, self.z_end = along[1][:-1], along[1][-1]
        self.b = np.cos(self.phi) / self.r * (self.turn - np.sin(self.phi) / self.r)

    def integral(self, values: FloatArray) -> float:
        """Over the surface, without 2π."""
        return float(0.5 * self.length * (_WEIGHTS * values * self.r).sum())


_BASIS = legendre.legvander(_NODES, 60) * (np.arange(61) + 0.5) * _WEIGHTS[:, None]


def _fitted(values: FloatArray) -> FloatArray:
    return np.asarray(values @ _BASIS)


def density(curve: _Curve, functional: Functional) -> FloatArray:
    """What is integrated."""
    a, b = curve.a, curve.b
    if functional == "principal lines":
        return np.asarray(a**2)
    if functional == "mean curvature":
        return np.asarray((a + b) ** 2 / 4)
    return np.asarray((5 * a**2 + 6 * a * b + 9 * b**2) / 16)


def least(ends: Ends, functional: Functional = "all directions", scale_free: bool = True) -> Profile:
    """The profile of least ∫ density dA, times the area where `scale_free`; from the straight one."""
    low, high = ends.angles
    tilt = np.arctan2(ends.length, ends.last - ends.first)
    start = np.zeros(DEGREE + 2)
    start[0], start[-1] = tilt, np.hypot(ends.length, ends.last - ends.first)

    def merit(u: FloatArray) -> float:
        curve = _Curve(u, ends.first)
        value = curve.integral(density(curve, functional))
        return value * curve.integral(np.ones_like(curve.r)) if scale_free else value

    def misses(u: FloatArray) -> FloatArray:
        curve = _Curve(u, ends.first)
        at = legendre.legval(np.array([-1.0, 1.0]), u[:-1])
        return np.array([curve.r_end - ends.last, curve.z_end - ends.length, at[0] - low, at[1] - high])

    met: Any = {"type": "eq", "fun": misses}
    found = minimize(merit, start, method="SLSQP", constraints=[met], options={"ftol": 1e-13, "maxiter": 500})
    if np.abs(misses(found.x)).max() > 1e-6:
        raise RuntimeError(f"no profile was found: {found.message}")
    curve = _Curve(found.x, ends.first)
    return Profile(curve.r, curve.z)
