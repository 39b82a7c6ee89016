"""Options by name: what is refused, what has no effect, and what the engine gets."""

from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import pytest
from addon.options.items import DISTRIBUTIONS, SHAPES
from addon.options.options import FairOptions
from addon.options.other_options import HOLES, CurvesOptions, DenoiseOptions, FilletOptions, FillOptions
from addon.options.presets import PRESETS
from addon.options.table import FOLDED, GROUPS, table

import fairing
from fairing import _core

ALL = (FairOptions, FillOptions, FilletOptions, DenoiseOptions, CurvesOptions)


@pytest.mark.parametrize("of", ALL)
def test_every_option_is_described_whole_and_accepts_its_default(of: Any) -> None:
    assert [option.name for option in table(of)] == [field.name for field in fields(of)]
    for option in table(of):
        assert option.group in (*GROUPS, *FOLDED, HOLES)
        assert option.label and option.description and not option.description.endswith(".")
        option.check(option.default)
        assert not option.is_set(of())
    assert of().idle == ()


@pytest.mark.parametrize(
    "wrong",
    [
        {"shape": "harmonic"},
        {"inner_fairness": ""},
        {"boundary_normals": "NONE"},
        {"pin_edges": "ALL"},
        {"factor": 1.0001},
        {"factor": -0.1},
        {"factor": float("nan")},
        {"bulge": float("inf")},
        {"spacing": 0.0},
        {"falloff": -1.0},
    ],
)
def test_a_value_that_is_not_accepted_is_refused_by_its_name(wrong: dict[str, Any]) -> None:
    (name,) = wrong
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        FairOptions(**wrong)


@pytest.mark.parametrize(
    ("of", "wrong", "says"),
    [
        (FairOptions, {"factor": "1"}, "factor: expected a number, got '1'"),
        (FairOptions, {"factor": None}, "factor: expected a number"),
        (FillOptions, {"longest": 2.5}, "longest: expected a whole number"),
        (FairOptions, {"quads": "yes"}, "quads: expected True or False"),
        (FairOptions, {"pin_group": 3}, "pin_group: expected a text"),
    ],
)
def test_a_value_of_another_kind_is_refused_by_its_name(of: Any, wrong: dict[str, Any], says: str) -> None:
    with pytest.raises(TypeError, match=says):
        of(**wrong)


@pytest.mark.parametrize("options", [FairOptions, FillOptions])
def test_a_property_that_does_not_exist_is_named(options: Any) -> None:
    with pytest.raises(TypeError, match=r"There is no property 'spacings': did you mean 'spacing'\?"):
        options.named({"spacings": 1.0})
    with pytest.raises(TypeError, match=r"'nonsense': there are .*shape"):
        options.named({"nonsense": 1})
    assert options.named({"spacing": 2.0}).allow_folds is False


@pytest.mark.parametrize(
    ("given", "beside"),
    [
        ({"quads": True}, {"remesh": True}),
        ({"spacing": 2.0}, {"remesh": True}),
        ({"pin_radius": 0.2}, {"pin_group": "Pins"}),
        ({"continuity_group": "Rim"}, {"continuity": "G2"}),
        ({"continuity_group": "Rim"}, {"continuity": "G0"}),
    ],
)
def test_what_nothing_looks_at_takes_its_default_and_is_named(given: dict[str, Any], beside: dict[str, Any]) -> None:
    assert FairOptions(**given).idle == tuple(given)
    assert FairOptions(**given) == FairOptions()
    assert FairOptions(**given, **beside).idle == ()
    assert asdict(FairOptions(**given, **beside)) == asdict(FairOptions()) | given | beside


