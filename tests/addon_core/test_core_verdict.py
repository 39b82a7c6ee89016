"""What is good, what deserves a look, and what must not be written."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Ints
from addon.fair.solve import pose, solve
from addon.options.options import FairOptions
from addon.selection.selection import left_out
from addon.verdict.eaten import Eaten
from addon.verdict.evidence import Evidence, Flank
from addon.verdict.lost import Lost
from addon.verdict.outcome import outcome
from addon.verdict.quality import Join, Quality
from addon.verdict.verdict import (
    ADD_LEFT_OUT,
    AS_SELECTED,
    EVEN_CURVATURE,
    EVEN_SPREAD,
    GOOD,
    GROW,
    GROW_OVER,
    HOLD_BORDER,
    KEEP_DETAIL,
    LOOK,
    SMOOTH_OUTLINE,
    UNUSABLE,
    WRITE,
    Verdict,
    judge,
)
from addon.words.findings import Origin

import fairing
from polygon_mesh import grid, on_sphere, polygon_mesh

MESH = grid(12, 0.6, on_sphere)
FACE = int(np.flatnonzero(MESH.in_patch)[9])
OTHER = int(np.flatnonzero(MESH.in_patch)[20])
CORNERS = sorted(MESH.corner_vertices[MESH.corner_faces == FACE].tolist())


def ints(*numbers: int) -> Ints:
    return np.array(numbers, dtype=np.int64)


CLEAN = Quality(ints(), ints(), ints())
SEEN = Join(ints(5, 6), np.array([1.0, 20.0]), ints(1))


@pytest.fixture(scope="module")
def fine() -> Evidence:
    problem, _ = pose(MESH, np.eye(4), FairOptions())
    result = solve(MESH, np.eye(4), FairOptions()).result
    return Evidence(problem, result, (), CLEAN, CLEAN, Join(ints(5, 6), np.array([1.0, 2.0])))


@pytest.fixture(scope="module")
def piped() -> Evidence:
    """The middle of a pipe of 8 rows of 12 quads."""
    row, column = (index.ravel() for index in np.mgrid[:9, :12])
    turn = 2.0 * np.pi * column / 12
    quads = [
        [12 * k + i, 12 * k + (i + 1) % 12, 12 * k + 12 + (i + 1) % 12, 12 * k + 12 + i]
        for k in range(8)
        for i in range(12)
    ]
    points = np.column_stack([np.cos(turn), np.sin(turn), 0.5 * row])
    mesh = polygon_mesh(points, quads, np.repeat((np.arange(8) > 1) & (np.arange(8) < 6), 12))
    problem, _ = pose(mesh, np.eye(4), FairOptions())
    result = solve(mesh, np.eye(4), FairOptions(shape="HARMONIC")).result
    return Evidence(problem, result, (), CLEAN, CLEAN, Join(ints(24, 25), np.array([1.0, 2.0])))


def judged(evidence: Evidence, **options: Any) -> Verdict:
    return judge(evidence, FairOptions(**options))


def test_a_clean_result_is_good(fine: Evidence) -> None:
    assert judged(fine).grade == GOOD
    assert not judged(fine).remedies


def test_a_hard_edge_that_was_rounded_deserves_a_look(fine: Evidence) -> None:
    verdict = judged(replace(fine, rounded=ints(3, 8)), smooth_boundary=True)
    assert (verdict.grade, verdict.spots.tolist(), verdict.remedies) == (LOOK, [3, 8], (GROW, AS_SELECTED))
    assert verdict.reason == "Smooth Boundary has rounded a hard edge outside at 2 vertices: turn it off"


def test_a_knob_deserves_a_look(fine: Evidence) -> None:
    knob = replace(fine, swollen=ints(7, 4))
    verdict = judged(knob)
    assert (verdict.grade, verdict.spots.tolist(), verdict.remedies) == (LOOK, [7, 4], (GROW, SMOOTH_OUTLINE))
    assert verdict.reason == "The surface swells to a knob around 2 vertices: another boundary may avoid it"
    for meant in ({"detail": 0.5}, {"bulge": 1.0}, {"factor": 0.5}):
        assert judged(knob, **meant).grade == GOOD, meant


@pytest.mark.parametrize(
    ("girth", "reason"),
    [
        ((0.86, 1.0), "The tube narrows to 86% of its ends"),
        ((1.0, 1.55), "The tube swells to 155% of its ends"),
        ((0.94, 1.31), ""),
        (None, ""),
    ],
)
def test_a_waist_and_a_balloon_deserve_a_look_and_even_curvature(
    piped: Evidence, girth: tuple[float, float] | None, reason: str
) -> None:
    tube = replace(piped, result=replace(piped.result, girth=girth))
    for shape in ("AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY"):
        verdict = judged(tube, shape=shape)
        assert (verdict.grade, verdict.reason) == (LOOK if reason else GOOD, reason)
        assert (EVEN_CURVATURE in verdict.remedies) == (bool(reason) and shape != "AUTOMATIC")
        assert GROW not in verdict.remedies  # it helped none of twenty such tubes
        assert bool(len(verdict.spots)) == bool(reason)
    taken = replace(tube, result=replace(tube.result, equation="least_variation"))
    assert EVEN_CURVATURE not in judged(taken).remedies  # it is what Automatic has taken
    for meant in ({"detail": 0.5}, {"bulge": 1.0}, {"factor": 0.5}, {"continuity": "G0"}):
        assert judged(tube, **meant).grade == GOOD, meant


def test_a_surface_that_sinks_deserves_a_look(fine: Evidence) -> None:
    sunk = replace(fine, lost=Lost(0.07, ints(3, 4)))
    verdict = judged(sunk)
    assert (verdict.grade, verdict.spots.tolist()) == (LOOK, [3, 4])
    assert verdict.reason == "The surface sinks by 7% of its width: a ridge, a bevel or a girth is lost"
    for meant in ({"bulge": 1.0}, {"factor": 0.5}, {"continuity": "G0"}):
        assert judged(sunk, **meant).grade == GOOD, meant
    assert judged(sunk, detail=0.5).grade == LOOK  # skin is put on what has sunk


def test_a_crumpled_surface_deserves_a_look_where_it_bends_most(fine: Evidence) -> None:
    verdict = judged(replace(fine, lost=Lost(is_rougher=True)))
    assert verdict.grade == LOOK
    assert verdict.reason.startswith("The surface is crumpled")
    assert np.isin(verdict.spots, fine.problem.patch.vertices[fine.problem.patch.free]).all()
    assert judged(replace(fine, lost=Lost(is_rougher=True)), factor=0.5).grade == GOOD


def test_a_skin_that_is_gone_deserves_a_look_and_offers_to_keep_it(fine: Evidence) -> None:
    smooth = replace(fine, lost=Lost(is_smoother=True))
    verdict = judged(smooth)
    assert (verdict.grade, verdict.remedies[0]) == (LOOK, KEEP_DETAIL)
    assert verdict.reason.startswith("The surface is smoother than around")
    assert judged(smooth, detail=1.0).grade == GOOD
    assert judged(smooth, factor=0.5).grade == GOOD


def test_a_border_that_moved_far_deserves_a_look_and_offers_to_hold_it(fine: Evidence) -> None:
    verdict = judged(replace(fine, lost=Lost(border=ints(7))), fair_open_borders=True)
    assert (verdict.grade, verdict.spots.tolist()) == (LOOK, [7])
    assert HOLD_BORDER in verdict.remedies


def test_over_a_hard_outline_nothing_is_grown(fine: Evidence) -> None:
    """The flat top of a box would become a dome."""
    hard = replace(fine, join=SEEN, problem=replace(fine.problem, inward=ints(1, 2)))
    assert GROW in judged(replace(fine, join=SEEN)).remedies
    assert GROW not in judged(hard).remedies


@pytest.mark.parametrize(("at", "is_kept"), [(0.0, True), (None, False)])
def test_a_shown_key_with_a_shape_of_its_own_deserves_a_look(at: float | None, is_kept: bool) -> None:
    """A hill in the selection; not a key that bends its surroundings, and the selection with them."""
    x, y = MESH.positions[:, 0], MESH.positions[:, 1]
    height = 0.3 * x if at is None else 0.5 * np.exp(-20.0 * ((x - at) ** 2 + y**2))
    keyed = replace(MESH, shown_offsets=np.column_stack([0.0 * x, 0.0 * x, height]))
    found = outcome(keyed, np.eye(4), FairOptions(), solve(keyed, np.eye(4), FairOptions())).verdict
    assert (found.grade == LOOK) == is_kept
    assert ("shape key" in found.reason) == is_kept


def test_an_outline_on_a_slope_deserves_a_look_and_offers_the_way_over_it(fine: Evidence) -> None:
    outline = fine.problem.patch.outline[:3]
    for is_bump, kind in ((True, "bump"), (False, "dent")):
        sloped = replace(fine, flank=Flank(outline, is_bump, 4))
        verdict = judged(sloped)
        spots = fine.problem.patch.vertices[outline].tolist()
        assert (verdict.grade, verdict.spots.tolist(), verdict.rings) == (LOOK, spots, 4)
        assert verdict.remedies == (GROW_OVER, GROW, SMOOTH_OUTLINE)
        assert verdict.reason.startswith(f"The boundary is on the slope of a {kind}, so that the {kind} stays")
        for meant in ({"detail": 0.5}, {"bulge": 1.0}, {"factor": 0.5}):
            assert judged(sloped, **meant).grade == GOOD, meant
    assert judged(fine).rings == 1


@pytest.mark.parametrize("termination", ["stalled", "iteration_limit"])
def test_no_answer_is_not_usable(fine: Evidence, termination: Any) -> None:
    lost = replace(fine, result=replace(fine.result, converged=False, termination=termination), failures=("Why",))
    verdict = judged(lost)
    assert verdict.grade == UNUSABLE
    assert verdict.reason.startswith("Why: ")
    assert ("it was not there after" in verdict.reason) == (termination == "iteration_limit")
    assert verdict.reason.endswith("What it came to has no folds and no kinks")
    for spoilt in (
        replace(lost, after=replace(CLEAN, crossing=ints(FACE))),
        replace(lost, after=replace(CLEAN, folded=ints(FACE))),
        replace(lost, join=Join(ints(7), np.array([31.0]), ints(0))),
    ):
        assert "What it came to" not in judged(spoilt).reason
    reported = fairing.Diagnostic("NOT_CONVERGED", "", np.empty(0, np.int32), "vertex", {"area": 0.0})
    assert judged(replace(lost, result=replace(lost.result, warnings=(reported,)))).reason == "Why"
    outline = fine.problem.patch.vertices[fine.problem.patch.outline]
    assert set(verdict.spots) <= set(outline)
    assert len(verdict.spots)
    assert verdict.remedies == (GROW, SMOOTH_OUTLINE, EVEN_CURVATURE, WRITE)
    assert judged(lost, shape="LEAST_VARIATION", smooth_boundary=True).remedies == (GROW, WRITE)
    border = judged(lost, fair_open_borders=True)
    assert HOLD_BORDER in border.remedies
    assert border.reason.startswith("Why: a fair border may not exist where it is rough beside the selection")
    assert HOLD_BORDER not in judged(fine, fair_open_borders=True).remedies
    tried = replace(lost, result=replace(lost.result, provenance="loft"))
    assert judged(tried).remedies == (GROW, SMOOTH_OUTLINE, WRITE)
    assert judged(lost, factor=0.5).grade == UNUSABLE


def test_folds_are_not_usable_and_their_corners_are_the_spots(fine: Evidence) -> None:
    verdict = judged(replace(fine, after=replace(CLEAN, folded=ints(FACE))))
    assert (verdict.grade, verdict.reason) == (UNUSABLE, "1 face of the result is folded over")
    assert verdict.spots.tolist() == CORNERS


def test_folds_offer_to_spread_vertices_evenly(fine: Evidence) -> None:
    folded = replace(fine, after=replace(CLEAN, folded=ints(FACE)))
    assert EVEN_SPREAD in judged(folded, inner_fairness="CONFORMAL").remedies
    assert EVEN_SPREAD not in judged(folded, inner_fairness="UNIFORM").remedies
    assert EVEN_SPREAD not in judged(folded, inner_fairness="CONFORMAL", remesh=True).remedies
    crossing = replace(fine, after=replace(CLEAN, crossing=ints(FACE)))
    assert EVEN_SPREAD not in judged(crossing, inner_fairness="CONFORMAL").remedies


def test_folds_at_a_pin_name_it(fine: Evidence) -> None:
    patch = fine.problem.patch
    pin = int(np.flatnonzero(patch.vertices == CORNERS[0])[0])
    pinned = replace(patch, free=np.setdiff1d(patch.free, [pin]), fixed=np.append(patch.fixed, pin))
    problem = replace(fine.problem, patch=pinned)
    folded = replace(fine, problem=problem, after=replace(CLEAN, folded=ints(FACE)))
    assert judged(folded).reason == "1 face of the result is folded over, at 1 pinned vertex"
    away = replace(folded, after=replace(CLEAN, folded=ints(int(np.flatnonzero(MESH.in_patch)[-1]))))
    assert judged(away).reason == "1 face of the result is folded over"


def test_folds_that_hang_on_a_jagged_outline_deserve_a_look(fine: Evidence) -> None:
    """The engine says how far the outline lies beside the surface; a mesh that had more folds is better off."""
    reported = fairing.Diagnostic("NO_SOLUTION", "", np.empty(0, np.int32), "vertex", {"distance": 0.02})
    low_passed = replace(fine, result=replace(fine.result, warnings=(reported,)))
    rough = replace(CLEAN, folded=ints(FACE, OTHER), crossing=ints(FACE, OTHER))
    calm = replace(CLEAN, folded=ints(FACE), crossing=ints(OTHER))
    verdict = judged(replace(low_passed, before=rough, after=calm))
    assert (verdict.grade, verdict.reason) == (LOOK, "1 face of the result is folded over")
    assert WRITE not in verdict.remedies
    assert judged(replace(fine, before=rough, after=calm)).grade == UNUSABLE  # another surface
    as_folded = replace(rough, folded=calm.folded)
    assert judged(replace(low_passed, before=as_folded, after=calm)).grade == UNUSABLE  # no better than before
    assert judged(replace(low_passed, before=rough, after=replace(calm, crossing=rough.crossing))).grade == UNUSABLE
    unknown = replace(rough, crossing=None)
    assert judged(replace(low_passed, before=unknown, after=calm)).grade == LOOK


def test_a_loft_that_lets_slopes_go_deserves_a_look(fine: Evidence) -> None:
    reported = fairing.Diagnostic("NO_SOLUTION", "", np.array([2, 4], np.int32), "vertex", {"loft": 1.0, "kinks": 2.0})
    verdict = judged(replace(fine, result=replace(fine.result, warnings=(reported,))))
    assert verdict.grade == LOOK
    assert "2 vertices of the boundary" in verdict.reason
    assert verdict.spots.tolist() == fine.problem.vertices[[2, 4]].tolist()


def with_warning(evidence: Evidence, code: str, elements: Ints, **figures: float) -> Evidence:
    reported = fairing.Diagnostic(code, "", elements.astype(np.int32), "vertex", figures)
    return replace(evidence, result=replace(evidence.result, warnings=(reported,)))


def test_a_smooth_loft_deserves_a_look_where_it_bends_most(fine: Evidence) -> None:
    """One vertex stands out of the sphere: the edges around it bend, and it is among the worst."""
    patch = fine.problem.patch
    points = fine.problem.points.copy()
    spike = patch.free[len(patch.free) // 2]
    points[spike] *= 1.2
    verdict = judged(replace(with_warning(fine, "NO_SOLUTION", ints(), loft=1.0), points=points))
    assert verdict.grade == LOOK
    assert "loft" in verdict.reason and "stand-in" in verdict.reason
    around = patch.vertices[np.unique(patch.triangles[(patch.triangles == spike).any(axis=1)])]
    assert 0 < len(verdict.spots) <= 0.05 * len(patch.free) + 1
    assert set(verdict.spots) <= set(around)
    assert judged(with_warning(fine, "NO_SOLUTION", ints(), harmonic=1.0)).grade == GOOD  # as Otherwise asks


def test_a_smoothed_shape_deserves_a_look(fine: Evidence) -> None:
    verdict = judged(with_warning(fine, "NO_SOLUTION", ints(), smoothed=1.0))
    assert verdict.grade == LOOK
    assert "old shape" in verdict.reason


def test_a_skin_that_was_asked_for_and_is_not_there_deserves_a_look(fine: Evidence) -> None:
    assert judged(with_warning(fine, "G2_NOT_MET", ints(4, 2)), continuity="G2").grade == GOOD  # a note says so
    verdict = judged(with_warning(fine, "REFERENCE_UNUSABLE", ints(), old_skin=1.0), detail=1.0)
    assert (verdict.grade, verdict.reason) == (LOOK, "The detail asked for could not be put back: the result is smooth")
    assert len(verdict.spots)
    assert judged(with_warning(fine, "REFERENCE_UNUSABLE", ints())).grade == GOOD  # the surface is the same


def test_on_a_new_mesh_the_engines_numbers_are_those_of_the_mesh_that_it_solved(fine: Evidence) -> None:
    own = len(fine.problem.vertices)
    origin = Origin(np.arange(100, 110 + own), np.empty((0, 3), np.int64), ints())
    reported = replace(with_warning(fine, "PINS_NOT_SPREAD", ints(own + 5), tips=1.0), origin=origin)
    assert judged(reported).spots.tolist() == [own + 105]


def test_the_tip_of_a_needle_deserves_a_look(fine: Evidence) -> None:
    reported = fairing.Diagnostic("PINS_NOT_SPREAD", "", np.array([3], np.int32), "vertex", {"tips": 1.0})
    verdict = judged(replace(fine, result=replace(fine.result, warnings=(reported,))))
    assert (verdict.grade, verdict.reason) == (LOOK, "The surface forms a spike at 1 pinned vertex")
    assert verdict.spots.tolist() == fine.problem.vertices[[3]].tolist()


def test_half_way_old_folds_may_be_left(fine: Evidence) -> None:
    same = replace(fine, before=replace(CLEAN, folded=ints(FACE)), after=replace(CLEAN, folded=ints(FACE)))
    assert judged(same, factor=0.5).grade == GOOD
    assert judged(same).grade == UNUSABLE
    more = replace(same, after=replace(CLEAN, folded=ints(FACE, OTHER)))
    assert judged(more, factor=0.5).grade == UNUSABLE


def test_folds_that_only_the_engine_names_are_not_usable(fine: Evidence) -> None:
    triangle = int(np.flatnonzero(fine.problem.patch.faces == FACE)[0])
    warning = fairing.Diagnostic("FOLDED", "", np.array([triangle], dtype=np.int32), "triangle")
    result = replace(fine.result, converged=False, termination="folded", warnings=(warning,))
    verdict = judged(replace(fine, result=result, failures=("Folds",)))
    assert (verdict.grade, verdict.reason) == (UNUSABLE, "Folds")
    assert set(verdict.spots) <= set(CORNERS)
    assert len(verdict.spots) == 3


@pytest.mark.parametrize(
    ("before", "after", "grade"), [([], [FACE], UNUSABLE), ([FACE], [FACE], GOOD), ([OTHER], [FACE], UNUSABLE)]
)
def test_crossings_count_where_the_original_had_none(
    fine: Evidence, before: Sequence[int], after: Sequence[int], grade: str
) -> None:
    crossing = replace(fine, before=replace(CLEAN, crossing=ints(*before)), after=replace(CLEAN, crossing=ints(*after)))
    assert judged(crossing).grade == grade
    if grade == UNUSABLE:
        assert judged(crossing).spots.tolist() == CORNERS
    unknown = replace(crossing, before=replace(CLEAN, crossing=None))
    assert judged(unknown).grade == UNUSABLE


def test_a_hard_edge_that_was_eaten_deserves_a_look(fine: Evidence) -> None:
    running = replace(fine, eaten=Eaten(running_on=ints(3, 8)))
    assert judged(running).grade == LOOK
    assert judged(running).spots.tolist() == [3, 8]
    assert judged(running).reason.startswith("A hard edge runs on outside, but was rounded off at 2 vertices")
    assert judged(running).reason.endswith("to keep it")
    kinked = replace(running, join=Join(ints(7, 8, 9), np.array([12.5, 3.0, 28.0]), ints(2, 0)))
    assert judged(kinked).reason.endswith("or grow the selection: a kink of 28° shows at the boundary")
    assert judged(kinked).spots.tolist() == [3, 8, 9, 7]
    steep = replace(running, join=Join(ints(7, 8, 9), np.array([12.5, 3.0, 41.0]), ints(2, 0)))
    assert judged(steep).reason == (
        "A kink shows at 2 vertices of the boundary, of 41° at worst, and hard edges were rounded off at 2 vertices"
    )
    assert judged(steep).spots.tolist() == [9, 7, 3, 8]
    marked = replace(fine, eaten=Eaten(running_on=ints(3, 8), marked=ints(4)))
    assert judged(replace(marked, join=steep.join)).reason.startswith("A kink shows")
    assert judged(replace(marked, join=kinked.join)).reason.startswith("Edges marked sharp")
    assert judged(marked).spots.tolist() == [4]
    assert judged(marked).reason.startswith("Edges marked sharp were rounded off at 1 vertex")
    for options in ({"factor": 0.5}, {"continuity": "G0"}):
        assert judged(marked, **options).grade == GOOD


def test_a_kink_deserves_a_look_at_its_vertices(fine: Evidence) -> None:
    kinked = replace(fine, join=Join(ints(7, 8, 9), np.array([12.5, 3.0, 31.0]), ints(2, 0)))
    verdict = judged(kinked)
    assert (verdict.grade, verdict.spots.tolist()) == (LOOK, [9, 7])
    assert verdict.reason == "A kink shows at 2 vertices of the boundary, of 31° at worst"
    assert verdict.remedies == (GROW, SMOOTH_OUTLINE)
    turned = replace(fine, join=Join(ints(7, 8), np.array([12.5, 105.9]), ints(1, 0)))
    assert judged(turned).reason == (
        "The surface turns back from the slope around it at 2 vertices of the boundary, by 106°"
    )
    assert judged(kinked, continuity="G0").grade == GOOD
    assert judged(kinked, factor=0.5).grade == GOOD


def test_what_the_eye_does_not_see_is_good(fine: Evidence) -> None:
    assert judged(replace(fine, join=Join(ints(7), np.array([20.0])))).grade == GOOD  # a coarse cage


def test_needles_are_counted_and_not_worth_a_word(fine: Evidence) -> None:
    assert judged(replace(fine, after=replace(CLEAN, needles=ints(FACE)))).grade == GOOD


@pytest.mark.parametrize(
    ("ending", "steps", "reported"),
    [
        ("stalled", 0, "no initial surface was found"),
        ("stalled", 14, "the search came to a halt"),
        ("iteration_limit", 20, "it was not there after 20 steps"),
    ],
)
def test_how_a_search_ended_is_reported_without_a_figure_that_says_nothing(
    fine: Evidence, ending: str, steps: int, reported: str
) -> None:
    result = replace(fine.result, converged=False, termination=ending, iterations=steps)
    assert judged(replace(fine, result=result)).reason.startswith(
        f"No fair surface was found: {reported}. What it came to"
    )


def test_without_anything_outside_there_is_nothing_to_grow_into(fine: Evidence) -> None:
    whole = grid(8, 2.0, on_sphere)
    problem, _ = pose(whole, np.eye(4), FairOptions())
    lost = replace(fine, problem=problem, result=replace(fine.result, converged=False, termination="stalled"))
    verdict = judged(lost)
    assert verdict.remedies == (EVEN_CURVATURE, WRITE)
    assert verdict.reason.startswith("No fair surface was found: the search came to a halt")
    assert verdict.spots.tolist() == problem.patch.vertices[problem.patch.outline].tolist()


def test_faces_left_out_within_are_offered_where_something_is_wrong(fine: Evidence) -> None:
    mesh = without_faces(grid(24, 0.6, on_sphere), 3)
    assert outcome(mesh, np.eye(4), FairOptions(), solve(mesh, np.eye(4), FairOptions())).verdict.grade == GOOD
    kinked = replace(fine, left_out=left_out(mesh), join=SEEN)
    assert ADD_LEFT_OUT in judged(kinked).remedies
    assert ADD_LEFT_OUT not in judged(replace(fine, join=SEEN)).remedies


def without_faces(mesh: MeshArrays, count: int) -> MeshArrays:
    """As if a lasso had missed some, none beside another or the outline."""
    chosen = mesh.in_patch.copy()
    ring = np.isin(mesh.corner_vertices, mesh.corner_vertices[~chosen[mesh.corner_faces]])
    inner = np.setdiff1d(np.flatnonzero(chosen), mesh.corner_faces[ring])
    for _ in range(count):
        face = inner[0]
        chosen[face] = False
        touched = np.isin(mesh.corner_vertices, mesh.corner_vertices[mesh.corner_faces == face])
        inner = np.setdiff1d(inner, mesh.corner_faces[touched])
    return replace(mesh, in_patch=chosen)
