"""Exact surfaces with coordinates (s, t): curves revolved about the z axis or extruded along it.

s is the arc length of the curve, t the angle (revolved) or the height (extruded). `side` is +1 for
the surface normal left of the curve, −1 for right. Mean curvature has the sign of eq. 8 of
Schneider & Kobbelt (2001): −1/R on a sphere of radius R with outward normals.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from curves import Curve, FloatArray


@dataclass(frozen=True)
class Surface:
    """What the mesher and the measures need: `point`, `normal`, `mean_curvature` (length⁻¹), `width` (length per unit
    of t), `frame` (unit tangents along s and t), `locate` (the nearest (s, t), continued a little past the boundary),
    `chart` (a conformal map to the plane, in which Delaunay is nearly Delaunay in space). Arrays s, t are (k,).
    """

    curve: Curve
    side: int = 1

    def distance(self, points: FloatArray) -> FloatArray:
        """Unsigned distances (k,) to the surface, continued a little past its boundary."""
        return np.asarray(np.linalg.norm(points - self.point(*self.locate(points)), axis=1))


@dataclass(frozen=True)
class Extrusion(Surface):
    """The curve (x, y) times the z axis."""

    def point(self, s: FloatArray, t: FloatArray) -> FloatArray:
        at = self.curve.frame(s)
        return np.column_stack([at.x, at.y, t])

    def normal(self, s: FloatArray, t: FloatArray) -> FloatArray:
        angle = self.curve.frame(s).angle
        return self.side * np.column_stack([-np.sin(angle), np.cos(angle), 0 * t])

    def mean_curvature(self, s: FloatArray) -> FloatArray:
        return 0.5 * self.side * self.curve.frame(s).curvature

    def width(self, s: FloatArray) -> FloatArray:
        return np.ones_like(s)

    def frame(self, s: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        angle = self.curve.frame(s).angle
        along = np.column_stack([np.cos(angle), np.sin(angle), 0 * t])
        return along, np.broadcast_to([0.0, 0.0, 1.0], along.shape)

    def locate(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        return self.curve.nearest(points[:, 0], points[:, 1]), points[:, 2].copy()

    def chart(self, s: FloatArray, t: FloatArray) -> FloatArray:
        return np.column_stack([s, t])


@dataclass(frozen=True)
class Revolution(Surface):
    """The curve (r, z) about the z axis."""

    side: int = -1

    def point(self, s: FloatArray, t: FloatArray) -> FloatArray:
        at = self.curve.frame(s)
        return np.column_stack([at.x * np.cos(t), at.x * np.sin(t), at.y])

    def normal(self, s: FloatArray, t: FloatArray) -> FloatArray:
        angle = self.curve.frame(s).angle
        radial = -np.sin(angle)
        return self.side * np.column_stack([radial * np.cos(t), radial * np.sin(t), np.cos(angle)])

    def mean_curvature(self, s: FloatArray) -> FloatArray:
        at = self.curve.frame(s)
        pole = at.x < 1e-9
        across = np.where(pole, at.curvature, np.sin(at.angle) / np.where(pole, 1.0, at.x))
        return 0.5 * self.side * (at.curvature + across)

    def width(self, s: FloatArray) -> FloatArray:
        return self.curve.frame(s).x

    def frame(self, s: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        angle = self.curve.frame(s).angle
        outward = np.cos(angle)
        along = np.column_stack([outward * np.cos(t), outward * np.sin(t), np.sin(angle)])
        return along, np.column_stack([-np.sin(t), np.cos(t), 0 * t])

    def locate(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        radius = np.hypot(points[:, 0], points[:, 1])
        return self.curve.nearest(radius, points[:, 2]), np.arctan2(points[:, 1], points[:, 0])

    @cached_property
    def _isothermal(self) -> tuple[FloatArray, FloatArray]:
        """∫ ds/r, for meshing only, so the trapezoidal rule will do."""
        curve = self.curve
        s = np.linspace(curve.start - curve.margin, curve.stop + curve.margin, 4001)
        rate = 1.0 / curve.frame(s).x
        steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(s)
        return s, np.concatenate([[0.0], np.cumsum(steps)])

    def chart(self, s: FloatArray, t: FloatArray) -> FloatArray:
        return np.column_stack([np.interp(s, *self._isothermal), t])


@dataclass(frozen=True)
class Sphere(Revolution):
    """A sphere about the origin with s measured from its north pole; charts are stereographic."""

    side: int = 1

    @property
    def radius(self) -> float:
        """The radius of the sphere."""
        return float(np.abs(self.curve.frame(np.zeros(1)).y[0]))

    def locate(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        polar = np.arctan2(np.hypot(points[:, 0], points[:, 1]), points[:, 2])
        return self.radius * polar, np.arctan2(points[:, 1], points[:, 0])

    def distance(self, points: FloatArray) -> FloatArray:
        return np.asarray(np.abs(np.linalg.norm(points, axis=1) - self.radius))

    def chart(self, s: FloatArray, t: FloatArray) -> FloatArray:
        rho = np.tan(0.5 * s / self.radius)
        return np.column_stack([rho * np.cos(t), rho * np.sin(t)])

    def unchart(self, plane: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(s, t) of points (k, 2) of the chart."""
        rho = np.hypot(plane[:, 0], plane[:, 1])
        return 2 * self.radius * np.arctan(rho), np.arctan2(plane[:, 1], plane[:, 0])
