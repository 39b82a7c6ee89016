"""The ways to a live region's surface: which are tried, in which order, and what ends them."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from addon.live.region import first, sought

import fairing

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


def test_a_search_that_was_stopped_tries_no_other_way() -> None:
    tried: list[str] = []
    go_on = iter([True, False])
    assert sought(region("stand_in", tried), NOWHERE, NOWHERE, lambda *_: next(go_on)).positions is None
    assert tried == ["answer"]


def test_a_new_region_without_any_surface_is_refused() -> None:
    with pytest.raises(fairing.SolverError, match="No fair surface was found for the region"):
        first(region("", []), NOWHERE, NOWHERE, lambda *_: True)


@pytest.mark.parametrize("kind", [fairing.Cancelled, ValueError])
def test_who_cancels_or_gives_bad_input_gets_no_other_surface(kind: type[Exception]) -> None:
    tried: list[str] = []
    with pytest.raises(kind):
        first(region("stand_in", tried, kind), NOWHERE, NOWHERE, lambda *_: True)
    assert tried == ["answer"]
