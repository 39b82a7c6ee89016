"""Nothing breaks the engine: random patches, motions, numberings and damage.

The law, which `hard_inputs.Input.fair` and `obeys` check: no crash, no NaN, everything fixed or outside keeps its
bits, so do the arrays given; a refusal names its elements; the result says whether it converged. `--thorough`
tries ten times as many examples, other ones each time.
"""

from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import fairing
import random_inputs
from hard_inputs import WAYS, Input
from solving import codes

ways = st.sampled_from(WAYS)


def obeys(item: Input, **options: Any) -> fairing.FairResult | None:
    """The result, honest about itself; or None after a refusal that names what is wrong."""
    try:
        result = item.fair(**options)
    except fairing.MeshError as error:
        assert error.elements.size or error.code == "NO_FREE_VERTICES"
        assert str(error)
        return None
    assert result.converged == (result.termination == "converged")
    assert result.converged != ("NOT_CONVERGED" in codes(result))
    assert np.isfinite(result.mean_curvature).all()
    assert np.isfinite(result.boundary_angle).all()
    assert not np.isnan(result.residual)
    return result


@given(random_inputs.patches(), ways)
def test_random_patches_are_solved(item: Input, way: tuple[str, str]) -> None:
    assert obeys(item, method=way[0], inner_fairness=way[1]) is not None


@given(random_inputs.damaged(), ways)
def test_damaged_patches_are_solved_or_refused(item: Input, way: tuple[str, str]) -> None:
    obeys(item, method=way[0], inner_fairness=way[1])


@given(random_inputs.damaged(), ways, st.integers(0, 60), st.booleans())
def test_damaged_patches_may_be_interrupted(item: Input, way: tuple[str, str], after: int, raises: bool) -> None:
    class MineError(Exception):
        pass

    left = iter(range(after))

    def stop(fraction: float, stage: str) -> bool:
        assert 0.0 <= fraction <= 1.0
        if raises and next(left, None) is None:
            raise MineError(stage)
        return raises or next(left, None) is not None

    try:
        obeys(item, method=way[0], inner_fairness=way[1], progress=stop)
    except (MineError, fairing.Cancelled) as error:
        assert isinstance(error, MineError) == raises
