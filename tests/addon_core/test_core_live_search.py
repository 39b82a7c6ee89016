"""The ways to a live region's surface: which are tried, in which order, and what ends them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import fairing
from core.live_search import first, sought

NOWHERE: Any = None


def region(solvable: str, tried: list[str], failing: type[Exception] | None = None) -> Any:
    """A region whose one way to a surface is named; the others give none, or fail."""

    def way(name: str) -> Any:
        def ask(*_arguments: Any) -> Any:
            tried.append(name)
            if name == solvable:
                return np.zeros((1, 3))
            if failing is not None:
                raise failing("no")
            return None

        return ask

    return SimpleNamespace(**{name: way(name) for name in ("answer", "afresh", "stand_in")})


@pytest.mark.parametrize("failing", [None, fairing.SolverError])
@pytest.mark.parametrize(("solvable", "asked"), [("answer", 1), ("afresh", 2), ("stand_in", 3), ("", 3)])
def test_another_surface_stands_in_only_where_none_is_found_afresh(solvable: str, asked: int, failing: Any) -> None:
    """After steps that were too long to follow, the last answer may be no start: the region is solved anew then."""
    tried: list[str] = []
    found = sought(region(solvable, tried, failing), NOWHERE, NOWHERE, lambda *_: True)
    assert (found.positions is None) == (not solvable)
    assert found.stands_in == (solvable == "stand_in")
    assert tried == ["answer", "afresh", "stand_in"][:asked]


def test_a_search_that_was_stopped_tries_no_other_way() -> None:
    tried: list[str] = []
    go_on = iter([True, False])
    assert sought(region("stand_in", tried), NOWHERE, NOWHERE, lambda *_: next(go_on)).positions is None
    assert tried == ["answer"]


@pytest.mark.parametrize("failing", [None, fairing.SolverError])
@pytest.mark.parametrize(("solvable", "asked"), [("answer", 1), ("stand_in", 2)])
def test_a_new_region_takes_the_even_surface_only_without_another(solvable: str, asked: int, failing: Any) -> None:
    tried: list[str] = []
    found = first(region(solvable, tried, failing), NOWHERE, NOWHERE, lambda *_: True)
    assert found.positions is not None
    assert found.stands_in == (solvable == "stand_in")
    assert tried == ["answer", "stand_in"][:asked]


def test_a_new_region_without_any_surface_is_refused() -> None:
    with pytest.raises(fairing.SolverError, match="No fair surface was found for the region"):
        first(region("", []), NOWHERE, NOWHERE, lambda *_: True)


@pytest.mark.parametrize("kind", [fairing.Cancelled, ValueError])
def test_who_cancels_or_gives_bad_input_gets_no_other_surface(kind: type[Exception]) -> None:
    tried: list[str] = []
    with pytest.raises(kind):
        first(region("stand_in", tried, kind), NOWHERE, NOWHERE, lambda *_: True)
    assert tried == ["answer"]
