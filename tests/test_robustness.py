"""Nothing breaks the engine: which inputs are refused, which are solved, and which test shows it.

The law: never crash or hang, never write NaN, keep everything outside the patch and every array given, name the
elements of every refusal, say honestly whether it converged. `hard_inputs.Input.fair` checks the parts of it that
hold for every call. Row by row (files without their `test_`; no file: here):

3 faces at an edge      errors: refused_meshes[edge_of_three], a_fin_inside_the_patch_is_refused;
                        refusals_do_not_depend_on_the_method, a_fin_on_the_outline_changes_nothing
doubled triangles       doubled_triangles_are_refused_where_they_would_move, …_are_left_alone_elsewhere
lobes, bow-tie          lobes_are_solved_each_as_alone; errors: refused_meshes[bow_tie]
no area, no length      robustness_shape: given_positions_without_area_do_no_harm, outlines_without_length_or_area_…
unwelded seam           an_unwelded_seam_stays_open_and_is_reported
winding                 windings_do_not_matter (one face, all surroundings)
Möbius strip, closed    errors: refused_meshes[moebius_strip, closed_sphere], a_closed_component_is_left_alone;
                        a_moebius_strip_that_does_not_move_is_ignored
normals                 errors: meshes_solved_with_a_warning[reversed_normals, pinned_normal]
islands                 islands_are_solved_each_as_alone; components
nothing free            errors: refused_meshes[single_triangle, everything_fixed], empty_arrays_are_refused;
                        a_strip_without_free_vertices
one free vertex, fans   one_free_vertex, clusters_of_valence_3, fans_of_high_valence, fans_by_the_published_…
open borders            an_open_mesh_without_arguments_keeps_its_border
loose vertices          errors: vertices_without_triangles_may_be_anything
NaN, infinity           what_is_not_finite_in_the_patch_is_refused, infinity_outside_the_patch_is_left_alone
scale, offset           robustness_shape: scale_and_offset, scales_whose_squares_are_no_numbers; invariance
slivers, needles        robustness_shape: slivers_all_over, needles_in_the_reference, graded_meshes,
                        a_short_edge_on_the_outline
spikes, folds, noise    robustness_shape: the_interior_given_does_not_matter; invariance
crease, fold-over       robustness_shape: a_creased_outline_is_reported; warnings: a_surface_through_itself_is_reported
wrong arguments         errors: wrong_arguments_are_named; robustness_calls: wrong_arguments_of_every_kind_are_named, …
cancel, exceptions      cancel (questions_come_often_in_… with --thorough); robustness_calls: interrupted_at_every_call
memory, threads, fork   robustness_calls: without_memory_it_refuses_…, a_million_vertices, two_threads_…, a_fork_goes_on
again, renumbered       robustness_calls: again_moves_nothing_…, renumbered_input_gives_the_same_shape; result
at random               robustness_random; tests/fuzz (scripts/fuzz), whose finds are tests in boundary_loops

Through the operator (tests/blender; no file: bad_input). `refusal` and `solved` there check the law in Blender:
3 faces at an edge      a_fin_in_the_selection_is_refused, a_fin_on_the_outline_changes_nothing;
                        refusals: edge_with_four_faces
lobes, bow-tie          lobes_that_share_a_vertex_…, a_bow_tie_is_refused
no area, no length      edges_without_length_and_faces_without_area
unwelded seam           an_unwelded_seam_stays_and_is_reported
winding                 one_face_wound_the_other_way; outline: surroundings_wound_the_other_way_round
Möbius strip, closed    a_moebius_strip_is_refused, a_closed_component_alone_…, a_closed_component_beside_others_…
normals                 normals_against_the_winding_are_reported, the_normal_of_a_pin_is_reported_to_be_ignored
islands                 restoration: islands_as_alone; islands
nothing free            nothing_to_move_adds_no_undo_step; refusals: nothing_selected_is_an_info
one free vertex, fans   one_free_vertex_on_a_sphere, poles_of_high_valence, clusters_of_valence_3
open borders            kinds_of_mesh: open_border_stays (everything selected)
loose vertices, wire    integrity: loose_parts_are_left_alone
NaN, infinity           infinity_elsewhere; refusals: mesh_error_selects_its_vertices, one_refused_object_…
scale, offset           scale, offset_is_reported, offset_of_the_object_does_no_harm
slivers, needles        slivers
spikes, folds, noise    spikes_and_folds_inside; restoration: result_does_not_depend_on_the_interior
crease, fold-over       outline: sharp_edge_along_the_outline, folded_faces_around_the_outline
wrong arguments         refusals: refused_runs_leave_no_trace; interface: fair_mesh_refuses, command_refuses
cancel                  modal: escape_leaves_every_bit; background: cancelled_engine_leaves_every_bit
again                   again_moves_nothing_and_the_same_gives_the_same
"""

from __future__ import annotations

import numpy as np
import pytest

import bad_inputs
import fairing
import hard_inputs
import measures
import shapes
from hard_inputs import KINDS, WAYS, Input
from solving import codes

CAP = shapes.cap(60)
CLEAN = hard_inputs.of_patch(CAP)
in_all_ways = pytest.mark.parametrize(("method", "kind"), WAYS, ids=["-".join(way) for way in WAYS])


def off_the_sphere(result: fairing.FairResult) -> float:
    """Largest distance of a vertex from the unit sphere: a share of its radius."""
    return float(np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max())


@in_all_ways
def test_a_fin_on_the_outline_changes_nothing(method: str, kind: str) -> None:
    """Three triangles at an edge between fixed vertices: one of the patch, one outside, and the fin."""
    clean = hard_inputs.with_surroundings(CAP)
    result = hard_inputs.with_fin(clean).fair(method=method, inner_fairness=kind)
    control = clean.fair(method=method, inner_fairness=kind)
    assert np.abs(result.vertices[:-1] - control.vertices).max() < 1e-12
    assert "OPEN_BORDER_IN_SELECTION" in codes(result)


