"""Noisy, bad and visible outlines: standard errors, mending, growing, and the measure of the join."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import bad_inputs
import fairing
import measures
from curves import FloatArray
from fairing.solving import surroundings
from meshing import IntArray, edge_pairs, face_normals


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
    def outline(self) -> IntArray:
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
    """Mean angle of the patch's triangles along the outline to the sphere's normals there, degrees."""
    rim = case.inside[np.isin(case.inside, case.outline).sum(axis=1) >= 2]
    normals = face_normals(vertices, rim)
    middles = case.exact[rim].mean(axis=1)
    return float(degrees_between(normals, middles).mean())


@pytest.mark.parametrize("noise", [0.012, 0.058, 0.144])
def test_normals_of_noisy_surroundings(noise: float) -> None:
    """Medians are 0.27°, 1.4°, 4.2°; a surface through the vertices themselves gives 0.72°, 3.5°, 9.8°."""
    angles, errors = [], []
    for seed in range(4):
        case = ball(noise, seed)
        found = fairing.surrounding_normals(case.noisy, case.outside, case.outline)
        angles.append(degrees_between(found.normals, case.exact[case.outline]))
        errors.append(np.degrees(found.errors))
    assert np.median(np.concatenate(angles)) < 35 * noise
    assert 0.4 < np.median(np.concatenate(angles) / np.concatenate(errors)) < 1.6


def options_of(case: Ball) -> dict[str, Any]:
    found = fairing.surrounding_normals(case.noisy, case.outside, case.outline)
    return {"fixed": case.outline, "fixed_normals": found.normals, "outside": case.outside}


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


def test_a_clean_outline_gives_the_same_bits_fitted() -> None:
    case = ball(0.0)
    given = fairing.fair(case.noisy, case.inside, **options_of(case))
    fitted = fairing.fair(case.noisy, case.inside, outline="mended", **options_of(case))
    assert np.array_equal(given.vertices, fitted.vertices)


def test_mending_without_an_outside_is_refused() -> None:
    case = ball(0.1)
    with pytest.raises(ValueError, match="outline: 'mended' needs the triangles outside"):
        fairing.fair(case.noisy, case.inside, fixed=case.outline, outline="mended")
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


def with_a_spike() -> tuple[Ball, int]:
    """An exact sphere but for one vertex in the ring outside the outline, which sticks out by half the radius."""
    case = ball(0.0)
    near = case.outside[np.isin(case.outside, case.outline).any(axis=1)]
    spike = int(np.setdiff1d(near, case.outline)[3])
    vertices = case.exact.copy()
    vertices[spike] *= 1.5
    return Ball(case.exact, vertices, case.triangles, case.above), spike


@pytest.mark.parametrize("noise", [0.0, 0.144])
def test_noise_everywhere_makes_no_vertex_bad(noise: float) -> None:
    case = ball(noise)
    assert len(fairing.bad_outline(case.noisy, case.outside, case.outline)) == 0


def test_growing_over_a_spike_gives_the_sphere_back() -> None:
    case, spike = with_a_spike()
    grown = fairing.grown_outline(case.noisy, case.triangles, case.above)
    assert grown.round > 0 and grown.angles[grown.round] == min(grown.angles)
    assert grown.angles[grown.round] < 0.1 * grown.angles[0]
    assert (grown.selected | ~case.above).all()
    assert grown.selected[(case.triangles == spike).any(axis=1)].all()
    assert np.abs(np.linalg.norm(grown.result.vertices, axis=1) - 1).max() < 1e-3


def pairs(case: Ball) -> IntArray:
    """(m,) polygons of one or two triangles with a common edge, on one side of the outline."""
    face = np.arange(len(case.triangles))
    paired = np.zeros(len(face), dtype=bool)
    for first, second in edge_pairs(case.triangles)[1]:
        if not paired[[first, second]].any() and case.above[first] == case.above[second]:
            face[second] = face[first]
            paired[[first, second]] = True
    return face


def test_growing_takes_whole_polygons() -> None:
    case, _ = with_a_spike()
    faces = pairs(case)
    grown = fairing.grown_outline(case.noisy, case.triangles, case.above, faces=faces)
    assert grown.round > 0
    assert np.array_equal(np.isin(faces, faces[grown.selected]), grown.selected)
    divided = fairing.grown_outline(case.noisy, case.triangles, case.above)
    assert not np.array_equal(np.isin(faces, faces[divided.selected]), divided.selected)


def test_growing_makes_no_new_outline() -> None:
    """A ring with a gap, and a spike in the gap: growing over it would close the ring."""
    size = 18
    x, y = np.meshgrid(np.arange(size), np.arange(size))
    a = (size * y + x)[:-1, :-1].ravel()
    triangles = np.r_[np.c_[a, a + 1, a + size + 1], np.c_[a, a + size + 1, a + size]]
    vertices = np.c_[x.ravel(), y.ravel(), 0 * x.ravel()].astype(float)
    column, row = (triangles.min(axis=1) % size), triangles.min(axis=1) // size
    away = np.maximum(abs(column - 8), abs(row - 8))
    gap = (row == 8) & (column > 8)
    selected = (away >= 3) & (away <= 5) & ~gap
    vertices[size * 8 + 12, 2] = 0.6
    vertices[size * 9 + 12, 2] = -0.6
    assert len(fairing.bad_outline(vertices, triangles[~selected], np.unique(triangles[selected]))) > 0
    grown = fairing.grown_outline(vertices, triangles, selected)
    assert len(fairing.boundary_loops(triangles[grown.selected])) == len(fairing.boundary_loops(triangles[selected]))


@pytest.mark.parametrize("selected", [[True, False], [1, 0, 1], np.ones(800, dtype=bool)])
def test_a_selection_that_is_none_is_refused(selected: Any) -> None:
    case = ball(0.0)
    if len(selected) == 800:
        selected = np.ones(len(case.triangles), dtype=bool)
    with pytest.raises(ValueError, match="selected"):
        fairing.grown_outline(case.noisy, case.triangles, selected)


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
