"""Messages: a key and fields, worded in English and in other languages; those of the engine's errors and warnings."""

import ast
import json
from collections.abc import Iterator
from pathlib import Path
from string import Formatter
from typing import Any

import numpy as np
import pytest
from addon.arrays.region import make_patch
from addon.words.findings import Origin, found
from addon.words.sentences import in_mesh_words, refusal, sentences
from addon.words.words import ENGLISH, Message, Sentence, case_of, joined, said, sentences_of, worded

import fairing
from polygon_mesh import grid

ADDON = Path(__file__).parents[2] / "addon"
LANGUAGES = ("de", "fr")
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


def forms(sentence: Sentence) -> list[str]:
    return [sentence] if isinstance(sentence, str) else sentence


def code_of(key: str) -> str:
    return key.partition(".")[0]


def fields(text: str) -> list[str]:
    return sorted(field for _, field, _, _ in Formatter().parse(text) if field)


def texts_in_the_code() -> Iterator[tuple[str, bool]]:
    """Yield every text in the add-on's modules, and whether it is a key that is said there."""
    for path in ADDON.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value, False
            elif isinstance(node, ast.Call) and getattr(node.func, "id", "") == "said":
                key = node.args[0]
                for each in (key.body, key.orelse) if isinstance(key, ast.IfExp) else (key,):
                    if isinstance(each, ast.Constant):
                        yield str(each.value), True


def test_every_key_that_is_said_has_a_sentence_and_each_sentence_is_said() -> None:
    texts = set(texts_in_the_code())
    assert {text for text, is_key in texts if is_key} - ENGLISH.keys() == set()
    endings = {f"ended_{ending}" for ending in ("converged", "iteration_limit", "stalled", "folded")}
    own = {key for key in ENGLISH if code_of(key) not in fairing.results.CODES}
    assert own - {text for text, _ in texts} - endings == set()


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_has_every_sentence_with_its_fields(language: str) -> None:
    there = sentences_of(language)
    assert there.keys() == ENGLISH.keys()
    for key, sentence in ENGLISH.items():
        assert type(there[key]) is type(sentence), key
        for english, other in zip(forms(sentence), forms(there[key]), strict=True):
            assert other.strip()
            assert fields(english) == fields(other), key


@pytest.mark.parametrize(
    ("message", "english", "german"),
    [
        (lambda: said("no_fair_surface"), "No fair surface was found", "Keine glatte Fläche gefunden"),
        (lambda: said("kink", n=2, degrees=31.2), "A kink shows at 2 vertices of the boundary, of 31° at worst",
         "Ein Knick zeigt sich am Rand, an 2 Vertices, höchstens 31°"),
        (lambda: said("kink", n=1, degrees=31.2), "A kink shows at 1 vertex of the boundary, of 31° at worst",
         "Ein Knick zeigt sich am Rand, an 1 Vertex, höchstens 31°"),
        (lambda: said("named", name="Cube", text=said("thin_tube", share=0.61)),
         "Cube: The tube narrows to 61% of its ends", "Cube: Die Röhre verengt sich auf 61% ihrer Enden"),
        (lambda: joined([said("runs_on", n=1), said("drawn", n=2)]),
         "1 runs on, 2 drawn", "1 läuft weiter, 2 gezeichnet"),
        (lambda: said("halted", reason=said("no_fair_surface")),
         "No fair surface was found: the solver stopped making progress. Grow or shrink the selection",
         "Keine glatte Fläche gefunden: Der Löser kam nicht mehr voran. Auswahl vergrößern oder verkleinern"),
        (lambda: said("holes_left", n=1, all=13, reason="?"), "1 of 13 holes stays open, and is selected. ?",
         "1 von 13 Löchern bleibt offen und ist ausgewählt. ?"),
    ],
)  # fmt: skip
def test_a_message_is_worded_in_english_and_anew(message: Any, english: str, german: str) -> None:
    assert message() == english
    assert worded(message(), sentences_of("de")) == german


@pytest.mark.parametrize("language", ["en", *LANGUAGES])
def test_no_key_has_two_sentences(language: str) -> None:
    """JSON keeps the last one without a word."""
    text = (ADDON / "words" / f"{language}.json").read_text(encoding="utf-8")
    keys = [key for key, _ in json.loads(text, object_pairs_hook=list)]
    assert len(keys) == len(set(keys))


def test_where_a_language_has_no_sentence_english_is_shown() -> None:
    inner = said("kink", n=2, degrees=31.0)
    assert worded(said("named", name="Cube", text=inner), {"named": "<{name}> {text}"}) == f"<Cube> {inner}"


