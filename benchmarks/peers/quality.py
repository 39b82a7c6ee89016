"""What a result is worth: where it lies, how it meets its outline, what became of the triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import clock
import fairing
import measures
from problems import FloatArray, Problem
from tools import Tool


@dataclass(frozen=True)
class Quality:
    """error, error_from_right: largest distance to the exact surface over D, started from a membrane and from the exact
    surface itself; between: distance between the results on two meshes over D, chords included; angle: largest between
    prescribed and fitted normals at the outline, degrees; flipped: triangles; distortion, worst: median and 95 % of the
    ratio of stretches from the exact surface's triangles, 1 being conformal, when started from that surface."""

    error: float
    error_from_right: float
    between: float
    angle: float
    flipped: int
    distortion: float
    worst: float


def judged(tool: Tool, one: Problem, other: Problem) -> Quality:
    """The tool on two meshes of one patch; all but `between` are of the first."""
    first, right, second = (tool.call(problem) for problem in (one, one.from_reference(), other))
    points = first.vertices
    stretch = fairing.conformal_distortion(one.reference, right.vertices, one.triangles)
    return Quality(
        clock.error(one, first),
        clock.error(one, right),
        _between(one, points, other, second.vertices) / one.diameter,
        float(_angles(one, points).max()),
        _flipped(one, points),
        float(np.median(stretch)),
        float(np.quantile(stretch, 0.95)),
    )


def _between(one: Problem, first: FloatArray, other: Problem, second: FloatArray) -> float:
    """Largest distance from a vertex or centroid of either mesh to the other."""
    meshes = [(first, one.triangles), (second, other.triangles)]
    samples = [np.vstack([points, points[triangles].mean(axis=1)]) for points, triangles in meshes]
    forth = measures.distance_to_mesh(samples[0], *meshes[1])
    back = measures.distance_to_mesh(samples[1], *meshes[0])
    return float(max(forth.max(), back.max()))


def _angles(problem: Problem, points: FloatArray) -> FloatArray:
    """Degrees (k,) at the outline between the prescribed normals and those fitted to the points alone."""
    fitted = fairing.vertex_normals(points, problem.triangles)[problem.fixed]
    along = (fitted * problem.normals).sum(axis=1)
    across = np.linalg.norm(np.cross(fitted, problem.normals), axis=1)
    return np.asarray(np.degrees(np.arctan2(across, along)))


def _flipped(problem: Problem, points: FloatArray) -> int:
    """Triangles that face away from the mean of their corners' normals."""
    corners = points[problem.triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = fairing.vertex_normals(points, problem.triangles, normals="averaged")[problem.triangles].sum(axis=1)
    return int(((face * normals).sum(axis=1) < 0).sum())