@pytest.mark.parametrize(
    ("stays", "idle"),
    [
        ({"continuity": "G0"}, {"shape": "LEAST_VARIATION"}),
        ({"continuity": "G0"}, {"bulge": 0.1}),
        ({"continuity": "G0"}, {"boundary_normals": "CUSTOM"}),
        ({"continuity": "G0"}, {"remesh": True}),
        ({"continuity": "G0"}, {"fallback": False}),
        ({"shape": "MINIMAL_ENERGY"}, {"bulge": 0.1}),
        ({"shape": "MINIMAL_ENERGY"}, {"continuity": "G2"}),
        ({"shape": "LEAST_VARIATION"}, {"fallback": False}),
        ({"continuity": "G2"}, {"bulge": 0.1}),
        ({"continuity": "G2"}, {"falloff": 0.1}),
        ({"continuity": "G2", "continuity_group": "Rim"}, {"vertex_group": "Fade"}),
        ({"continuity": "G0", "continuity_group": "Rim"}, {"smooth_boundary": True}),
        ({"remesh": True}, {"detail": 0.5}),
        ({"remesh": True}, {"falloff": 0.1}),
        ({"remesh": True}, {"use_mask": True}),
        ({"remesh": True}, {"smooth_boundary": True}),
        ({"remesh": True}, {"all_keys": True}),
        ({"remesh": True}, {"fair_open_borders": True}),
        ({"remesh": True}, {"inner_fairness": "UNIFORM"}),
        ({"falloff": 0.1}, {"smooth_boundary": True}),
        ({"pin_edges": "NONE"}, {"pin_slope": "SMOOTH"}),
        ({"pin_edges": "SEAM"}, {"fair_pinned_edges": False}),
    ],
)
def test_of_two_that_exclude_each_other_the_first_counts(stays: dict[str, Any], idle: dict[str, Any]) -> None:
    both = FairOptions(**stays, **idle)
    assert both.idle == tuple(idle)
    assert both == FairOptions(**stays)
    assert FairOptions(**stays).idle == ()


def test_every_argument_for_the_engine_is_one_that_it_knows() -> None:
    given = FairOptions().resolved(False).engine_arguments()
    fairing.Options.of(**given)
    groups = vars(fairing.Options()).values()
    defaults = {name: value for group in groups for name, value in vars(group).items()}
    defaults["inner_fairness"] = "uniform"  # which None is for fair
    assert given == {name: defaults[name] for name in given} | {"equation": "automatic"}


def test_the_words_are_the_engines() -> None:
    """Every equation and distribution of the engine's can be chosen."""
    chosen = [FairOptions(shape=shape).equation for shape, _, _ in SHAPES]
    chosen += [FairOptions(bulge=0.1).equation, FairOptions(continuity="G0").equation]
    assert sorted(chosen) == sorted(_core.WORDS["equation"])
    assert tuple(name.lower() for name, _, _ in DISTRIBUTIONS[1:]) == _core.WORDS["inner_fairness"]
    words = {FairOptions(fallback=on).engine_arguments()["otherwise"] for on in (True, False)}
    assert words == {*_core.WORDS["otherwise"]}


@pytest.mark.parametrize(("textured", "stands_for"), [(True, "CONFORMAL"), (False, "UNIFORM")])
def test_automatic_keeps_a_texture(textured: bool, stands_for: str) -> None:
    assert FairOptions().resolved(textured).inner_fairness == stands_for
    assert FairOptions(inner_fairness="INVERSE_DISTANCE").resolved(textured).inner_fairness == "INVERSE_DISTANCE"


@pytest.mark.parametrize("kind", [FairOptions, FillOptions])
def test_only_the_harmonic_shape_continues_the_curvature(kind: Any) -> None:
    joined = {shape: kind(shape=shape, continuity="G2").joins_curvature for shape, _, _ in SHAPES}
    assert joined == {shape: shape in ("AUTOMATIC", "HARMONIC") for shape, _, _ in SHAPES}


def test_every_preset_sets_what_counts() -> None:
    for of, presets in PRESETS.values():
        for options in presets.values():
            assert of.named(options).idle == ()


def test_every_option_of_fair_region_has_a_job_in_the_guide() -> None:
    guide = " ".join((Path(__file__).parents[2] / "docs/user_guide.md").read_text(encoding="utf-8").split())
    assert [option.label for option in table(FairOptions) if f"*{option.label}" not in guide] == []
