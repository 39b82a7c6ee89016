"""What the engine makes of a problem, and how far that is from the truth."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Any

import numpy as np

import fairing
import measures
from fairing import _core, _run_on
from problems import Problem

REFUSED = 1.0  # of the size: the distance that a refusal counts
Answer = tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class _Hole:
    """A hole, and what the engine says about its surroundings."""

    edges: _run_on.Edges
    holes: _core.Holes
    vertices: np.ndarray


class Answers:
    """Of one problem, kept by what the limits have decided: the surface follows from that."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self._known: dict[bytes, float] = {}
        self._around: Any = None

    def distance(self, same_engine: bool = False) -> float:
        """From the truth and back, the larger of both means, over the size; with the limits as they are now.

        same_engine: those of the engine are as they were at the last call.
        """
        decided = self._decided(same_engine)
        if decided not in self._known:
            self._known[decided] = self._measured()
        return self._known[decided]

    def _decided(self, same_engine: bool) -> bytes:
        if self._around is None or not same_engine:
            self._around = self._found_around()
        if not isinstance(self._around, _Hole):
            return bytes(self._around)
        hole = self._around
        ((normals, _),) = hole.holes.slopes(0.0)
        (curves,) = hole.edges.through(hole.holes, hole.vertices, (0.0, False))
        if not isinstance(curves, _run_on.Curves):
            return _hashed([normals]) + str(curves).encode()
        return _hashed([normals, curves.added, curves.rims, curves.rows, *curves.curves, *curves.cut.loops])

    def _found_around(self) -> Any:
        """What the engine decides: normals and sides of a selection, as bytes; hard edges and normals of a hole."""
        problem = self.problem
        if not problem.is_hole:
            found = boundary(problem)
            return _hashed([found.normals, found.from_inside])
        vertices, around = np.ascontiguousarray(problem.vertices), np.ascontiguousarray(problem.outside, np.int32)
        edges = _run_on.Edges.of((vertices, around), ("run_on", None, None), False)
        named = [loop_of(problem)], [], [], np.empty((0, 3)), np.empty(0), 0, 0.0
        try:
            holes = _core.Holes(vertices, around, edges.hard, named, False, 1)
        except fairing.MeshError as error:
            return str(error).encode()
        return _Hole(edges, holes, vertices)

    def _measured(self) -> float:
        try:
            points, triangles = solved(self.problem)
        except (ValueError, fairing.SolverError):  # MeshError is a ValueError
            return REFUSED
        return away((points, triangles), self.problem)


def away(answer: Answer, problem: Problem) -> float:
    """The larger mean distance, over the size, REFUSED at most."""
    means = []
    for (points, triangles), other in ((answer, problem.truth), (problem.truth, answer)):
        places = measures.sampled(points, triangles, 2)
        means.append(float(measures.distance_to_mesh(places, other[0], other[1]).mean()))
    return min(REFUSED, max(means) / problem.size)


def loop_of(problem: Problem) -> Any:
    """The boundary, with the part on its left."""
    (loop,) = fairing.boundary_loops(problem.inside)
    return loop


def boundary(problem: Problem) -> Any:
    """Normals at the boundary of a selection."""
    return fairing.boundary_normals(problem.vertices, problem.inside, problem.rim, outside=problem.outside)


def solved(problem: Problem) -> Answer:
    """The surface: all points, and its triangles."""
    if problem.is_hole:
        filled = fairing.fill(problem.vertices, problem.outside, [loop_of(problem)], threads=1)
        return np.concatenate([problem.vertices, filled.vertices]), filled.triangles
    known = boundary(problem)
    ok = np.linalg.norm(known.normals, axis=1) > 0.5
    faired = fairing.fair(
        problem.vertices, problem.inside, fixed=problem.rim[ok], fixed_normals=known.normals[ok], threads=1
    )
    return faired.vertices, problem.inside


def _hashed(arrays: list[Any]) -> bytes:
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())
        digest.update(b"|")
    return digest.digest()
