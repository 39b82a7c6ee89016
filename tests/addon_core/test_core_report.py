"""A run as a verdict and figures, each met, missed or reported, by made-up outcomes."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from addon.arrays.types import Ints
from addon.fair.solve import solve
from addon.options.options import FairOptions
from addon.verdict.outcome import Fairing, outcome
from addon.verdict.quality import Join, Quality
from addon.verdict.report import MET, MISSED, TOLD, Report, make_report, summary
from addon.verdict.verdict import GOOD, LOOK, UNUSABLE, Verdict

from polygon_mesh import grid, on_sphere


@pytest.fixture(scope="module")
def sphere() -> Fairing:
    mesh = grid(12, 0.6, on_sphere)
    return outcome(mesh, np.eye(4), FairOptions(), solve(mesh, np.eye(4), FairOptions()))


def states(report: Report) -> dict[str, str]:
    return {check.name: check.state for check in report.checks}


def values(report: Report) -> dict[str, str]:
    return {check.name: check.value for check in report.checks}


def report(*outcomes: Fairing, **options: Any) -> Report:
    return make_report([(f"Object {k}", o) for k, o in enumerate(outcomes)], FairOptions(**options), 1.5)


def quality(crossing: Ints | None) -> Quality:
    nothing = np.empty(0, dtype=np.int64)
    return Quality(nothing, crossing)


BAD = Verdict(UNUSABLE, "2 faces of the result are folded over", np.array([3, 4]), ("WRITE",))


def test_a_sphere_meets_all(sphere: Fairing) -> None:
    found = report(sphere)
    assert set(states(found).values()) == {MET, TOLD}
    assert (found.verdict.grade, found.verdict.reason, found.written) == (GOOD, "", True)
    assert summary(found) == f"Good: faired {len(sphere.vertices)} vertices in 1.50 s"


def test_of_several_objects_the_worst_counts(sphere: Fairing) -> None:
    lost = replace(sphere.result, converged=False, termination="stalled", residual=0.5)
    wide = replace(sphere.result, boundary_angle=np.array([3.0]))
    seen = Join(np.array([0, 1, 2]), np.array([1.0, 4.0, 30.0]), np.array([2]))
    both = report(replace(sphere, result=lost, verdict=BAD), replace(sphere, result=wide, join=seen))
    assert (both.converged, both.residual, both.boundary_angle) == (False, 0.5, 3.0)
    assert both.free_vertices == 2 * len(sphere.vertices)
    assert both.join == (4.0, 30.0)
    assert values(both)["Kink at the boundary"] == "≤ 30°"
    assert values(both)["Kink limit"] == "12°"
    assert values(report(replace(sphere, join=replace(seen, limit=25.0))))["Kink limit"] == "25°"
    assert states(both)["Kink at the boundary"] == MISSED
    alone = report(replace(sphere, join=replace(seen, kinks=np.empty(0, dtype=np.int64))))
    assert (values(alone)["Kink at the boundary"], states(alone)["Kink at the boundary"]) == ("≤ 30°, few", MET)
    assert values(both)["Surface found"] == "no further progress, yes"
    assert (both.verdict.grade, both.verdict.reason) == (UNUSABLE, f"Object 0: {BAD.reason}")
    assert both.verdict.spots.tolist() == [3, 4]


def test_what_is_not_usable_is_not_written_unless_all_is_accepted(sphere: Fairing) -> None:
    bad = replace(sphere, verdict=BAD)
    assert not report(bad).written
    assert not report(sphere, bad).written  # all of the objects or none
    assert report(bad, allow_folds=True).written
    assert summary(report(bad)) == f"Not usable: {BAD.reason}. Nothing was changed"
    look = replace(sphere, verdict=Verdict(LOOK, "A kink shows"))
    assert report(look).written
    assert summary(report(look)).endswith("s. A kink shows")
    assert summary(report(look)).startswith("Look here: faired ")


@pytest.mark.parametrize(
    ("before", "after", "value", "state"),
    [
        ([1, 2], [], "2 → 0", MET),
        ([1, 2], [2], "2 → 1", TOLD),  # some of the old ones are left: no green
        ([1, 2], [3], "2 → 1", MISSED),  # another one, though they are fewer
        (None, [], "0", MET),
    ],
)
def test_counts_must_not_grow(
    sphere: Fairing, before: list[int] | None, after: list[int], value: str, state: str
) -> None:
    then = None if before is None else np.array(before)
    found = report(replace(sphere, before=quality(then), after=quality(np.array(after, dtype=np.int64))))
    assert (values(found)["Faces that cross"], states(found)["Faces that cross"]) == (value, state)


@pytest.mark.parametrize("options", [{"continuity": "G0"}, {"factor": 0.5}])
def test_a_soap_film_and_a_blend_promise_no_smooth_join(sphere: Fairing, options: dict[str, Any]) -> None:
    assert "Kink at the boundary" not in states(report(sphere, **options))


def test_warnings_name_their_object_where_there_are_several(sphere: Fairing) -> None:
    odd = replace(sphere, warnings=("odd",))
    assert report(odd).warnings == ("odd",)
    assert report(odd, sphere).warnings == ("Object 0: odd",)


@pytest.mark.parametrize(("converged", "bulge", "found"), [(False, 2.0, True), (True, 2.0, False), (False, 0.0, False)])
def test_a_bulge_that_is_not_found_is_explained(sphere: Fairing, converged: bool, bulge: float, found: bool) -> None:
    lost = replace(sphere, warnings=(), result=replace(sphere.result, converged=converged))
    notes = report(lost, bulge=bulge).warnings
    assert ["no surface with a bulge of 2" in note for note in notes] == [True] * found
