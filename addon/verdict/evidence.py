"""What a verdict follows from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ..arrays.region import nothing
from ..arrays.types import Floats, Ints
from ..fair.engine import Problem, Result
from ..selection.selection import LeftOut
from ..words.findings import Finding, Origin, found
from .lost import Lost
from .quality import Measured

Found = tuple[str, Ints]  # a sentence and the mesh vertices that it is about
NOTHING: Found = ("", nothing())


@dataclass(frozen=True)
class Evidence:
    """What a verdict follows from."""

    problem: Problem
    result: Result
    failures: tuple[str, ...]  # the engine's own words for why there is no answer
    seen: Measured  # what the engine sees of it
    squeezed: Ints = field(default_factory=nothing)  # mesh vertices where lines that a new mesh keeps are a knot
    lost: Lost = field(default_factory=Lost)
    left_out: LeftOut = field(default_factory=LeftOut)
    points: Floats | None = None  # (q, 3) of problem.vertices after the run; None: problem.points
    origin: Origin | None = None  # what the engine's numbers stand for; None: problem.origin

    def reported(self, code: str, *figures: str) -> Iterator[Finding]:
        """Find what the engine reported under a code, with any of the figures; all of that code without any."""
        origin = self.origin or self.problem.origin
        for warning in self.result.warnings:
            if warning.code == code and (not figures or any(name in warning.figures for name in figures)):
                yield found(warning, origin)

    def named(self, code: str, figure: str = "") -> Ints:
        """Return the mesh vertices that the engine names so."""
        named = (finding.named for finding in self.reported(code, *filter(None, [figure])))
        vertices: Ints = np.concatenate([nothing(), *named])
        return vertices


def corners_of(problem: Problem, faces: Ints) -> Ints:
    """Return the mesh vertices of faces of the mesh within the patch."""
    patch = problem.patch
    corners: Ints = np.unique(patch.vertices[patch.triangles[np.isin(patch.faces, faces)]])
    return corners
