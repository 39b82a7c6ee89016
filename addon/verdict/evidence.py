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
from .eaten import Eaten
from .lost import Lost
from .quality import Join, Quality

Found = tuple[str, Ints]  # a sentence and the mesh vertices that it is about
NOTHING: Found = ("", nothing())


@dataclass(frozen=True)
class Flank:
    """Where a patch ends on the slope of a bump or a dent."""

    outline: Ints  # its vertices, as patch indices
    is_bump: bool  # or a dent
    rings: int  # of faces to its end


@dataclass(frozen=True)
class Evidence:
    """What a verdict follows from."""

    problem: Problem
    result: Result
    failures: tuple[str, ...]  # the engine's own words for why there is no answer
    before: Quality
    after: Quality
    join: Join
    rounded: Ints = field(default_factory=nothing)  # mesh vertices of hard edges outside that were rounded
    swollen: Ints = field(default_factory=nothing)  # mesh vertices at the tops of knobs
    eaten: Eaten = field(default_factory=Eaten)
    squeezed: Ints = field(default_factory=nothing)  # mesh vertices where lines that a new mesh keeps are a knot
    pierced: Ints = field(default_factory=nothing)  # mesh vertices where the surface passes through faces outside
    flank: Flank | None = None
    lost: Lost = field(default_factory=Lost)
    left_out: LeftOut = field(default_factory=LeftOut)
    seams: Ints = field(default_factory=nothing)  # mesh vertices of held seams of doubled vertices that show as crests
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
