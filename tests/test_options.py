"""Options in groups: what they hold, fields of them by name, and what is refused."""

from __future__ import annotations

import dataclasses
import inspect
from typing import Any

import numpy as np
import pytest

import fairing
from shapes import FAMILIES, Style

CALLS = (fairing.fair, fairing.fill, fairing.remesh, fairing.fillet)


def patch() -> tuple[Any, Any, fairing.Boundary]:
    made = FAMILIES["hemisphere"](80, Style())
    return made.vertices, made.triangles, fairing.Boundary(made.fixed, made.fixed_normals)


def without_a_vertex(triangles: Any, boundary: fairing.Boundary) -> Any:
    """The triangles that leave a hole at the free vertex with the most of them."""
    uses = np.bincount(triangles.ravel())
    uses[boundary.vertices] = 0
    return triangles[(triangles != uses.argmax()).all(axis=1)]


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


def test_fixed_vertices_alone_are_a_boundary() -> None:
    vertices, triangles, boundary = patch()
    film = fairing.Options(fairing.Surface("soap_film"))
    plain = fairing.fair(vertices, triangles, boundary.vertices, film)
    named = fairing.fair(vertices, triangles, fairing.Boundary(boundary.vertices), film)
    assert plain.vertices.tobytes() == named.vertices.tobytes()


def test_calls_that_make_vertices_share_the_groups() -> None:
    vertices, triangles, boundary = patch()
    film = fairing.Options(fairing.Surface("minimal_energy"))
    open_mesh = without_a_vertex(triangles, boundary)
    new = fairing.remesh(vertices, triangles, boundary, film, spacing=0.3)
    hole = fairing.fill(vertices, open_mesh, None, film)
    again = fairing.remesh(vertices, triangles, boundary, spacing=0.3, equation="minimal_energy")
    assert again.vertices.tobytes() == new.vertices.tobytes()
    same = fairing.fill(vertices, open_mesh, equation="minimal_energy")
    assert same.vertices.tobytes() == hole.vertices.tobytes()
    assert new.equation == hole.equation == "minimal_energy"


def test_a_fillet_takes_them_too() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    sides = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    loose = fairing.Options(solving=fairing.Solving(tolerance=1e-3))
    one = fairing.fillet(corners, sides, None, loose, width=0.1)
    other = fairing.fillet(corners, sides, width=0.1, tolerance=1e-3)
    assert one.vertices.tobytes() == other.vertices.tobytes()


@pytest.mark.parametrize("call", CALLS)
def test_signatures_are_short(call: Any) -> None:
    parameters = inspect.signature(call).parameters
    assert "options" in parameters
    assert len(inspect.signature(fairing.fair).parameters) == 8


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
