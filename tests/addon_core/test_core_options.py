"""Options by name: what is refused, and what the engine gets."""

from __future__ import annotations

from typing import Any

import pytest

import fairing
from core.fill_options import FILL_EQUATIONS as SHAPES
from core.fill_pieces import FillOptions
from core.option_items import DISTRIBUTIONS, EQUATIONS, METHODS, OTHERWISE, identifiers
from core.options import FairOptions
from fairing import _core


@pytest.mark.parametrize(
    "wrong",
    [
        {"equation": "harmonic"},
        {"inner_fairness": ""},
        {"otherwise": "HARMONIC"},
        {"boundary_normals": "NONE"},
        {"method": "BOTH"},
        {"pin_edges": "ALL"},
        {"factor": 1.0001},
        {"factor": -0.1},
        {"factor": float("nan")},
    ],
)
def test_an_unknown_value_is_refused_by_its_name(wrong: dict[str, Any]) -> None:
    (name,) = wrong
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        FairOptions(**wrong)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"factor": "1"}, "factor: expected a number, got '1'"),
        ({"factor": None}, "factor: expected a number"),
        ({"max_iterations": 2.5}, "max_iterations: expected a whole number"),
        ({"quads": "yes"}, "quads: expected True or False"),
        ({"pin_group": 3}, "pin_group: expected a text"),
    ],
)
def test_a_value_of_another_kind_is_refused_by_its_name(wrong: dict[str, Any], says: str) -> None:
    with pytest.raises(TypeError, match=says):
        FairOptions(**wrong)


@pytest.mark.parametrize("options", [FairOptions, FillOptions])
def test_a_property_that_does_not_exist_is_named(options: Any) -> None:
    with pytest.raises(TypeError, match=r"There is no property 'spacings': did you mean 'spacing'\?"):
        options.named({"spacings": 1.0})
    with pytest.raises(TypeError, match=r"'nonsense': there are .*shape"):
        options.named({"nonsense": 1})
    assert options.named({"spacing": 2.0}).spacing == 2.0


@pytest.mark.parametrize(
    ("given", "beside"),
    [
        ({"quads": True}, {"mesh": "NEW"}),
        ({"spacing": 2.0}, {"mesh": "NEW"}),
        ({"inner": "EVEN"}, {"mesh": "NEW"}),
        ({"bulge": 0.1}, {"equation": "CONSTANT"}),
        ({"levels": 1}, {"method": "PAPER"}),
        ({"detail_size": 0.1}, {"detail": 0.5}),
    ],
)
def test_what_nothing_looks_at_is_reported(given: dict[str, Any], beside: dict[str, Any]) -> None:
    assert FairOptions(**given).idle == tuple(given)
    assert FairOptions(**given, **beside).idle == ()
    assert FairOptions(**beside).idle == ()


def test_what_belongs_to_pinned_edges_is_idle_without_them() -> None:
    for given in ({"pin_slope": "SMOOTH"}, {"pin_curve": "HELD"}):
        assert FairOptions(**given).idle == ()
        assert FairOptions(**given, pin_edges="NONE").idle == tuple(given)
    assert FairOptions(pin_curve="HELD", pin_edges="SEAM").idle == ("pin_curve",)


def test_every_argument_for_the_engine_is_one_that_it_knows() -> None:
    given = FairOptions().resolved(False).engine_arguments()
    fairing.Options.of(**given)
    assert FairOptions(tolerance=1e-3, levels=4).engine_arguments()["tolerance"] == 1e-3
    assert FairOptions(levels=4).engine_arguments()["levels"] == 4


def test_the_words_are_the_engines() -> None:
    """Every word of the engine's can be chosen, in its order; what the add-on leaves out is its default.

    AUTOMATIC is the add-on's own and stands for one of them.
    """
    words = _core.WORDS
    for option, choices in (
        ("equation", (*EQUATIONS[1:], EQUATIONS[0])),  # the default comes first in Blender's menu
        ("otherwise", OTHERWISE[::-1]),  # of a checkbox: what stands for off comes first
        ("inner_fairness", identifiers(DISTRIBUTIONS)[1:]),
        ("method", METHODS),
    ):
        assert tuple(choice.lower() for choice in choices) == words[option]
    groups = vars(fairing.Options()).values()
    defaults = {name: value for group in groups for name, value in vars(group).items()}
    defaults["inner_fairness"] = "uniform"  # which None is for fair
    given = FairOptions().resolved(False).engine_arguments()
    assert given == {name: defaults[name] for name in given} | {"equation": "automatic"}


@pytest.mark.parametrize(("textured", "stands_for"), [(True, "CONFORMAL"), (False, "UNIFORM")])
def test_automatic_keeps_a_texture(textured: bool, stands_for: str) -> None:
    assert FairOptions().resolved(textured).inner_fairness == stands_for
    assert FairOptions(inner_fairness="INVERSE_DISTANCE").resolved(textured).inner_fairness == "INVERSE_DISTANCE"


def test_automatic_is_the_shape_that_nobody_chose_and_the_engine_decides() -> None:
    assert FairOptions().equation == FillOptions().equation == "AUTOMATIC"
    assert FairOptions().engine_arguments()["equation"] == "automatic"
    for kind in (FairOptions, FillOptions):
        joined = {shape: kind(equation=shape, continuity="G2").joins_curvature for shape in SHAPES}
        assert joined == {shape: shape in ("AUTOMATIC", "HARMONIC") for shape in SHAPES}
