"""The engine's errors and warnings as sentences: in the mesh's numbers, one for each kind."""

from __future__ import annotations

import re
from string import Formatter

import numpy as np
import pytest

import fairing
from core.findings import Origin, found
from core.region import make_patch
from core.sentences import in_mesh_words, refusal, sentences
from core.words import WORDS, Words, counted
from polygon_mesh import grid

# Six vertices and four triangles of the engine, which are two quads of a mesh: its vertices 10 … 60, its faces 7 and 9.
ORIGIN = Origin(
    vertices=np.array([10, 20, 30, 40, 50, 60]),
    triangles=np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]),
    faces=np.array([7, 7, 9, 9]),
)


def diagnostic(code: str, elements: list[int], kind: str = "vertex", **figures: float) -> fairing.Diagnostic:
    return fairing.Diagnostic(code, "the engine's own words", np.array(elements, dtype=np.int32), kind, figures)


def reported(*warnings: fairing.Diagnostic) -> tuple[str, ...]:
    return sentences(warnings, ORIGIN)


def test_every_code_has_words() -> None:
    assert set(WORDS) == set(fairing.CODES)


@pytest.mark.parametrize("code", fairing.CODES)
def test_the_last_case_of_a_code_holds_without_any_figure_but_those_it_names(code: str) -> None:
    """So that a case of the engine's that is new here still reads as a sentence."""
    assert [bool(words.when) for words in WORDS[code]] == [True] * (len(WORDS[code]) - 1) + [False]
    figures = dict.fromkeys(_fields(WORDS[code][-1]) - {"n", "first", "ends", "islands"}, 1.0)
    (text,) = reported(diagnostic(code, [0, 1], **figures))
    assert text[0].isupper() or text[0].isdigit()
    assert code not in text and "{" not in text and "triangle" not in text


def _fields(words: Words) -> set[str]:
    return {field for text in (words.one, words.many) for _, field, _, _ in Formatter().parse(text) if field}


def test_triangles_are_counted_by_their_faces_and_edges_by_the_meshs_vertices() -> None:
    assert reported(diagnostic("FLIPPED_TRIANGLES", [0, 2, 3], "triangle", triangles=3.0)) == (
        "2 faces of the result are turned over",
    )
    assert reported(diagnostic("FOLDED", [0, 1], "triangle", turned_over=2.0, free_vertices=8.0)) == (
        "The surface was found, but 1 face can't be placed on it without folds",
    )
    assert reported(diagnostic("NO_SOLUTION", [0, 1, 2], free_vertices=3.0, harmonic=1.0)) == (
        "No harmonic surface fits the boundary: Least Variation was used",
    )
    assert reported(diagnostic("NO_SOLUTION", [0, 2], free_vertices=3.0, harmonic=1.0, loft=1.0, kinks=2.0)) == (
        "No fair surface fits these boundary loops: a loft joins them, with a kink at 2 vertices",
    )
    assert reported(diagnostic("NO_SOLUTION", [0, 1, 2], free_vertices=3.0, harmonic=1.0, loft=1.0)) == (
        "No fair surface fits these boundary loops: a loft joins them",
    )
    assert reported(diagnostic("OUTLINE_KEPT", [0, 2], vertices=2.0, worse=1.0)) == (
        "Smooth Boundary was left out: with 2 boundary vertices moved, the result is worse",
    )
    assert reported(diagnostic("OUTLINE_KEPT", [0, 2], vertices=2.0)) == (
        "2 vertices of a noisy boundary keep their place",
    )
    edge = refusal(found(diagnostic("NONMANIFOLD_EDGE", [4, 1, 0, 2], edges=2.0), ORIGIN))
    assert "the edge 50–20" in str(edge)
    assert edge.elements.tolist() == [10, 20, 30, 50]
    assert edge.kind == "vertex"


def test_an_error_speaks_of_the_mesh_and_keeps_its_code() -> None:
    twisted = diagnostic("NOT_ORIENTABLE", [2], "triangle", triangles=1.0)
    with pytest.raises(fairing.MeshError, match="through vertex 20: ") as refused, in_mesh_words(ORIGIN):
        raise fairing.MeshError(twisted)
    assert refused.value.code == "NOT_ORIENTABLE"
    assert "NOT_ORIENTABLE" not in str(refused.value)
    assert refused.value.elements.tolist() == [20, 30, 60]


def test_a_surface_with_folds_is_reported_once() -> None:
    """The engine gives two codes for it, for those who ask for either."""
    assert reported(
        diagnostic("NOT_CONVERGED", [0], free_vertices=8.0, folds=2.0),
        diagnostic("FOLDED", [0, 1], "triangle", turned_over=2.0, free_vertices=8.0),
    ) == ("The surface was found, but 1 face can't be placed on it without folds",)


@pytest.mark.parametrize("even", [True, False])
def test_a_patch_knows_the_faces_of_its_triangles(even: bool) -> None:
    """Each triangle's corners are corners of its face, and each face of the patch has its area."""
    mesh = grid(6, 0.7)
    patch = make_patch(mesh, even)
    corners = mesh.corner_vertices.reshape(-1, 4)
    assert np.array_equal(np.unique(patch.faces), np.flatnonzero(mesh.in_patch))
    for triangle, face in zip(patch.vertices[patch.triangles], patch.faces, strict=True):
        assert set(triangle) < set(corners[face])


def test_counted() -> None:
    assert [counted(n, "face", "faces") for n in (0, 1, 2)] == ["0 faces", "1 face", "2 faces"]


def test_no_sentence_speaks_of_the_engine() -> None:
    texts = " ".join(text for cases in WORDS.values() for words in cases for text in (words.one, words.many))
    assert not re.search(r"triang|compon|fixed_normals|fixed,|load\b", texts)


def test_a_figure_may_have_the_name_of_a_field() -> None:
    """Ends of hard edges are counted as `ends`, which in sentences are those of an edge."""
    figures = {"ends": 2.0, "ambiguous": 1.0}
    warning = fairing.Diagnostic("EDGES_LEFT_ALONE", "", np.array([3, 5], np.int32), "vertex", figures)
    none = np.empty((0, 3), dtype=np.int64)
    (text,) = sentences((warning,), Origin(np.arange(10, 20), none, none[:, 0]))
    assert text.startswith("2 hard edges end at the hole, at vertex 13 and others")
