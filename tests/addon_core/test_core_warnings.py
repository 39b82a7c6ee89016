"""The engine's warnings as sentences: one for each kind."""

from __future__ import annotations

import numpy as np

import fairing
from core.warnings_text import counted, sentences

FLIPPED = "triangles of the result are turned over"
SHARP = "the normals along the outline turn by up to {}° from one vertex to the next"
LOST = "a component of {} free vertices did not converge; its positions are the best that were found"


def warnings(*given: tuple[str, str]) -> tuple[str, ...]:
    none = np.empty(0, dtype=np.int32)
    return sentences(tuple(fairing.Diagnostic(code, text, none, "vertex") for code, text in given))


def test_warnings_of_several_islands_are_one() -> None:
    assert warnings(
        ("FLIPPED_TRIANGLES", f"3 {FLIPPED}"),
        ("SHARP_BOUNDARY", SHARP.format(24)),
        ("FLIPPED_TRIANGLES", f"18 {FLIPPED}"),
        ("NOT_CONVERGED", LOST.format(5)),
        ("SHARP_BOUNDARY", SHARP.format(31)),
        ("PRECISION", "this far from the origin"),
        ("SHARP_BOUNDARY", SHARP.format(22)),
        ("NOT_CONVERGED", LOST.format(70)),
        ("PRECISION", "this far from the origin"),
    ) == (
        f"FLIPPED_TRIANGLES: 21 {FLIPPED} (2 islands)",
        f"SHARP_BOUNDARY: {SHARP.format(31)} (3 islands)",
        "NOT_CONVERGED: 2 islands, of 75 free vertices in all, did not converge; their positions are the best found",
        "PRECISION: this far from the origin (2 islands)",
    )


def test_islands_with_a_part_of_their_load_tell_the_largest_part() -> None:
    partly = "a component of {} free vertices was solved with {} % of the load only and keeps that surface"
    assert warnings(("NOT_CONVERGED", partly.format(70, 50)), ("NOT_CONVERGED", partly.format(61, 75))) == (
        f"NOT_CONVERGED: {partly.format(70, 75)} (2 islands)",
    )


def test_counted() -> None:
    assert [counted(n, "face", "faces") for n in (0, 1, 2)] == ["0 faces", "1 face", "2 faces"]
