"""Outlines: loops, standard errors, mending, the measure of the join, and open borders that become fair."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import bad_inputs
import fairing
import measures
import shapes
import windows
from curves import FloatArray
from fairing.solving import surroundings
from meshing import IntArray, face_normals
from windows import Kind, Window


@dataclass(frozen=True)
class Ball:
    """A unit sphere, exact and noisy, cut along a zigzag round the equator."""

    exact: FloatArray
    noisy: FloatArray
    triangles: IntArray
    above: Any  # (m,) mask

    @property
    def inside(self) -> IntArray:
        return self.triangles[self.above]

    @property
    def outside(self) -> IntArray:
        return self.triangles[~self.above]

    @property
    def boundary(self) -> IntArray:
        return np.intersect1d(self.inside, self.outside)


def ball(noise: float, seed: int = 0, n_free: int = 400) -> Ball:
    """noise: the standard deviation of each coordinate, in mean edges."""
    vertices, triangles, _ = bad_inputs.closed_ball(n_free)
    ends = vertices[measures.edges(triangles)]
    edge = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()
    # Not at the equator, along which the mesh is regular.
    above = vertices[triangles].mean(axis=1) @ np.array([0.6, 0.0, 0.8]) > 0.15
    shift = np.random.default_rng(seed).normal(size=vertices.shape) * noise * edge
    return Ball(vertices, vertices + shift, triangles, above)


def degrees_between(one: FloatArray, other: FloatArray) -> FloatArray:
    cross = np.linalg.norm(np.cross(one, other), axis=1)
    return np.asarray(np.degrees(np.arctan2(cross, (one * other).sum(axis=1))))


def rim_error(case: Ball, vertices: FloatArray) -> float:
    """Mean angle of the patch's triangles along the boundary to the sphere's normals there, degrees."""
    rim = case.inside[np.isin(case.inside, case.boundary).sum(axis=1) >= 2]
    normals = face_normals(vertices, rim)
    middles = case.exact[rim].mean(axis=1)
    return float(degrees_between(normals, middles).mean())


@pytest.mark.parametrize("noise", [0.012, 0.058, 0.144])
def test_normals_of_noisy_surroundings(noise: float) -> None:
    """Medians are 0.27°, 1.4°, 4.2°; a surface through the vertices themselves gives 0.72°, 3.5°, 9.8°."""
    angles, errors = [], []
    for seed in range(4):
        case = ball(noise, seed)
        found = fairing.surrounding_normals(case.noisy, case.outside, case.boundary)
        angles.append(degrees_between(found.normals, case.exact[case.boundary]))
        errors.append(np.degrees(found.errors))
    assert np.median(np.concatenate(angles)) < 35 * noise
    assert 0.4 < np.median(np.concatenate(angles) / np.concatenate(errors)) < 1.6


def options_of(case: Ball) -> dict[str, Any]:
    found = fairing.surrounding_normals(case.noisy, case.outside, case.boundary)
    return {"fixed": case.boundary, "fixed_normals": found.normals, "outside": case.outside}


def test_a_fitted_rim_is_smooth() -> None:
    """Means are 8.5° and 3.6°."""
    before, after = [], []
    for seed in range(4):
        case = ball(0.1, seed)
        given = fairing.fair(case.noisy, case.inside, **options_of(case))
        fitted = fairing.fair(case.noisy, case.inside, outline="mended", **options_of(case))
        assert fitted.converged and len(given.moved) == 0
        rest = np.setdiff1d(case.outside, fitted.moved)
        assert np.array_equal(fitted.vertices[rest], case.noisy[rest])
        before.append(rim_error(case, given.vertices))
        after.append(rim_error(case, fitted.vertices))
    assert np.mean(after) < 0.5 * np.mean(before)


def test_mending_without_an_outside_is_refused() -> None:
    case = ball(0.1)
    with pytest.raises(ValueError, match="outline: 'mended' needs the triangles outside"):
        fairing.fair(case.noisy, case.inside, fixed=case.boundary, outline="mended")
    with pytest.raises(ValueError, match="outline: 'smoothed' is not accepted"):
        fairing.fair(case.noisy, case.inside, outline="smoothed")


def answers(case: Ball, fitted_folds: int, given_folds: int) -> tuple[dict[str, Any], list[surroundings.Boundary]]:
    """What comes of mending when the solves have these numbers of folded triangles; and the boundaries asked for."""
    asked: list[surroundings.Boundary] = []

    def call(boundary: surroundings.Boundary) -> dict[str, Any]:
        asked.append(boundary)
        count = given_folds if boundary.vertices is case.noisy else fitted_folds
        folds = fairing.Diagnostic("FLIPPED_TRIANGLES", "", np.arange(count, dtype=np.int32), "triangle")
        return {"converged": True, "warnings": (folds,) if count else (), "vertices": case.exact}  # joins without kinks

    given = surroundings.Boundary(case.noisy, None, None)
    around = surroundings.Surroundings.of(case.noisy, case.inside, None, case.outside)
    return surroundings.solve_fitted(call, given, case.inside, around), asked


def test_a_fitted_boundary_that_folds_the_patch_is_given_up() -> None:
    case = ball(0.1)
    answer, asked = answers(case, 2, 0)
    assert "moved" not in answer and len(asked) == 2
    assert [warning.code for warning in answer["warnings"]] == ["OUTLINE_KEPT"]
    answer, asked = answers(case, 2, 2)
    assert len(answer["moved"]) and len(asked) == 2
    answer, asked = answers(case, 0, 1)
    assert len(answer["moved"]) and len(asked) == 1


@pytest.mark.parametrize("noise", [0.0, 0.144])
def test_noise_everywhere_makes_no_vertex_bad(noise: float) -> None:
    case = ball(noise)
    assert len(fairing.bad_outline(case.noisy, case.outside, case.boundary)) == 0


def test_the_join_of_a_sphere_is_invisible_and_a_wrong_normal_shows() -> None:
    case = ball(0.0)
    result = fairing.fair(case.noisy, case.inside, **options_of(case))
    assert result.join.shape == result.fixed.shape
    assert result.join.max() < 2.0
    options = options_of(case)
    tilted = options["fixed_normals"] + np.tan(np.radians(20)) * np.array([0.6, 0, 0.8])
    options["fixed_normals"] = tilted / np.linalg.norm(tilted, axis=1)[:, None]
    leaning = fairing.fair(case.noisy, case.inside, **options)
    assert 10 < np.median(leaning.join) < 25


# `fairing.boundary_loops`: every border vertex once, in order with the mesh on the left.
def check(triangles: IntArray, count: int) -> None:
    loops = fairing.boundary_loops(triangles)
    assert len(loops) == count
    border = {tuple(edge) for edge in measures.border_edges(triangles).tolist()}
    steps = [(int(a), int(b)) for loop in loops for a, b in zip(loop, np.roll(loop, -1), strict=True)]
    assert len(steps) == len(set(steps)) == len(border)
    assert set(steps) == border
    assert all(loop[0] == loop.min() for loop in loops)


@pytest.mark.parametrize(("name", "count"), [("cap", 1), ("cylinder", 2), ("plane", 1), ("torus", 1)])
def test_loops_of_patches(name: str, count: int) -> None:
    check(getattr(shapes, name)(200).triangles, count)


def test_closed_meshes_have_none() -> None:
    assert fairing.boundary_loops(bad_inputs.closed_ball()[1]) == []


def test_a_single_sided_mesh_has_no_left_and_is_refused() -> None:
    with pytest.raises(fairing.MeshError) as caught:
        fairing.boundary_loops(bad_inputs.moebius_strip()[1])
    assert caught.value.code == "NOT_ORIENTABLE"


def test_a_waist_between_two_fans_is_no_border() -> None:
    """Both its ends lie on the border, free vertices on both its sides: the solver cuts there, the loop does not."""
    left = [[0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 2]]
    right = [[1, 3, 2], [1, 2, 6], [1, 6, 7], [1, 7, 3]]
    (loop,) = fairing.boundary_loops(left + right)
    assert list(loop) == [2, 6, 7, 3, 4, 5]


# Open borders that become fair: noisy windows in cylinders and spheres.
def fair(window: Window, start: np.ndarray, **options: object) -> fairing.FairResult:  # type: ignore[type-arg]
    return fairing.fair(start, window.triangles, fixed=window.boundary, fixed_normals=window.normals, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["cylinder", "sphere"])
@pytest.mark.parametrize("around", [24, 48])
def test_a_noisy_window_comes_back(kind: Kind, around: int) -> None:
    """From noise of a quarter edge along each axis: the surface to 1e-6, and half of the border's noise goes."""
    window = windows.window(kind, around, 3)
    start = window.noisy(0.25, 4)
    result = fair(window, start, open_border="faired")
    assert result.converged
    assert result.equation == "least_variation"
    assert window.off_surface(result.vertices).max() < 1e-6
    assert window.off_border(result.vertices) < 0.55 * window.off_border(start)
    assert "OPEN_BORDER_IN_SELECTION" not in {reported.code for reported in result.warnings}
    assert np.isin(window.border, result.fixed).sum() == 0
    assert np.array_equal(result.vertices[window.boundary], start[window.boundary])