@pytest.mark.parametrize("turned", [False, True])
def test_doubled_triangles_are_refused_where_they_would_move(turned: bool) -> None:
    """A pocket of two triangles on an outline edge: its third vertex would be free and have two neighbours."""
    item = hard_inputs.with_pocket(CLEAN, turned)
    with pytest.raises(fairing.MeshError) as caught:
        item.fair()
    assert caught.value.code == "NONMANIFOLD_EDGE"
    pocket = {len(CAP.vertices), *CAP.fixed[:2]}
    assert set(caught.value.elements) == pocket
    assert caught.value.elements.size % 2 == 0


@in_all_ways
def test_doubled_triangles_are_left_alone_elsewhere(method: str, kind: str) -> None:
    item, clean = hard_inputs.beside(CLEAN, np.array([[0, 1, 2], [0, 1, 2]]), 3), CLEAN
    result, control = (one.fair(method=method, inner_fairness=kind) for one in (item, clean))
    assert np.array_equal(result.vertices[: len(CAP.vertices)], control.vertices)


@in_all_ways
def test_an_unwelded_seam_stays_open_and_is_reported(method: str, kind: str) -> None:
    item, seam = hard_inputs.unwelded_seam(CAP)
    result = item.fair(method=method, inner_fairness=kind)
    (warning,) = (w for w in result.warnings if w.code == "OPEN_BORDER_IN_SELECTION")
    assert set(warning.elements) == set(seam)
    assert "Merge by Distance" in warning.message
    assert np.array_equal(result.vertices[seam], item.vertices[seam])


@in_all_ways
def test_windings_do_not_matter(method: str, kind: str) -> None:
    """One triangle, or all the surroundings, wound against the others."""
    clean = hard_inputs.with_surroundings(CAP)
    for item, control in ((hard_inputs.one_turned(CAP), CLEAN), (hard_inputs.with_surroundings(CAP, True), clean)):
        result = item.fair(method=method, inner_fairness=kind)
        expected = control.fair(method=method, inner_fairness=kind)
        assert np.abs(result.vertices - expected.vertices).max() < 1e-6
        turned = (item.triangles != control.triangles).any(axis=1)
        (warning,) = (w for w in result.warnings if w.code == "INCONSISTENT_WINDING")
        assert set(warning.elements) == set(np.flatnonzero(turned))


@pytest.mark.parametrize("kept", [1, 2, 3])
def test_the_winding_at_the_outline_counts(kept: int) -> None:
    """Most of the patch is wound the other way, all but some rows along the outline, whose normals are given."""
    patch = shapes.cap(300)
    rows = np.isin(patch.triangles, patch.fixed).any(axis=1)
    for _ in range(kept - 1):
        rows = np.isin(patch.triangles, patch.triangles[rows]).any(axis=1)
    assert 0 < rows.sum() < len(rows)
    triangles = np.where(rows[:, None], patch.triangles, patch.triangles[:, ::-1])
    result = fairing.fair(patch.vertices, triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
    assert result.converged
    expected = fairing.fair(patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
    assert np.abs(result.vertices - expected.vertices).max() < 1e-9
    (warning,) = result.warnings
    assert warning.code == "INCONSISTENT_WINDING"
    assert set(warning.elements) == set(np.flatnonzero(~rows))


@pytest.mark.parametrize("method", ["global", "paper"])
def test_a_moebius_strip_that_does_not_move_is_ignored(method: str) -> None:
    strip = bad_inputs.moebius_strip()
    item = hard_inputs.beside(CLEAN, strip.triangles, len(strip.vertices), strip.vertices)
    control = CLEAN.fair(method=method)
    assert np.array_equal(item.fair(method=method).vertices[: len(CAP.vertices)], control.vertices)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("rounds", [1, 3])
def test_clusters_of_valence_3(kind: str, rounds: int) -> None:
    """Every triangle split in three, again and again: 27 in each of a few at first."""
    item = hard_inputs.subdivided(hard_inputs.of_patch(shapes.cap(30 if rounds == 1 else 12)), rounds)
    assert 3 * np.sum(measures.valences(item.triangles, len(item.vertices)) == 3) > len(item.vertices)
    result = item.fair(inner_fairness=kind)
    assert result.converged
    assert off_the_sphere(result) < 5e-3


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("valence", [50, 500, 1000])
def test_fans_of_high_valence(valence: int, kind: str) -> None:
    for item in (hard_inputs.single_fan(valence), hard_inputs.fan(valence)):
        result = item.fair(inner_fairness=kind)
        assert result.converged
        assert off_the_sphere(result) < 5e-3


@in_all_ways
def test_infinity_outside_the_patch_is_left_alone(method: str, kind: str) -> None:
    """The surroundings may hold anything that the outline doesn't touch; what touches it too."""
    clean = hard_inputs.with_surroundings(CAP)
    vertices = clean.vertices.copy()
    vertices[-1] = np.inf, 0.0, np.nan
    item: Input = clean.changed(vertices=vertices, reference=None)
    result = item.fair(method=method, inner_fairness=kind)
    control = clean.fair(method=method, inner_fairness=kind)
    assert np.array_equal(result.vertices[:-1], control.vertices[:-1])
    assert np.isfinite(result.mean_curvature).all()
    (warning,) = (w for w in result.warnings if w.code == "DEGENERATE_FACE")
    assert set(warning.elements) == set(np.flatnonzero((clean.triangles == len(vertices) - 1).any(axis=1)))
