"""What is good, what deserves a look, and what must not be written."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Ints
from addon.fair.solve import pose, solve
from addon.options.options import FairOptions
from addon.selection.selection import left_out
from addon.verdict.evidence import Evidence
from addon.verdict.lost import Lost
from addon.verdict.outcome import outcome
from addon.verdict.quality import Join, Measured, Quality
from addon.verdict.verdict import (
    ADD_LEFT_OUT,
    AS_SELECTED,
    EVEN_SPREAD,
    GOOD,
    HOLD_BORDER,
    LOOK,
    UNUSABLE,
    WRITE,
    Verdict,
    judge,
)
from addon.words.findings import Origin

import fairing
from polygon_mesh import grid, on_sphere, polygon_mesh, tube

MESH = grid(12, 0.6, on_sphere)
FACE = int(np.flatnonzero(MESH.in_patch)[9])
OTHER = int(np.flatnonzero(MESH.in_patch)[20])
CORNERS = sorted(MESH.corner_vertices[MESH.corner_faces == FACE].tolist())


def ints(*numbers: int) -> Ints:
    return np.array(numbers, dtype=np.int64)


CLEAN = Quality(ints(), ints())
SEEN = Join(ints(5, 6), np.array([1.0, 20.0]), ints(1))


@pytest.fixture(scope="module")
def fine() -> Evidence:
    problem, _ = pose(MESH, np.eye(4), FairOptions())
    result = solve(MESH, np.eye(4), FairOptions()).result
    return Evidence(problem, result, (), Measured(CLEAN, CLEAN, Join(ints(5, 6), np.array([1.0, 2.0]))))


@pytest.fixture(scope="module")
def piped() -> Evidence:
    """The middle of a pipe of 8 rows of 12 quads."""
    points, quads = tube(12, (0.5 * np.arange(9)).tolist())
    mesh = polygon_mesh(points, quads, np.repeat((np.arange(8) > 1) & (np.arange(8) < 6), 12))
    problem, _ = pose(mesh, np.eye(4), FairOptions())
    result = solve(mesh, np.eye(4), FairOptions(shape="HARMONIC")).result
    return Evidence(problem, result, (), Measured(CLEAN, CLEAN, Join(ints(24, 25), np.array([1.0, 2.0]))))


def with_seen(evidence: Evidence, **fields: Any) -> Evidence:
    """Evidence of which other things are seen."""
    return replace(evidence, seen=replace(evidence.seen, **fields))


def judged(evidence: Evidence, **options: Any) -> Verdict:
    return judge(evidence, FairOptions(**options))


def warned(code: str, elements: Ints, kind: str = "vertex", **figures: float) -> Callable[[Evidence], Evidence]:
    """Evidence with this one warning of the engine."""
    said = fairing.Diagnostic(code, "", elements.astype(np.int32), kind, figures)
    return lambda fine: replace(fine, result=replace(fine.result, warnings=(said,)))


def but(**fields: Any) -> Callable[[Evidence], Evidence]:
    """Evidence that is fine but for these."""
    return lambda fine: replace(fine, **fields)


def seen(**fields: Any) -> Callable[[Evidence], Evidence]:
    """Evidence that is fine but for what is seen."""
    return lambda fine: with_seen(fine, **fields)


def after(**counts: Ints) -> Callable[[Evidence], Evidence]:
    return seen(after=replace(CLEAN, **counts))


def folded_as_before(*more: int) -> Callable[[Evidence], Evidence]:
    return seen(before=replace(CLEAN, folded=ints(FACE)), after=replace(CLEAN, folded=ints(FACE, *more)))


def kinked(*degrees: float) -> Join:
    """At vertices 9 and 7, the worst first."""
    return Join(ints(7, 8, 9), np.array(degrees), ints(2, 0))


def ended(ending: Any, steps: int) -> Callable[[Evidence], Evidence]:
    return lambda fine: replace(
        fine, result=replace(fine.result, converged=False, termination=ending, iterations=steps)
    )


EATEN, MARKED = {"running_on": ints(3, 8)}, {"running_on": ints(3, 8), "marked": ints(4)}


class Row(NamedTuple):
    """`reason` is its beginning where it ends in "…"; `has`, `lacks`: remedies; `good`: options that make it good."""

    change: Callable[[Evidence], Evidence]
    grade: str = LOOK
    reason: str | None = None
    spots: list[int] | None = None
    options: dict[str, Any] = {}  # noqa: RUF012
    remedies: tuple[str, ...] | None = None
    has: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()
    good: tuple[dict[str, Any], ...] = ()


FACTOR, FILM = {"factor": 0.5}, {"continuity": "G0"}
CONFORMAL, UNIFORM = {"inner_fairness": "CONFORMAL"}, {"inner_fairness": "UNIFORM"}
SEARCH = "No fair surface was found: {}. Grow or shrink the selection. The best…"
ROWS = {
    "clean": Row(lambda fine: fine, GOOD, remedies=()),
    "rounded outside": Row(
        seen(rounded=ints(3, 8)), LOOK, "Smooth Boundary has rounded a hard edge outside at 2 vertices: turn it off",
        [3, 8], {"smooth_boundary": True}, (AS_SELECTED,),
    ),
    "border": Row(but(lost=Lost(border=ints(7))), LOOK, None, [7], {"fair_open_borders": True}, has=(HOLD_BORDER,)),
    "seen": Row(seen(join=SEEN), lacks=(ADD_LEFT_OUT,)),
    "fold": Row(after(folded=ints(FACE)), UNUSABLE, "1 face of the result is folded over", CORNERS),
    "fold of a texture": Row(after(folded=ints(FACE)), UNUSABLE, options=CONFORMAL, has=(EVEN_SPREAD,)),
    "fold of an even mesh": Row(after(folded=ints(FACE)), UNUSABLE, options=UNIFORM, lacks=(EVEN_SPREAD,)),
    "fold of a new mesh": Row(
        after(folded=ints(FACE)), UNUSABLE, options={**CONFORMAL, "remesh": True}, lacks=(EVEN_SPREAD,)
    ),
    "crossing of a texture": Row(after(crossing=ints(FACE)), UNUSABLE, options=CONFORMAL, lacks=(EVEN_SPREAD,)),
    "old fold": Row(folded_as_before(), UNUSABLE, good=(FACTOR,)),
    "another fold": Row(folded_as_before(OTHER), UNUSABLE, options=FACTOR),
    "smoothed": Row(
        warned("NO_SOLUTION", ints(), smoothed=1.0), LOOK,
        "No fair surface fits these boundary loops: the old shape was smoothed…",
    ),
    "harmonic": Row(warned("NO_SOLUTION", ints(), harmonic=1.0), GOOD),  # as Otherwise asks
    "slope only": Row(warned("G2_NOT_MET", ints(4, 2)), GOOD, options={"continuity": "G2"}),  # a note says so
    "no skin": Row(
        warned("REFERENCE_UNUSABLE", ints(), old_skin=1.0), LOOK,
        "The detail asked for could not be put back: the result is smooth", options={"detail": 1.0},
    ),
    "no texture": Row(warned("REFERENCE_UNUSABLE", ints()), GOOD),  # the surface is the same
    "eaten": Row(
        seen(**EATEN), LOOK, "A hard edge from outside was rounded off at 2 vertices…", [3, 8]
    ),
    "eaten, with a kink": Row(
        seen(**EATEN, join=kinked(12.5, 3.0, 41.0)), LOOK, "A hard edge from outside…", [3, 8]
    ),
    "marked": Row(
        seen(**MARKED), LOOK, "Edges marked sharp were rounded off at 1 vertex…", [4], good=(FACTOR, FILM)
    ),
    "kink": Row(
        seen(join=kinked(12.5, 3.0, 31.0)), LOOK, "A kink shows at 2 vertices of the boundary, of 31° at worst", [9, 7],
        remedies=(), good=(FILM, FACTOR),
    ),
    "a coarse cage": Row(seen(join=Join(ints(7), np.array([20.0]))), GOOD),
    "no start": Row(ended("stalled", 0), LOOK, SEARCH.format("not even a first, rough surface fits this boundary")),
    "halted": Row(ended("stalled", 14), LOOK, SEARCH.format("the solver stopped making progress")),
    "out of steps": Row(ended("iteration_limit", 20), LOOK, SEARCH.format("20 steps were not enough")),
}  # fmt: skip


@pytest.mark.parametrize("name", ROWS)
def test_a_verdict(fine: Evidence, name: str) -> None:
    row = ROWS[name]
    evidence = row.change(fine)
    found = judged(evidence, **row.options)
    assert found.grade == row.grade
    if row.reason is not None and row.reason.endswith("…"):
        assert found.reason.startswith(row.reason[:-1])
    elif row.reason is not None:
        assert found.reason == row.reason
    assert row.spots is None or found.spots.tolist() == row.spots
    assert row.remedies is None or found.remedies == row.remedies
    assert {*row.has} <= {*found.remedies} and not {*row.lacks} & {*found.remedies}
    assert all(judged(evidence, **options).grade == GOOD for options in row.good)


@pytest.mark.parametrize(
    ("elements", "figures", "reason"),
    [
        ((3,), {"code": "PINS_NOT_SPREAD", "tips": 1.0}, "Spike at 1 pinned vertex"),
    ],
)
def test_what_the_engine_names_is_shown(fine: Evidence, elements: Any, figures: Any, reason: str) -> None:
    verdict = judged(warned(elements=ints(*elements), **figures)(fine))
    assert verdict.grade == LOOK and reason in verdict.reason
    assert verdict.spots.tolist() == fine.problem.vertices[list(elements)].tolist()


@pytest.mark.parametrize(
    ("girth", "reason"),
    [
        ((0.86, 1.0), "The tube narrows to 86% of its ends"),
        ((1.0, 1.55), "The tube swells to 155% of its ends"),
        ((0.94, 1.31), ""),
        (None, ""),
    ],
)
def test_a_waist_and_a_balloon_deserve_a_look(piped: Evidence, girth: tuple[float, float] | None, reason: str) -> None:
    tube = replace(piped, result=replace(piped.result, girth=girth))
    for shape in ("AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY"):
        verdict = judged(tube, shape=shape)
        assert (verdict.grade, verdict.reason) == (LOOK if reason else GOOD, reason)
        assert bool(len(verdict.spots)) == bool(reason)
    for meant in ({"detail": 0.5}, {"bulge": 1.0}, {"factor": 0.5}, {"continuity": "G0"}):
        assert judged(tube, **meant).grade == GOOD, meant


@pytest.mark.parametrize(("at", "is_kept"), [(0.0, True), (None, False)])
def test_a_shown_key_with_a_shape_of_its_own_deserves_a_look(at: float | None, is_kept: bool) -> None:
    """A hill in the selection; not a key that bends its surroundings, and the selection with them."""
    x, y = MESH.positions[:, 0], MESH.positions[:, 1]
    height = 0.3 * x if at is None else 0.5 * np.exp(-20.0 * ((x - at) ** 2 + y**2))
    keyed = replace(MESH, shown_offsets=np.column_stack([0.0 * x, 0.0 * x, height]))
    found = outcome(keyed, np.eye(4), FairOptions(), solve(keyed, np.eye(4), FairOptions())).verdict
    assert (found.grade == LOOK) == is_kept
    assert ("shape key" in found.reason) == is_kept


@pytest.mark.parametrize("termination", ["stalled", "iteration_limit"])
def test_no_answer_is_not_usable(fine: Evidence, termination: Any) -> None:
    lost = replace(fine, result=replace(fine.result, converged=False, termination=termination), failures=("Why",))
    verdict = judged(lost)
    assert verdict.grade == LOOK
    assert verdict.reason.startswith("Why: ")
    assert ("steps were not enough" in verdict.reason) == (termination == "iteration_limit")
    assert verdict.reason.endswith("The best surface so far has no folds and no kinks")
    for spoilt in (
        with_seen(lost, after=replace(CLEAN, crossing=ints(FACE))),
        with_seen(lost, after=replace(CLEAN, folded=ints(FACE))),
        with_seen(lost, join=Join(ints(7), np.array([31.0]), ints(0))),
    ):
        assert "The best surface" not in judged(spoilt).reason
        assert judged(spoilt).grade == UNUSABLE
        assert judged(spoilt).remedies[-1] == WRITE
    reported = fairing.Diagnostic("NOT_CONVERGED", "", np.empty(0, np.int32), "vertex", {"area": 0.0})
    assert judged(replace(lost, result=replace(lost.result, warnings=(reported,)))).grade == UNUSABLE
    boundary = fine.problem.patch.vertices[fine.problem.patch.boundary]
    assert set(verdict.spots) <= set(boundary)
    assert len(verdict.spots)
    assert verdict.remedies == ()
    border = judged(lost, fair_open_borders=True)
    assert HOLD_BORDER in border.remedies
    assert border.reason.startswith("Why: the open border may be too rough beside the selection")
    assert HOLD_BORDER not in judged(fine, fair_open_borders=True).remedies


def test_folds_at_a_pin_name_it(fine: Evidence) -> None:
    patch = fine.problem.patch
    pin = int(np.flatnonzero(patch.vertices == CORNERS[0])[0])
    pinned = replace(patch, free=np.setdiff1d(patch.free, [pin]), fixed=np.append(patch.fixed, pin))
    problem = replace(fine.problem, patch=pinned)
    folded = with_seen(replace(fine, problem=problem), after=replace(CLEAN, folded=ints(FACE)))
    assert judged(folded).reason == "1 face of the result is folded over, at 1 pinned vertex"
    away = with_seen(folded, after=replace(CLEAN, folded=ints(int(np.flatnonzero(MESH.in_patch)[-1]))))
    assert judged(away).reason == "1 face of the result is folded over"


def test_folds_that_hang_on_a_jagged_boundary_deserve_a_look(fine: Evidence) -> None:
    """The engine says how far the boundary lies beside the surface; a mesh that had more folds is better off."""
    low_passed = warned("NO_SOLUTION", ints(), distance=0.02)(fine)
    rough = replace(CLEAN, folded=ints(FACE, OTHER), crossing=ints(FACE, OTHER))
    calm = replace(CLEAN, folded=ints(FACE), crossing=ints(OTHER))
    verdict = judged(with_seen(low_passed, before=rough, after=calm))
    assert (verdict.grade, verdict.reason) == (LOOK, "1 face of the result is folded over")
    assert WRITE not in verdict.remedies
    assert judged(with_seen(fine, before=rough, after=calm)).grade == UNUSABLE  # another surface
    as_folded = replace(rough, folded=calm.folded)
    assert judged(with_seen(low_passed, before=as_folded, after=calm)).grade == UNUSABLE  # no better than before
    assert judged(with_seen(low_passed, before=rough, after=replace(calm, crossing=rough.crossing))).grade == UNUSABLE
    unknown = replace(rough, crossing=None)
    assert judged(with_seen(low_passed, before=unknown, after=calm)).grade == LOOK


def test_a_smooth_loft_deserves_a_look_where_it_bends_most(fine: Evidence) -> None:
    """One vertex stands out of the sphere: the edges around it bend, and it is among the worst."""
    patch = fine.problem.patch
    points = fine.problem.points.copy()
    spike = patch.free[len(patch.free) // 2]
    points[spike] *= 1.2
    verdict = judged(replace(warned("NO_SOLUTION", ints(), loft=1.0)(fine), points=points))
    assert verdict.grade == LOOK
    assert "loft" in verdict.reason and "stand-in" in verdict.reason
    around = patch.vertices[np.unique(patch.triangles[(patch.triangles == spike).any(axis=1)])]
    assert 0 < len(verdict.spots) <= 0.05 * len(patch.free) + 1
    assert set(verdict.spots) <= set(around)


def test_on_a_new_mesh_the_engines_numbers_are_those_of_the_mesh_that_it_solved(fine: Evidence) -> None:
    own = len(fine.problem.vertices)
    origin = Origin(np.arange(100, 110 + own), np.empty((0, 3), np.int64), ints())
    reported = replace(warned("PINS_NOT_SPREAD", ints(own + 5), tips=1.0)(fine), origin=origin)
    assert judged(reported).spots.tolist() == [own + 105]


@pytest.mark.parametrize(
    ("before", "after", "grade"), [([], [FACE], UNUSABLE), ([FACE], [FACE], GOOD), ([OTHER], [FACE], UNUSABLE)]
)
def test_crossings_count_where_the_original_had_none(
    fine: Evidence, before: Sequence[int], after: Sequence[int], grade: str
) -> None:
    crossing = with_seen(
        fine, before=replace(CLEAN, crossing=ints(*before)), after=replace(CLEAN, crossing=ints(*after))
    )
    assert judged(crossing).grade == grade
    if grade == UNUSABLE:
        assert judged(crossing).spots.tolist() == CORNERS
    unknown = with_seen(crossing, before=replace(CLEAN, crossing=None))
    assert judged(unknown).grade == UNUSABLE


def test_without_anything_outside_there_is_nothing_to_grow_into(fine: Evidence) -> None:
    whole = grid(8, 2.0, on_sphere)
    problem, _ = pose(whole, np.eye(4), FairOptions())
    lost = replace(fine, problem=problem, result=replace(fine.result, converged=False, termination="stalled"))
    verdict = judged(lost)
    assert verdict.remedies == ()
    assert verdict.reason.startswith("No fair surface was found: the solver stopped making progress")
    assert verdict.spots.tolist() == problem.patch.vertices[problem.patch.boundary].tolist()


def test_faces_left_out_within_are_offered_where_something_is_wrong(fine: Evidence) -> None:
    mesh = without_faces(grid(24, 0.6, on_sphere), 3)
    assert outcome(mesh, np.eye(4), FairOptions(), solve(mesh, np.eye(4), FairOptions())).verdict.grade == GOOD
    kinked = with_seen(replace(fine, left_out=left_out(mesh)), join=SEEN)
    assert ADD_LEFT_OUT in judged(kinked).remedies
    assert ADD_LEFT_OUT not in judged(with_seen(fine, join=SEEN)).remedies


def without_faces(mesh: MeshArrays, count: int) -> MeshArrays:
    """As if a lasso had missed some, none beside another or the boundary."""
    chosen = mesh.in_patch.copy()
    ring = np.isin(mesh.corner_vertices, mesh.corner_vertices[~chosen[mesh.corner_faces]])
    inner = np.setdiff1d(np.flatnonzero(chosen), mesh.corner_faces[ring])
    for _ in range(count):
        face = inner[0]
        chosen[face] = False
        touched = np.isin(mesh.corner_vertices, mesh.corner_vertices[mesh.corner_faces == face])
        inner = np.setdiff1d(inner, mesh.corner_faces[touched])
    return replace(mesh, in_patch=chosen)


def test_folds_that_only_the_engine_names_are_not_usable(fine: Evidence) -> None:
    triangle = int(np.flatnonzero(fine.problem.patch.faces == FACE)[0])
    warning = fairing.Diagnostic("FOLDED", "", np.array([triangle], dtype=np.int32), "triangle")
    result = replace(fine.result, converged=False, termination="folded", warnings=(warning,))
    verdict = judged(replace(fine, result=result, failures=("Folds",)))
    assert (verdict.grade, verdict.reason) == (UNUSABLE, "Folds")
    assert set(verdict.spots) <= set(CORNERS)
    assert len(verdict.spots) == 3