def test_the_fair_curve_does_not_drift_within_the_surface() -> None:
    """Another noise across the surface alone leaves the border where it is within the surface, to .01 edges."""
    window = windows.window("sphere", 24, 11)
    start = window.noisy(0.25, 11)
    lifted = start * (1.0 + 0.03 * np.cos(5 * np.arange(len(start))))[:, None]
    lifted[window.boundary] = window.vertices[window.boundary]
    places = [fair(window, points, open_border="faired").vertices[window.border] for points in (start, lifted)]
    assert np.linalg.norm(places[0] - places[1], axis=1).max() < 0.01 * window.border_edge


def test_a_border_between_held_ends_meets_them() -> None:
    """Two thirds of the window are in the selection; the rest of its border is fixed."""
    window = windows.window("sphere", 48, 5)
    kept = window.border[:16]
    fixed = np.concatenate([window.boundary, kept])
    start = window.noisy(0.25, 6)
    start[kept] = window.vertices[kept]
    result = fairing.fair(
        start, window.triangles, fixed=fixed, fixed_normals=window.vertices[fixed], open_border="faired"
    )
    assert result.converged
    assert window.off_surface(result.vertices).max() < 1e-6
    assert np.array_equal(result.vertices[kept], start[kept])
    assert window.off_border(result.vertices) < 0.55 * window.off_border(start)


def test_a_fair_border_keeps_its_place() -> None:
    window = windows.window("sphere", 48, 7)
    result = fair(window, window.vertices, open_border="faired")
    edge = np.linalg.norm(window.vertices[window.border[1]] - window.vertices[window.border[0]])
    assert np.linalg.norm(result.vertices - window.vertices, axis=1)[window.border].max() < 0.01 * edge
