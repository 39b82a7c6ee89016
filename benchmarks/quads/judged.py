"""What is measured of quads over a hole, whoever made them."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from holes import FloatArray, IntArray

Faces = list[list[int]]


@dataclass(frozen=True)
class Figures:
    """Of one hole."""

    untouched: bool  # each boundary edge belongs to one new face, in its place
    quads: float  # share of the faces
    fit: float  # share of the quads' angles within 50 to 130°
    least: float  # degrees
    most: float
    poles: int  # inner vertices without four faces
    faces: int


def figures_of(points: FloatArray, faces: Faces, loop: IntArray) -> Figures:
    """Measure faces over a boundary; loop: its vertices, the new surface on their left."""
    sides = Counter((a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True))
    border = {(a, b) for a, b in sides if (b, a) not in sides}
    wanted = set(zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))
    quads = np.array([face for face in faces if len(face) == 4], dtype=np.int64).reshape(-1, 4)
    angles = corner_angles(points, quads) if len(quads) else np.array([0.0])
    around = Counter(vertex for face in faces for vertex in face)
    on_boundary = set(loop.tolist())
    return Figures(
        untouched=border == wanted and max(sides.values(), default=2) == 1,
        quads=len(quads) / max(1, len(faces)),
        fit=float(((angles >= 50) & (angles <= 130)).mean()),
        least=float(angles.min()),
        most=float(angles.max()),
        poles=sum(count != 4 for vertex, count in around.items() if vertex not in on_boundary),
        faces=len(faces),
    )


def corner_angles(points: FloatArray, quads: IntArray) -> FloatArray:
    """(q, 4) degrees, above 180 where a quad is not convex."""
    corners = points[quads]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = np.cross(ahead, back)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    angles = np.degrees(np.arctan2(np.linalg.norm(cross, axis=2), (ahead * back).sum(axis=2)))
    result: FloatArray = np.where((cross * normals[:, None]).sum(axis=2) < 0, 360 - angles, angles)
    return result