def test_an_exception_keeps_its_message() -> None:
    assert isinstance(str(ValueError(said("no_fair_surface"))), Message)


def test_every_code_has_words() -> None:
    assert {key.partition(".")[0] for key in ENGLISH if key.partition(".")[0].isupper()} - {
        "GOOD",
        "LOOK",
        "UNUSABLE",
    } == set(fairing.results.CODES)


@pytest.mark.parametrize("code", fairing.results.CODES)
def test_the_last_case_of_a_code_holds_without_any_figure_but_those_it_names(code: str) -> None:
    """So that a case of the engine's that is new here still reads as a sentence."""
    assert case_of(code, {}) == code
    named = {field for form in forms(ENGLISH[code]) for field in fields(form)}
    figures = dict.fromkeys(named - {"n", "first", "ends", "islands"}, 1.0)
    (text,) = reported(diagnostic(code, [0, 1], **figures))
    assert text[0].isupper() or text[0].isdigit()
    assert code not in text and "{" not in text and "triangle" not in text


@pytest.mark.parametrize(
    ("given", "text"),
    [
        (diagnostic("FLIPPED_TRIANGLES", [0, 2, 3], "triangle", triangles=3.0),
         "2 faces of the result are turned over"),
        (diagnostic("FOLDED", [0, 1], "triangle", turned_over=2.0, free_vertices=8.0),
         "The surface was found, but 1 face folds over on this mesh: try Remesh"),
        (diagnostic("NO_SOLUTION", [0, 1, 2], free_vertices=3.0, harmonic=1.0),
         "No harmonic surface fits the boundary: Least Variation was used"),
        (diagnostic("NO_SOLUTION", [0, 2], free_vertices=3.0, harmonic=1.0, loft=1.0, kinks=2.0),
         "No fair surface fits these boundary loops: a loft joins them, with a kink at 2 vertices"),
        (diagnostic("NO_SOLUTION", [0, 1, 2], free_vertices=3.0, harmonic=1.0, loft=1.0),
         "No fair surface fits these boundary loops: a loft joins them"),
        (diagnostic("OUTLINE_KEPT", [0, 2], vertices=2.0, worse=1.0),
         "Smooth Boundary was left out: with 2 boundary vertices moved, the result is worse"),
        (diagnostic("OUTLINE_KEPT", [0, 2], vertices=2.0), "Smooth Boundary can't move 2 vertices without folds"),
        # Ends of hard edges are counted as `ends`, which in sentences are those of an edge.
        (diagnostic("EDGES_LEFT_ALONE", [1, 3], ends=2.0, ambiguous=1.0),
         "2 hard edges end at the hole, at vertex 20 and others, and may be joined in several ways: draw edges (select "
         "two vertices, F) where they are to run"),
    ],
)  # fmt: skip
def test_triangles_are_counted_by_their_faces_and_cases_told_by_their_figures(given: Any, text: str) -> None:
    assert reported(given) == (text,)


@pytest.mark.parametrize("kind", ["vertex", "triangle"])
def test_elements_of_a_mesh_made_on_the_way_are_counted_and_not_looked_up(kind: str) -> None:
    """A coarser mesh that was solved for another one has vertices and triangles of its own."""
    ends = np.array([0, 1, 10_000], dtype=np.int32)
    finding = found(fairing.Diagnostic("SELF_INTERSECTION", "", ends, kind), ORIGIN)
    assert finding.gone == 1
    assert finding.count == 1 + len(finding.faces if kind == "triangle" else finding.vertices)


def test_edges_have_the_meshs_vertices() -> None:
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
    assert isinstance(str(refused.value), Message)
    assert refused.value.elements.tolist() == [20, 30, 60]


def test_a_surface_with_folds_is_reported_once() -> None:
    """The engine gives two codes for it, for those who ask for either."""
    assert reported(
        diagnostic("NOT_CONVERGED", [0], free_vertices=8.0, folds=2.0),
        diagnostic("FOLDED", [0, 1], "triangle", turned_over=2.0, free_vertices=8.0),
    ) == ("The surface was found, but 1 face folds over on this mesh: try Remesh",)


@pytest.mark.parametrize("even", [True, False])
def test_a_patch_knows_the_faces_of_its_triangles(even: bool) -> None:
    """Each triangle's corners are corners of its face, and each face of the patch has its area."""
    mesh = grid(6, 0.7)
    patch = make_patch(mesh, even)
    corners = mesh.corner_vertices.reshape(-1, 4)
    assert np.array_equal(np.unique(patch.faces), np.flatnonzero(mesh.in_patch))
    for triangle, face in zip(patch.vertices[patch.triangles], patch.faces, strict=True):
        assert set(triangle) < set(corners[face])
