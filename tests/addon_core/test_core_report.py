"""A run as figures: each met, missed or told, by made-up outcomes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.options import FairOptions
from core.outcome import Fairing, outcome
from core.quality import Quality
from core.report import MET, MISSED, SMOOTH_ANGLE, TOLD, Report, angle_text, make_report, summary
from core.solve import solve
from polygon_mesh import grid, on_sphere


@pytest.fixture(scope="module")
def sphere() -> Fairing:
    mesh = grid(12, 0.6, on_sphere)
    return outcome(mesh, np.eye(4), 1.0, solve(mesh, np.eye(4), FairOptions()), lambda *_: 0)


def states(report: Report) -> dict[str, str]:
    return {check.name: check.state for check in report.checks}


def report(*outcomes: Fairing, **options: Any) -> Report:
    return make_report([(f"Object {k}", o) for k, o in enumerate(outcomes)], FairOptions(**options), 1.5)


def test_a_sphere_meets_all(sphere: Fairing) -> None:
    assert set(states(report(sphere)).values()) == {MET, TOLD}
    assert summary(report(sphere)).startswith(f"Faired {len(sphere.vertices)} vertices in 1.50 s, largest angle")


def test_of_several_objects_the_worst_counts(sphere: Fairing) -> None:
    lost = replace(sphere.result, converged=False, termination="stalled", residual=0.5)
    wide = replace(sphere.result, boundary_angle=np.array([3.0]))
    both = report(replace(sphere, result=lost), replace(sphere, result=wide))
    assert (both.converged, both.residual, both.boundary_angle) == (False, 0.5, 3.0)
    assert both.free_vertices == 2 * len(sphere.vertices)
    assert states(both)["Equation solved"] == MISSED
    assert states(both)["Angle at the outline"] == MISSED
    assert "no further progress, yes" in {check.value for check in both.checks}
    assert summary(both).startswith("Not converged: ")


def test_a_surface_with_folds_is_found_but_not_met(sphere: Fairing) -> None:
    folds = replace(sphere.result, converged=False, polished=False, termination="folded")
    (told, *_) = report(replace(sphere, result=folds)).checks
    assert (told.value, told.state) == ("found, but with folds", MISSED)
    assert summary(report(replace(sphere, result=folds))).startswith("Not converged: ")
    # The surface exists: less of a bulge is no remedy.
    assert report(replace(sphere, result=folds), equation="CONSTANT", bulge=0.3).warnings == ()


def test_a_result_on_the_engines_own_mesh_says_so(sphere: Fairing) -> None:
    (first, *_) = report(replace(sphere, result=replace(sphere.result, polished=False))).checks
    assert (first.value, first.state) == ("yes, on a proxy", MET)


@pytest.mark.parametrize(("inside", "state"), [(1.0, MET), (1.009, MET), (1.02, MISSED)])
def test_curvature_inside_is_bounded_by_the_outlines(sphere: Fairing, inside: float, state: str) -> None:
    bulging = replace(sphere, curvature=(inside, 1.0))
    assert states(report(bulging))["Curvature inside"] == state
    other = replace(bulging, result=replace(sphere.result, equation="least_variation"))
    assert states(report(other))["Curvature inside"] == TOLD


@pytest.mark.parametrize(
    ("before", "after", "value", "state"), [(2, 2, "2 → 2", MET), (2, 3, "2 → 3", MISSED), (None, 0, "0", MET)]
)
def test_counts_must_not_grow(sphere: Fairing, before: int | None, after: int, value: str, state: str) -> None:
    told = report(replace(sphere, before=Quality(0, 0, before), after=Quality(0, 0, after)))
    (check,) = (check for check in told.checks if check.name == "Self-intersections")
    assert (check.value, check.state) == (value, state)


def test_a_soap_film_promises_no_angle(sphere: Fairing) -> None:
    film = report(sphere, equation="MINIMAL")
    assert "Angle at the outline" not in states(film)
    assert "angle" not in summary(film)


def test_warnings_name_their_object_where_there_are_several(sphere: Fairing) -> None:
    odd = replace(sphere, warnings=("odd",))
    assert report(odd).warnings == ("odd",)
    assert report(odd, sphere).warnings == ("Object 0: odd",)


@pytest.mark.parametrize(("converged", "bulge", "told"), [(False, 2.0, True), (True, 2.0, False), (False, 0.0, False)])
def test_a_bulge_that_is_not_found_is_explained(sphere: Fairing, converged: bool, bulge: float, told: bool) -> None:
    lost = replace(sphere, warnings=(), result=replace(sphere.result, converged=converged))
    notes = report(lost, equation="CONSTANT", bulge=bulge).warnings
    assert ["no surface with a bulge of 2" in note for note in notes] == [True] * told


def test_distortion_is_weighted_by_size(sphere: Fairing) -> None:
    one, three = (
        replace(sphere, vertices=np.arange(1), distortion=0.4),
        replace(sphere, vertices=np.arange(3), distortion=0.0),
    )
    assert report(one, three).distortion == pytest.approx(0.1)


def test_an_angle_above_the_limit_never_reads_like_the_limit() -> None:
    texts = {0.123: "0.12°", SMOOTH_ANGLE: "2°", 2.04: "2.04°", 2.0004: "2.0004°", 2.3: "2.3°", 14.6: "15°"}
    assert {angle: angle_text(angle) for angle in texts} == texts
