"""Tubes of unequal radii that meet, with irregular meshes, as problems with an outline and normals only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, cKDTree

from tubes import FloatArray, Tube


@dataclass(frozen=True)
class Arm:
    """A tube along a direction from the origin: its radius, how far away it ends, its lean inwards (degrees)."""

    direction: tuple[float, float, float]
    radius: float = 1.0
    reach: float = 3.0
    lean: float = 0.0

    @property
    def axis(self) -> FloatArray:
        """Unit vector outwards."""
        return np.asarray(self.direction, float) / np.linalg.norm(self.direction)

    @property
    def across(self) -> tuple[FloatArray, FloatArray]:
        """Two unit vectors at right angles to the axis and each other."""
        helper = np.eye(3)[np.abs(self.axis).argmin()]
        first = np.cross(self.axis, helper)
        first /= np.linalg.norm(first)
        return first, np.cross(self.axis, first)


def flat_arm(degrees: float, radius: float = 1.0, reach: float = 3.0, lean: float = 0.0) -> Arm:
    """In the plane z = 0."""
    angle = np.radians(degrees)
    return Arm((float(np.cos(angle)), float(np.sin(angle)), 0.0), radius, reach, lean)


def _hub_share(arms: list[Arm]) -> float:
    """Sine of the angle, seen from the origin, at which an arm of radius 1 begins: arms don't touch there."""
    share = np.inf
    for k, arm in enumerate(arms):
        for other in arms[:k]:
            between = np.arccos(np.clip(arm.axis @ other.axis, -1, 1))
            share = min(share, np.sin(0.35 * min(between, np.pi / 2)) / max(arm.radius, other.radius))
    return float(share)


def _ring(arm: Arm, angle: FloatArray, turn: FloatArray) -> FloatArray:
    """Points of the unit sphere by their angle from the arm and the turn around it."""
    first, second = arm.across
    circle = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * second
    return np.asarray(np.cos(angle)[:, None] * arm.axis + np.sin(angle)[:, None] * circle)


def _columns(arm: Arm, arms: list[Arm], around: int) -> int:
    return max(8, round(around * arm.radius / max(other.radius for other in arms)))


def _rows(arm: Arm, columns: int, share: float, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """An arm mapped conformally into the sphere: jittered rows, then its rim."""
    begin = np.arcsin(share * arm.radius)
    step = 2 * np.pi / columns * np.sqrt(0.75)
    rows = max(2, round((arm.reach / arm.radius - np.cos(begin) / (share * arm.radius)) / step))
    height = np.repeat(np.arange(rows), columns) + rng.uniform(-0.3, 0.3, rows * columns)
    turn = 2 * np.pi / columns * (np.tile(np.arange(columns), rows) + rng.uniform(-0.35, 0.35, rows * columns))
    turn += np.pi / columns * (np.repeat(np.arange(rows), columns) % 2)
    inner = _ring(arm, begin * np.exp(-step * height), turn)
    rim_turn = 2 * np.pi / columns * (np.arange(columns) + 0.3)
    return inner, _ring(arm, np.full(columns, begin * np.exp(-step * rows)), rim_turn)


def _hub(arms: list[Arm], share: float, spacing: float, rng: np.random.Generator) -> FloatArray:
    """Points of the sphere between the arms, at least `spacing` apart, in no order."""
    tried = rng.normal(size=(int(200 / spacing**2), 3))
    tried /= np.linalg.norm(tried, axis=1)[:, None]
    for arm in arms:
        beyond = np.arccos(np.clip(tried @ arm.axis, -1, 1)) > np.arcsin(share * arm.radius) + 0.7 * spacing
        tried = tried[beyond]
    near, kept = cKDTree(tried).query_ball_point(tried, 0.8 * spacing), np.zeros(len(tried), dtype=bool)
    for k, others in enumerate(near):
        kept[k] = not kept[others].any()
    return np.asarray(tried[kept])


def joint(arms: list[Arm], around: int = 24, seed: int = 0) -> Tube:
    """The widest arm has `around` edges; `seed` makes the mesh another one, never the outlines."""
    rng, share = np.random.default_rng(seed), _hub_share(arms)
    widest = max(arm.radius for arm in arms)
    columns = [_columns(arm, arms, around) for arm in arms]
    parts = [_rows(arm, count, share, rng) for arm, count in zip(arms, columns, strict=True)]
    inner = np.concatenate([_hub(arms, share, 2 * np.pi * share * widest / around, rng), *(part[0] for part in parts)])
    sphere = np.concatenate([inner, *(part[1] for part in parts)])
    owner = np.concatenate([np.full(len(inner), -1), np.repeat(np.arange(len(arms)), columns)])
    triangles = ConvexHull(sphere).simplices.astype(np.int64)
    corners = sphere[triangles]
    inside_out = np.linalg.det(corners) < 0
    triangles[inside_out] = triangles[inside_out][:, ::-1]
    caps = (owner[triangles] == owner[triangles][:, :1]).all(axis=1) & (owner[triangles[:, 0]] >= 0)
    vertices, normals = sphere.copy(), np.zeros_like(sphere)
    for k, arm in enumerate(arms):
        radial = sphere[owner == k] - np.outer(sphere[owner == k] @ arm.axis, arm.axis)
        radial /= np.linalg.norm(radial, axis=1)[:, None]
        vertices[owner == k] = arm.reach * arm.axis + arm.radius * radial
        normals[owner == k] = np.cos(np.radians(arm.lean)) * radial - np.sin(np.radians(arm.lean)) * arm.axis
    fixed = np.arange(len(inner), len(sphere))
    return Tube(vertices, triangles[~caps], fixed, normals[fixed])
