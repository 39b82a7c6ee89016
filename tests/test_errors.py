"""What is refused, with which code and elements; what is solved with a warning."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import bad_inputs
import fairing
import shapes
from bad_inputs import Case

PATCH = shapes.cap(200)


def run(case: Case) -> fairing.FairResult:
    """Fair, and see that the arrays passed in keep their bits."""
    vertices, triangles = case.vertices.copy(), case.triangles.copy()
    try:
        return fairing.fair(vertices, triangles, **case.options)
    finally:
        assert np.array_equal(vertices, case.vertices, equal_nan=True)
        assert np.array_equal(triangles, case.triangles)


def fair(**options: Any) -> fairing.FairResult:
    settings: dict[str, Any] = {
        "vertices": PATCH.vertices, "triangles": PATCH.triangles, "fixed": PATCH.fixed,
        "fixed_normals": PATCH.fixed_normals,
    }  # fmt: skip
    settings.update(options)
    return fairing.fair(settings.pop("vertices"), settings.pop("triangles"), **settings)


@pytest.mark.parametrize("name", bad_inputs.CASES)
def test_refused_meshes(name: str) -> None:
    case = bad_inputs.CASES[name]()
    with pytest.raises(fairing.MeshError) as caught:
        run(case)
    assert caught.value.code == case.code
    assert isinstance(caught.value, ValueError)
    assert str(caught.value)
    assert case.elements is None or set(case.elements) <= set(np.ravel(caught.value.elements))


@pytest.mark.parametrize("name", bad_inputs.WARNINGS)
def test_meshes_solved_with_a_warning(name: str) -> None:
    case = bad_inputs.WARNINGS[name]()
    result = run(case)
    assert np.isfinite(result.vertices).all()
    found = [warning for warning in result.warnings if warning.code == case.code]
    assert len(found) == 1
    assert case.elements is None or set(case.elements) <= set(np.ravel(found[0].elements))


def test_one_turned_triangle_changes_nothing() -> None:
    case = bad_inputs.folded_winding()
    clean = shapes.cap(60)
    control = fairing.fair(clean.vertices, clean.triangles, **case.options)
    assert np.abs(run(case).vertices - control.vertices).max() < 1e-9


def test_a_closed_component_is_left_alone() -> None:
    case = bad_inputs.island_without_border()
    result = run(case)
    sphere = np.arange(83, len(case.vertices))
    assert np.array_equal(result.vertices[sphere], case.vertices[sphere])
    assert not np.array_equal(result.vertices, case.vertices)


def test_vertices_without_triangles_may_be_anything() -> None:
    loose = np.vstack([PATCH.vertices, [[np.nan, np.inf, 0.0]]])
    result = fair(vertices=loose)
    assert np.array_equal(result.vertices[-1], loose[-1], equal_nan=True)
    assert np.isfinite(result.vertices[:-1]).all()


@pytest.mark.parametrize(
    ("option", "value", "accepted"),
    [
        ("method", "fast", ["global", "paper"]),
        ("equation", "biharmonic", ["harmonic", "constant", "minimal_energy", "soap_film"]),
        ("inner_fairness", "smooth", ["uniform", "conformal", "inverse_distance", "shape_preserving"]),
        ("normals", "smooth", ["fitted", "averaged"]),
        ("levels", 2, ["0", "1"]),
        ("levels", -1, ["0", "1"]),
    ],
)
def test_unknown_and_later_options_list_what_is_accepted(option: str, value: Any, accepted: list[str]) -> None:
    with pytest.raises(ValueError, match=option) as caught:
        fair(**{option: value})
    assert all(word in str(caught.value) for word in accepted)


def test_normals_without_their_vertices_are_refused() -> None:
    with pytest.raises(ValueError, match="fixed_normals"):
        fair(fixed=None)


def test_empty_arrays_are_refused() -> None:
    with pytest.raises(ValueError):
        fairing.fair(np.zeros((0, 3)), np.zeros((0, 3), dtype=int))


def test_border_vertices_left_out_of_fixed_are_added_with_a_warning() -> None:
    part = PATCH.fixed[3:]
    result = fair(fixed=part, fixed_normals=PATCH.normals[part])
    assert np.array_equal(result.fixed[: len(part)], part)
    assert set(result.fixed) == set(PATCH.fixed)
    warning = next(w for w in result.warnings if w.code == "OPEN_BORDER_IN_SELECTION")
    assert set(np.ravel(warning.elements)) == set(PATCH.fixed[:3])
