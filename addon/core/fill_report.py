"""Filled holes as one verdict and a list of figures, for the panel and for scripts. Plain Python, no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .filling import FillOptions, Piece, worst
from .quality import VISIBLE
from .report import MET, MISSED, Check, Report, angle_text, distortion_text
from .verdict import GRADES, UNUSABLE, NotUsable, Verdict
from .words import counted

Named = Sequence[tuple[str, list[Piece]]]


@dataclass(frozen=True)
class Added:
    """What there is to tell about the new faces of one object."""

    faces: int
    seams: int  # outline vertices where UVs or other values of the two border faces differ: their mean counts
    distortion: float  # area-weighted mean of the conformal distortion − 1 on the active UV map; 0 without one

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence for what is worth a look."""
        if not self.seams:
            return ()
        text = counted(self.seams, "vertex of the outline lies", "vertices of the outline lie")
        return (f"{text} on a seam of UVs or colours: new faces begin with the mean there",)


def is_written(named: Named, options: FillOptions) -> bool:
    """Tell whether the run changes its meshes: all of them, or none."""
    return options.accept == "ALL" or all(worst(pieces).grade != UNUSABLE for _, pieces in named)


def refuse_unusable(name: str, pieces: list[Piece], options: FillOptions) -> None:
    """Raise NotUsable where the surfaces are not to be written."""
    if not is_written([(name, pieces)], options):
        bad = max(pieces, key=lambda piece: GRADES.index(piece.verdict.grade))
        raise NotUsable(bad.verdict, bad.result)


def make_fill_report(named: Named, options: FillOptions, seconds: float, added: Sequence[Added] = ()) -> Report:
    """Sum up the surfaces of one run, by object name; added: what was written, if anything was."""
    pieces = [piece for _, of_object in named for piece in of_object]
    results = [piece.result for piece in pieces]
    joins = np.concatenate([np.empty(0), *(result.join for result in results)])
    join = (float(np.median(joins)), float(joins.max())) if len(joins) else (0.0, 0.0)
    distortion = max((each.distortion for each in added), default=0.0)
    kink = Check(
        "Kink at the outline",
        f"{angle_text(join[0])}, at most {angle_text(join[1])}",
        MET if join[1] <= VISIBLE else MISSED,
    )
    return Report(
        objects=tuple(name for name, _ in named),
        free_vertices=sum(len(piece.positions) for piece in pieces),
        converged=all(result.converged for result in results),
        residual=max((result.residual for result in results), default=0.0),
        boundary_angle=max((float(result.boundary_angle.max(initial=0.0)) for result in results), default=0.0),
        distortion=distortion,
        seconds=seconds,
        checks=(kink, *_checks(pieces, added, distortion)),
        warnings=tuple(dict.fromkeys(note for piece in pieces for note in piece.notes))
        + tuple(note for each in added for note in each.notes),
        verdict=_named_worst(named),
        written=is_written(named, options),
        join=join,
        deed="filled in",
    )


def _named_worst(named: Named) -> Verdict:
    name, pieces = max(named, key=lambda pair: GRADES.index(worst(pair[1]).grade))
    verdict = worst(pieces)
    if len(named) == 1 or not verdict.reason:
        return verdict
    return Verdict(verdict.grade, f"{name}: {verdict.reason}", verdict.spots)


def _checks(pieces: list[Piece], added: Sequence[Added], distortion: float) -> tuple[Check, ...]:
    faces = sum(each.faces for each in added) if added else sum(len(piece.triangles) for piece in pieces)
    return (
        Check("New faces", str(faces)),
        *((Check("Surfaces", str(len(pieces))),) if len(pieces) > 1 else ()),
        *((Check("Texture distortion", distortion_text(distortion)),) if distortion else ()),
    )
