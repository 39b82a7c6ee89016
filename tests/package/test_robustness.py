"""Nothing breaks the engine: bad connectivity, positions without area or length, needles, slivers, scales.

The law: never crash or hang, never write NaN, keep everything outside the patch and every array given, name the
elements of every refusal, say honestly whether it converged. `hard_inputs.Input.fair` checks the parts of it that
hold for every call.
"""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bad_inputs
import fairing
import hard_inputs
import random_inputs
import shapes
from hard_inputs import KINDS, WAYS, Input
from solving import codes

CAP = shapes.cap(60)
CLEAN = hard_inputs.of_patch(CAP)
AROUND = hard_inputs.with_surroundings(CAP)
in_all_ways = pytest.mark.parametrize(("method", "kind"), WAYS, ids=["-".join(way) for way in WAYS])


def off_the_sphere(vertices: Any) -> float:
    """Largest distance of a vertex from the unit sphere: a share of its radius."""
    return float(np.abs(np.linalg.norm(vertices, axis=1) - 1).max())


def far_corner(value: float) -> Input:
    """A corner of the surroundings that the boundary doesn't touch."""
    vertices = AROUND.vertices.copy()
    vertices[-1] = value, 0.0, np.nan
    return AROUND.changed(vertices=vertices, reference=None)


STRIP = bad_inputs.moebius_strip()
# What does not matter: the input, the one without it, what has to be warned of, the triangles or vertices named.
HARMLESS: dict[str, tuple[Input, Input, str, set[int] | None]] = {
    "a fin on the outline": (hard_inputs.with_fin(AROUND), AROUND, "OPEN_BORDER_IN_SELECTION", None),
    "doubled triangles elsewhere": (hard_inputs.beside(CLEAN, np.array([[0, 1, 2], [0, 1, 2]]), 3), CLEAN, "", None),
    "a Möbius strip elsewhere": (hard_inputs.beside(CLEAN, STRIP[1], len(STRIP[0]), STRIP[0]), CLEAN, "", None),
    "one triangle turned": (hard_inputs.one_turned(CAP), CLEAN, "INCONSISTENT_WINDING", None),
    "all surroundings turned": (hard_inputs.with_surroundings(CAP, True), AROUND, "INCONSISTENT_WINDING", None),
    "infinity outside": (
        far_corner(np.inf), AROUND, "DEGENERATE_FACE",
        set(np.flatnonzero((AROUND.triangles == len(AROUND.vertices) - 1).any(axis=1))),
    ),
}  # fmt: skip


@in_all_ways
@pytest.mark.parametrize("name", HARMLESS)
def test_what_does_no_harm(name: str, method: str, kind: str) -> None:
    item, clean, code, named = HARMLESS[name]
    result, control = (one.fair(method=method, inner_fairness=kind) for one in (item, clean))
    moving = CAP.free
    assert np.abs(result.vertices[moving] - control.vertices[moving]).max() < 1e-6
    assert np.isfinite(result.mean_curvature).all()
    if code == "INCONSISTENT_WINDING":
        named = set(np.flatnonzero((item.triangles != clean.triangles).any(axis=1)))
    warnings = [set(w.elements) for w in result.warnings if w.code == code]
    assert len(warnings) == bool(code) and (named is None or warnings == [named])


@pytest.mark.parametrize("turned", [False, True])
def test_doubled_triangles_are_refused_where_they_would_move(turned: bool) -> None:
    """A pocket of two triangles on a boundary edge: its third vertex would be free and have two neighbours."""
    with pytest.raises(fairing.MeshError) as caught:
        hard_inputs.with_pocket(CLEAN, turned).fair()
    assert caught.value.code == "NONMANIFOLD_EDGE"
    assert set(caught.value.elements) == {len(CAP.vertices), *CAP.fixed[:2]}


@in_all_ways
def test_an_unwelded_seam_stays_open_and_is_reported(method: str, kind: str) -> None:
    item, seam = hard_inputs.unwelded_seam(CAP)
    result = item.fair(method=method, inner_fairness=kind)
    (warning,) = (w for w in result.warnings if w.code == "OPEN_BORDER_IN_SELECTION")
    assert set(warning.elements) == set(seam)
    assert np.array_equal(result.vertices[seam], item.vertices[seam])


