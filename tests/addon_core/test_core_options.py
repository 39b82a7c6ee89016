"""Options by name: what is refused, and what the engine gets."""

from __future__ import annotations

import inspect
from dataclasses import fields
from types import SimpleNamespace
from typing import Any

import pytest

import fairing
from core.options import FairOptions, option_names


@pytest.mark.parametrize(
    "wrong",
    [
        {"equation": "harmonic"},
        {"inner_fairness": ""},
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


def test_every_argument_for_the_engine_is_one_that_it_knows() -> None:
    known = inspect.signature(fairing.fair).parameters
    given = FairOptions().engine_arguments()
    assert set(given) <= set(known)
    assert given["equation"] == "harmonic"
    assert FairOptions(tolerance=1e-3, levels=4).engine_arguments()["tolerance"] == 1e-3
    assert FairOptions(levels=4).engine_arguments()["levels"] == 4


def test_options_are_read_from_any_object_by_name() -> None:
    values = {field.name: field.default for field in fields(FairOptions)} | {"bulge": 0.5, "factor": 0.25}
    assert FairOptions.of(SimpleNamespace(**values)) == FairOptions(bulge=0.5, factor=0.25)
    assert option_names() == tuple(values)
