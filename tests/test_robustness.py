"""Nothing breaks the engine: which inputs are refused, which are solved, and which test shows it.

The law: never crash or hang, never write NaN, keep everything outside the patch and every array given, name the
elements of every refusal, say honestly whether it converged. `hard_inputs.Input.fair` checks the parts of it that
hold for every call.
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
