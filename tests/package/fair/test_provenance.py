"""Where a surface comes from, and the one that is shown first."""

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
import tubes
from shapes import Style
from test_low_passed import rough_cap
from test_otherwise import wing

Case = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]  # vertices, triangles, fixed, normals


def of_patch(patch: shapes.Patch, **options: Any) -> Case:
    return patch.vertices, patch.triangles, patch.fixed, patch.fixed_normals, options


def of_tube(tube: tubes.Tube, **options: Any) -> Case:
    return tube.vertices, tube.triangles, tube.fixed, tube.normals, options


def scattered(tube: tubes.Tube) -> tubes.Tube:
    """No shape before that could be smoothed."""
    inside = np.setdiff1d(np.arange(len(tube.vertices)), tube.fixed)
    tube.vertices[inside] *= np.random.default_rng(0).uniform(-1.0, 1.0, (len(inside), 3))
    return tube


ORIGINS: dict[str, Callable[[], Case]] = {
    "equation": lambda: of_patch(shapes.cap(400)),
    "low_passed": lambda: of_patch(rough_cap(0.8, 1.0, 0)),
    "least_variation": lambda: of_tube(tubes.pipe(5.0, 5.0, seed=3)),
    "loft": lambda: of_tube(scattered(wing())),
    "old_shape": lambda: of_tube(tubes.pipe(8.0), start="smoothed"),
    "first_surface": lambda: of_tube(tubes.pipe(5.0, 5.0, seed=3), start="kept"),
}


def pinned(case: Case) -> Case:
    """The highest vertex inside is held: on the unit sphere of the caps, on a tube where it lies."""
    vertices, triangles, fixed, normals, options = case
    free = np.setdiff1d(np.unique(triangles), fixed)
    pin = free[np.argmax(vertices[free, 2] - vertices[fixed, 2].max())]
    moved = vertices.copy()
    if np.ptp(vertices[fixed, 2]) < 0.5:
        moved[pin] = [0.0, 0.0, 1.0]
    return moved, triangles, np.append(fixed, pin), np.vstack([normals, [0.0, 0.0, 1.0]]), options


def solve(case: Case, weights: str, continuity: str, detail: float) -> fairing.FairResult:
    vertices, triangles, fixed, normals, options = case
    if continuity == "G2":
        options = {**options, "fixed_curvatures": np.full(len(fixed), -1.0)}
    return fairing.fair(
        vertices, triangles, fixed=fixed, fixed_normals=normals, inner_fairness=weights, continuity=continuity,
        detail=detail, threads=1, **options,
    )  # fmt: skip


@pytest.mark.parametrize("origin", ORIGINS)
def test_every_origin_is_reported_with_every_option(origin: str) -> None:
    for pin, weights, continuity, detail in itertools.product(
        (False, True), ("uniform", "conformal"), ("G1", "G2"), (0.0, 0.5)
    ):
        case = ORIGINS[origin]()
        result = solve(pinned(case) if pin else case, weights, continuity, detail)
        combination = (pin, weights, continuity, detail)
        found = {warning.code: warning.figures for warning in result.warnings}
        if not result.converged:  # a pin may leave nothing that fits
            assert pin and "NOT_CONVERGED" in found, combination
            continue
        assert pin or result.provenance == origin, combination
        assert ("NO_SOLUTION" in found) == (result.provenance != "equation"), combination
        figures = found.get("NO_SOLUTION", {})
        words = {"distance": "low_passed", "loft": "loft", "smoothed": "old_shape", "bilaplacian": "first_surface"}
        assert all((word in figures) == (result.provenance == kind) for word, kind in words.items()), combination


def test_a_pin_does_not_hide_that_the_surface_lies_beside_its_boundary() -> None:
    """The log of what was tried ends with the pins then: it is no evidence."""
    case = of_patch(rough_cap(0.8, 1.0, 0))
    plain = solve(case, "uniform", "G1", 0.0)
    result = solve(pinned(case), "uniform", "G1", 0.0)
    for each in (plain, result):
        assert each.provenance == "low_passed"
        (warning,) = [warning for warning in each.warnings if warning.code == "NO_SOLUTION"]
        assert warning.figures["distance"] == pytest.approx(0.0383, abs=1e-3)


# The surface that every run begins with: always there, finite, between its boundary, near the one that follows.
def shown_and_found(vertices, triangles, **options):  # type: ignore[no-untyped-def]
    """The first surface and the result; it is shown once, before the result is there."""
    shown: list[np.ndarray] = []
    result = fairing.fair(vertices, triangles, preview=shown.append, **options)
    assert len(shown) == 1
    return shown[0], result


@pytest.mark.parametrize("make", [shapes.cap, shapes.cylinder, shapes.catenoid])
@pytest.mark.parametrize("size", [300, 3000])
def test_the_first_surface_is_near_the_fair_one(make, size: int) -> None:  # type: ignore[no-untyped-def]
    """Half a sphere, a pipe and a catenoid: 2 % of D off at most, where linear fills are 5 to 25 % off."""
    patch = make(size, style=Style(seed=5))
    start = shapes.membrane(patch.vertices, patch.triangles, patch.fixed)
    before = start.copy()
    first, result = shown_and_found(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
    boundary = start[patch.fixed]
    diameter = 2 * np.linalg.norm(boundary - boundary.mean(axis=0), axis=1).max()
    assert np.abs(patch.surface.distance(first)).max() < 0.02 * diameter
    assert np.array_equal(first[patch.fixed], start[patch.fixed])
    assert np.array_equal(start, before)
    without = fairing.fair(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
    assert np.array_equal(result.vertices, without.vertices)  # to look changes nothing


def test_a_limb_is_not_drawn_to_a_thread() -> None:
    """A rough pipe of eight radii: the fill between its ends has a waist, the old shape low-passed has not."""
    pipe = tubes.pipe(8.0)
    rng = np.random.default_rng(4)
    inside = np.setdiff1d(np.arange(len(pipe.vertices)), pipe.fixed)
    rough = pipe.vertices.copy()
    rough[inside] += rng.normal(scale=0.02, size=(len(inside), 3))
    first, _ = shown_and_found(rough, pipe.triangles, fixed=pipe.fixed, fixed_normals=pipe.normals, otherwise="stop")
    girth = fairing.looks.girth(first, pipe.triangles, fixed=pipe.fixed)
    assert girth is not None
    assert girth.least > fairing.looks.LIMITS["waist"]


def test_what_the_receiver_raises_comes_out() -> None:
    """And ends the run: a caller that wants the first surface alone needs no search."""

    class Enough(Exception):
        pass

    def receive(vertices: np.ndarray) -> None:
        raise Enough

    patch = shapes.cap(400, style=Style(seed=5))
    with pytest.raises(Enough):
        fairing.fair(patch.vertices, patch.triangles, fixed=patch.fixed, preview=receive)
