"""Options in groups: what they hold, fields of them by name, and what is refused."""

import dataclasses
from typing import Any

import pytest

import fairing
from shapes import FAMILIES, Style


def patch() -> tuple[Any, Any, fairing.Boundary]:
    made = FAMILIES["hemisphere"](80, Style())
    return made.vertices, made.triangles, fairing.Boundary(made.fixed, made.fixed_normals)


def test_groups_and_keywords_give_the_same_bits() -> None:
    vertices, triangles, boundary = patch()
    options = fairing.Options(
        fairing.Surface("constant", bulge=0.03),
        fairing.Layout("conformal"),
        curves=fairing.Curves(pin_radius=0.2),
        solving=fairing.Solving(tolerance=1e-3, max_iterations=50),
    )
    grouped = fairing.fair(vertices, triangles, boundary, options)
    by_name = fairing.fair(
        vertices, triangles, fixed=boundary.vertices, fixed_normals=boundary.normals, equation="constant",
        bulge=0.03, inner_fairness="conformal", pin_radius=0.2, tolerance=1e-3, max_iterations=50,
    )  # fmt: skip
    assert grouped.vertices.tobytes() == by_name.vertices.tobytes()
    flat = fairing.Options.of(
        equation="constant", bulge=0.03, inner_fairness="conformal", pin_radius=0.2, tolerance=1e-3, max_iterations=50
    )
    assert flat.chosen == options.chosen
    assert fairing.fair(vertices, triangles, boundary, flat).vertices.tobytes() == grouped.vertices.tobytes()
    # Each of the groups counts.
    for name in ("surface", "layout", "solving"):
        without = dataclasses.replace(options, **{name: getattr(fairing.Options(), name)})
        assert fairing.fair(vertices, triangles, boundary, without).vertices.tobytes() != grouped.vertices.tobytes()


def test_defaults_are_those_that_callers_rely_on() -> None:
    expected = {
        "equation": "harmonic", "otherwise": "least_variation", "load": 0.0, "bulge": 0.0, "continuity": "G1",
        "outline": "given", "neighbours": None, "reference": None, "detail": 0.0, "detail_size": 0.0, "feather": 0.0,
        "weights": None, "creases": None, "smooth_curves": None, "open_border": "held", "pin_radius": 0.1,
        "method": "global", "levels": 0, "tolerance": 1e-6, "max_iterations": 200, "normals": "fitted",
        "start": "outline", "paper": None, "inner_fairness": None,
    }  # fmt: skip
    found = {name: value for group in vars(fairing.Options()).values() for name, value in vars(group).items()}
    assert found == expected
    assert fairing.Options().chosen == {}


def test_options_are_frozen_and_change_by_name() -> None:
    options = fairing.Options()
    with pytest.raises(dataclasses.FrozenInstanceError):
        options.surface = fairing.Surface()  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError):
        options.surface.load = 1.0  # type: ignore[misc]
    changed = options.changed(load=1.0, detail=0.5)
    assert (changed.surface.load, changed.skin.detail, options.surface.load) == (1.0, 0.5, 0.0)
    assert changed.chosen == {"load": 1.0, "detail": 0.5}


@pytest.mark.parametrize("call", [fairing.fair, fairing.fill, fairing.remesh])
def test_an_option_that_does_not_exist_is_refused(call: Any) -> None:
    vertices, triangles, _ = patch()
    with pytest.raises(TypeError, match="'equations' is no option; there are equation, "):
        call(vertices, triangles, equations="soap_film")
    with pytest.raises(TypeError, match="'equations' is no option; there are equation, "):
        fairing.Options.of(equations="soap_film")


def test_a_group_that_is_something_else_is_refused_by_name() -> None:
    vertices, triangles, boundary = patch()
    with pytest.raises(ValueError, match=r"options: a fairing.Options is needed"):
        fairing.fair(vertices, triangles, boundary, {"equation": "soap_film"})  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"options: surface has to be a fairing.Surface, not 'soap_film'"):
        fairing.fair(vertices, triangles, boundary, fairing.Options("soap_film"))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="equation: 'flat' is not accepted"):
        fairing.fair(vertices, triangles, boundary, fairing.Options(fairing.Surface("flat")))