@pytest.mark.parametrize("kept", [1, 2, 3])
def test_the_winding_at_the_boundary_counts(kept: int) -> None:
    """Most of the patch is wound the other way, all but some rows along the boundary, whose normals are given."""
    patch = shapes.cap(300)
    rows = np.isin(patch.triangles, patch.fixed).any(axis=1)
    for _ in range(kept - 1):
        rows = np.isin(patch.triangles, patch.triangles[rows]).any(axis=1)
    item = hard_inputs.of_patch(patch)
    result = item.changed(triangles=np.where(rows[:, None], patch.triangles, patch.triangles[:, ::-1])).fair()
    assert result.converged
    assert np.abs(result.vertices - item.fair().vertices).max() < 1e-9
    (warning,) = result.warnings
    assert (warning.code, set(warning.elements)) == ("INCONSISTENT_WINDING", set(np.flatnonzero(~rows)))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "item",
    [
        *(hard_inputs.subdivided(hard_inputs.of_patch(shapes.cap(n)), rounds) for n, rounds in ((30, 1), (12, 3))),
        *(make(valence) for valence in (50, 1000) for make in (hard_inputs.single_fan, hard_inputs.fan)),
    ],
    ids=["valence 3", "clusters of valence 3", "a fan of 50", "50 in rings", "a fan of 1000", "1000 in rings"],
)
def test_any_valence(item: Input, kind: str) -> None:
    result = item.fair(inner_fairness=kind)
    assert result.converged
    assert off_the_sphere(result.vertices) < 5e-3


@in_all_ways
def test_boundaries_without_length_or_area_do_no_harm(method: str, kind: str) -> None:
    """Two boundary vertices at one place; an ear of three in a line, whose middle dents the sphere by 0.014."""
    edge = hard_inputs.collapsed_boundary_edge(CAP).fair(method=method, inner_fairness=kind)
    ear = hard_inputs.flat_ear(CAP).fair(method=method, inner_fairness=kind)
    assert off_the_sphere(edge.vertices) < (4e-2 if method == "paper" else 5e-6)
    assert off_the_sphere(ear.vertices[CAP.free]) < (4e-2 if method == "paper" else 1.4e-2)
    assert "DEGENERATE_FACE" in codes(edge) & codes(ear)


@pytest.mark.parametrize("method", ["global", "paper"])
@pytest.mark.parametrize("scale", [1e-300, 1e-200, 1e-100, 1e-9, 1e9, 1e100, 1e200, 1e300])
def test_scales_whose_squares_are_no_numbers(scale: float, method: str) -> None:
    """H of the result included, in units of 1/scale."""
    control = CLEAN.fair(method=method)
    result = CLEAN.changed(vertices=scale * CAP.vertices, reference=None).fair(method=method)
    assert np.abs(result.vertices / scale - control.vertices).max() < 1e-6 * CAP.diameter
    assert result.converged and codes(result) == codes(control)


@pytest.mark.parametrize("method", ["global", "paper"])
def test_coordinates_whose_sums_are_no_numbers_are_refused(method: str) -> None:
    with pytest.raises(fairing.MeshError) as caught:
        CLEAN.changed(vertices=1e308 * CAP.vertices, reference=None).fair(method=method)
    assert (caught.value.code, set(caught.value.elements)) == ("NONFINITE", set(CAP.fixed))


@in_all_ways
@pytest.mark.parametrize("ratio", [1e2, 1e4])
def test_slivers_all_over(ratio: float, method: str, kind: str) -> None:
    """A plane stretched along one direction, boundary included: the plane, or it says that it isn't."""
    patch = shapes.plane(150)
    spans = np.ptp(patch.vertices, axis=0)
    vertices = patch.vertices * np.where(np.arange(3) == spans.argmax(), ratio, 1.0)
    result = Input(vertices, patch.triangles, patch.fixed, patch.fixed_normals, vertices).fair(
        method=method, inner_fairness=kind
    )
    assert np.ptp(result.vertices[:, spans.argmin()]) < 1e-9 * ratio or not result.converged
    assert result.converged or method == "paper"
    assert ("NOT_CONVERGED" in codes(result)) == (not result.converged)


@in_all_ways
def test_a_creased_boundary_is_reported(method: str, kind: str) -> None:
    """Normals that jump by 140° where the boundary crosses a crease: which vertices, and how well they were met."""
    result = hard_inputs.creased(shapes.plane(150)).fair(method=method, inner_fairness=kind)
    (warning,) = (w for w in result.warnings if w.code == "SHARP_BOUNDARY")
    assert "140°" in warning.message and len(warning.elements) == 4
    assert np.isfinite(result.boundary_angle).all() and result.boundary_angle.max() > 1.0


# Nothing breaks the engine: random patches, motions, numberings and damage.
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
