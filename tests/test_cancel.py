"""The contract of `progress`: fractions, cancelling, exceptions; inputs stay intact."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pytest

import fairing
import hard_inputs
import shapes

PATCH = shapes.catenoid(500)
START = shapes.start_from_nothing(PATCH)


def run(progress: Callable[[float, str], bool | None] | None) -> fairing.FairResult:
    start, triangles = START.copy(), PATCH.triangles.copy()
    try:
        return fairing.fair(
            start, triangles, fixed=PATCH.fixed, fixed_normals=PATCH.fixed_normals,
            tolerance=1e-10, progress=progress,
        )  # fmt: skip
    finally:
        assert np.array_equal(start, START)
        assert np.array_equal(triangles, PATCH.triangles)


def recorded() -> list[tuple[float, str]]:
    calls: list[tuple[float, str]] = []
    run(lambda fraction, stage: calls.append((fraction, stage)))
    return calls


def test_fractions_rise_from_zero_to_one_and_stages_have_names() -> None:
    calls = recorded()
    fractions = np.array([fraction for fraction, _ in calls])
    assert len(calls) >= 5
    assert fractions.min() >= 0
    assert fractions.max() <= 1
    assert (np.diff(fractions) >= 0).all()
    assert all(isinstance(stage, str) and stage for _, stage in calls)


def test_result_does_not_depend_on_the_callback() -> None:
    assert np.array_equal(run(None).vertices, run(lambda fraction, stage: True).vertices)
    assert np.array_equal(run(None).vertices, run(lambda fraction, stage: None).vertices)


def test_cancelled_is_not_a_value_error() -> None:
    assert issubclass(fairing.Cancelled, Exception)
    assert not issubclass(fairing.Cancelled, ValueError)


def longest_stretch(item: hard_inputs.Input, kind: str) -> float:
    """Without a question, in seconds of the caller's own processor time; with one thread nobody else works."""
    when = [time.thread_time()]
    item.fair(inner_fairness=kind, threads=1, progress=lambda fraction, stage: when.append(time.thread_time()))
    when.append(time.thread_time())
    return float(np.diff(when).max())


@pytest.mark.slow
@pytest.mark.parametrize("kind", hard_inputs.KINDS)
def test_questions_come_often_in_a_large_patch(kind: str) -> None:
    assert longest_stretch(hard_inputs.of_patch(shapes.cap(100_000)), kind) < 0.3
