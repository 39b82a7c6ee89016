"""Filled holes as one verdict and a list of figures, for the panel and for scripts. Plain Python, no bpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..arrays.border import notes_on
from ..mirror.symmetry import NOT_SYMMETRIC
from ..options.other_options import FillOptions
from ..verdict.report import MISSED, Check, Report, distortion_text, kink_checks, shape_checks
from ..verdict.verdict import GOOD, GRADES, LOOK, UNUSABLE, NotUsable, Verdict
from ..words.words import said
from .across import reported
from .pieces import Filled, Piece

Named = Sequence[tuple[str, Filled]]


@dataclass(frozen=True)
class Added:
    """What is reported about the new faces of one object."""

    vertices: int
    faces: int
    mixed: int  # boundary vertices where colours or other values of the two border faces differ: their mean counts
    seams: int  # new edges where UVs part
    distortion: float  # area-weighted mean of the conformal distortion − 1 on the active UV map; 0 without one
    is_symmetric: bool = True  # as X mirror asks for

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence for each thing that is worth a look."""
        counts = (("uv_seams", self.seams), ("colours_differ", self.mixed))
        notes: list[str] = [said(key, n=count) for key, count in counts if count]
        if not self.is_symmetric:
            notes.append(NOT_SYMMETRIC)
        return tuple(notes)


def is_written(named: Named, options: FillOptions) -> bool:
    """Return whether the run changes its meshes: not where no surface is usable."""
    return options.allow_folds or any(_worst(of_one.pieces).grade != UNUSABLE for _, of_one in named)


def writable(named: Named, options: FillOptions) -> list[tuple[str, Filled]]:
    """Return what is written: of an object whose surfaces are all unusable nothing, where another one has some."""
    if options.allow_folds or not is_written(named, options):
        return list(named)
    return [(name, of_one if _worst(of_one.pieces).grade != UNUSABLE else of_one.unfilled()) for name, of_one in named]


def refuse_unusable(name: str, filled: Filled, options: FillOptions) -> None:
    """Raise NotUsable where the surfaces are not to be written."""
    if not is_written([(name, filled)], options):
        bad = max(filled.pieces, key=lambda piece: GRADES.index(piece.verdict.grade))
        raise NotUsable(bad.verdict, bad.result)


def make_fill_report(
    named: Named, options: FillOptions, seconds: float, added: Sequence[Added] = (), notes: tuple[str, ...] = ()
) -> Report:
    """Sum up the surfaces of one run, by object name.

    added: what was written, if anything was; notes: what else is reported.
    """
    pieces = [piece for _, of_object in named for piece in of_object.pieces]
    left = [each for _, of_object in named for each in of_object.left]
    results = [piece.result for piece in pieces]
    joins = [piece.join for piece in pieces]
    worst_join = max(joins, key=lambda join: join.worst)
    distortion = max((each.distortion for each in added), default=0.0)
    return Report(
        objects=tuple(name for name, _ in named),
        free_vertices=sum(each.vertices for each in added) or sum(len(piece.positions) for piece in pieces),
        converged=all(result.converged for result in results),
        residual=max((result.residual for result in results), default=0.0),
        boundary_angle=max((float(result.boundary_angle.max(initial=0.0)) for result in results), default=0.0),
        distortion=distortion,
        seconds=seconds,
        checks=(
            *shape_checks(results, options.equation),
            *(kink_checks(joins) if options.equation != "soap_film" else ()),
            *_checks(pieces, added, distortion),
            *((Check("Holes that stay open", str(len(left)), MISSED),) if left else ()),
        ),
        warnings=tuple(dict.fromkeys(note for piece in pieces for note in piece.notes))
        + tuple(note for each in added for note in each.notes)
        + notes_on(left)
        + notes,
        verdict=_named_worst(named),
        written=is_written(named, options),
        join=(worst_join.typical, worst_join.worst),
        deed="done_filled",
    )


def _worst(pieces: list[Piece]) -> Verdict:
    return max((piece.verdict for piece in pieces), key=lambda verdict: GRADES.index(verdict.grade), default=_NOTHING)


_NOTHING = Verdict(GOOD)


def _named_worst(named: Named) -> Verdict:
    name, filled = max(named, key=lambda pair: GRADES.index(_whole(pair[1]).grade))
    verdict = _whole(filled)
    if len(named) == 1 or not verdict.reason:
        return verdict
    return Verdict(verdict.grade, said("named", name=name, text=verdict.reason), verdict.spots)


def _whole(filled: Filled) -> Verdict:
    """Return the verdict on one object: holes that stay open come before all that shows in a surface."""
    worst = _worst(filled.pieces)
    if worst.grade == UNUSABLE or not filled.left:
        return worst
    return Verdict(LOOK, _on_left(filled), filled.left_vertices)


def _on_left(filled: Filled) -> str:
    count = len(filled.left)
    return said("holes_left", n=count, all=count + len(filled.pieces), reason=filled.left[0].reason)


def _checks(pieces: list[Piece], added: Sequence[Added], distortion: float) -> tuple[Check, ...]:
    edges = reported([piece.across for piece in pieces])
    faces = sum(each.faces for each in added) if added else sum(len(piece.triangles) for piece in pieces)
    return (
        Check("New faces", str(faces)),
        *((Check("Hard edges", edges),) if edges else ()),
        *((Check("Surfaces", str(len(pieces))),) if len(pieces) > 1 else ()),
        *((Check("Texture distortion", distortion_text(distortion)),) if distortion else ()),
    )
