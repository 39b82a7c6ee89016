"""Filled holes as one verdict and a list of figures, for the panel and for scripts. Plain Python, no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .across import told
from .filling import FillOptions, Piece
from .report import Check, Report, distortion_text, kink_checks, shape_checks
from .verdict import GRADES, UNUSABLE, NotUsable, Verdict
from .words import counted

Named = Sequence[tuple[str, list[Piece]]]


@dataclass(frozen=True)
class Added:
    """What is reported about the new faces of one object."""

    faces: int
    mixed: int  # boundary vertices where colours or other values of the two border faces differ: their mean counts
    seams: int  # new edges where UVs part
    distortion: float  # area-weighted mean of the conformal distortion − 1 on the active UV map; 0 without one
    covering: int = 0  # new triangles that lie over other faces on that map

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence for each thing that is worth a look."""
        notes = []
        if self.seams:
            text = counted(self.seams, "new edge is a seam", "new edges are seams")
            notes.append(f"{text} of UVs: each island at the boundary goes on by itself")
        if self.covering:
            text = counted(self.covering, "new triangle lies", "new triangles lie")
            notes.append(f"{text} over other faces in the texture: move the islands apart before you paint")
        if self.mixed:
            text = counted(self.mixed, "vertex of the boundary lies", "vertices of the boundary lie")
            notes.append(f"{text} where colours of two faces differ: new faces begin with the mean there")
        return tuple(notes)


def is_written(named: Named, options: FillOptions) -> bool:
    """Return whether the run changes its meshes: all of them, or none."""
    return options.accept == "ALL" or all(_worst(pieces).grade != UNUSABLE for _, pieces in named)


def refuse_unusable(name: str, pieces: list[Piece], options: FillOptions) -> None:
    """Raise NotUsable where the surfaces are not to be written."""
    if not is_written([(name, pieces)], options):
        bad = max(pieces, key=lambda piece: GRADES.index(piece.verdict.grade))
        raise NotUsable(bad.verdict, bad.result)


def make_fill_report(
    named: Named, options: FillOptions, seconds: float, added: Sequence[Added] = (), notes: tuple[str, ...] = ()
) -> Report:
    """Sum up the surfaces of one run, by object name.

    added: what was written, if anything was; notes: what else is reported.
    """
    pieces = [piece for _, of_object in named for piece in of_object]
    results = [piece.result for piece in pieces]
    joins = [piece.join for piece in pieces]
    worst_join = max(joins, key=lambda join: join.worst)
    distortion = max((each.distortion for each in added), default=0.0)
    return Report(
        objects=tuple(name for name, _ in named),
        free_vertices=sum(len(piece.positions) for piece in pieces),
        converged=all(result.converged for result in results),
        residual=max((result.residual for result in results), default=0.0),
        boundary_angle=max((float(result.boundary_angle.max(initial=0.0)) for result in results), default=0.0),
        distortion=distortion,
        seconds=seconds,
        checks=(*shape_checks(results, options.equation), *kink_checks(joins), *_checks(pieces, added, distortion)),
        warnings=tuple(dict.fromkeys(note for piece in pieces for note in piece.notes))
        + tuple(note for each in added for note in each.notes)
        + notes,
        verdict=_named_worst(named),
        written=is_written(named, options),
        join=(worst_join.typical, worst_join.worst),
        deed="filled in",
    )


def _worst(pieces: list[Piece]) -> Verdict:
    return max((piece.verdict for piece in pieces), key=lambda verdict: GRADES.index(verdict.grade))


def _named_worst(named: Named) -> Verdict:
    name, pieces = max(named, key=lambda pair: GRADES.index(_worst(pair[1]).grade))
    verdict = _worst(pieces)
    if len(named) == 1 or not verdict.reason:
        return verdict
    return Verdict(verdict.grade, f"{name}: {verdict.reason}", verdict.spots)


def _checks(pieces: list[Piece], added: Sequence[Added], distortion: float) -> tuple[Check, ...]:
    edges = told([piece.across for piece in pieces])
    faces = sum(each.faces for each in added) if added else sum(len(piece.triangles) for piece in pieces)
    return (
        Check("New faces", str(faces)),
        *((Check("Hard edges", edges),) if edges else ()),
        *((Check("Surfaces", str(len(pieces))),) if len(pieces) > 1 else ()),
        *((Check("Texture distortion", distortion_text(distortion)),) if distortion else ()),
    )
