"""Curves inside the patch: fixed ones that cut it, creases with a slope for each side, smooth ones; pins."""

import numpy as np
import pytest

import bad_inputs
import creased
import fairing
import shapes
from creased import Creased


def fair(patch: Creased, **options: object) -> fairing.FairResult:
    """From noise of a quarter of an edge, with the exact normals of the sides; on the curve with useless ones."""
    normals = patch.normals.copy()
    normals[patch.curve] = np.random.default_rng(1).normal(size=(len(patch.curve), 3))
    return fairing.fair(
        patch.noisy(0.25), patch.triangles, fixed=patch.fixed, fixed_normals=normals[patch.fixed], **options
    )  # type: ignore[arg-type]


@pytest.mark.parametrize("make", [creased.box_edge, creased.box_corner, creased.lid])
@pytest.mark.parametrize("seed", [1, 2])
def test_both_sides_of_a_crease_come_back(make: object, seed: int) -> None:
    """A box edge, a box corner, the rim of a lid: to roundoff; averaged normals bulge, as the next test shows."""
    patch = make(7, seed)  # type: ignore[operator]
    result = fair(patch, creases=patch.curve)
    assert result.converged
    assert result.equation == "least_variation"
    assert patch.error(result.vertices) < 1e-9
    assert not {"SHARP_BOUNDARY", "PIN_NORMAL_IGNORED", "NO_SOLUTION"} & {reported.code for reported in result.warnings}
    assert (result.boundary_angle[np.isin(result.fixed, patch.curve)] == 0).all()


def lifted_line(n: int) -> tuple[Creased, fairing.FairResult]:
    """A flat square; a line that ends inside is lifted, and the surface runs through it."""
    plane = creased.box_edge(n)
    flat = np.column_stack([plane.vertices[:, 0] - plane.vertices[:, 2], plane.vertices[:, 1]])
    vertices = np.column_stack([flat, np.zeros(len(flat))])
    on_line = (np.abs(flat[:, 0]) < 1e-9) & (np.abs(flat[:, 1] - 0.5) < 0.26)
    vertices[on_line, 2] = 0.1
    fixed = np.union1d(plane.boundary, np.flatnonzero(on_line))
    normals = np.tile([0.0, 0.0, 1.0], (len(fixed), 1))
    result = fairing.fair(
        vertices, plane.triangles, fixed=fixed, fixed_normals=normals, smooth_curves=np.flatnonzero(on_line)
    )
    return plane, result


def turn_across(n: int) -> float:
    """The angle in radians by which the surface turns across the middle of the lifted line."""
    _, result = lifted_line(n)
    faces = result.vertices[creased.box_edge(n).triangles]
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    centres = faces.mean(axis=1)
    beside = (np.abs(centres[:, 1] - 0.5) < 0.15) & (np.abs(centres[:, 0]) < 1.0 / n)
    left, right = (normals[beside & (np.sign(centres[:, 0]) == side)].mean(axis=0) for side in (-1.0, 1.0))
    return float(np.arccos(np.clip(left @ right / np.linalg.norm(left) / np.linalg.norm(right), -1.0, 1.0)))


def test_a_smooth_curve_is_no_kink() -> None:
    """Across the line the surface turns by its curvature times the edges: half as much on a mesh twice as fine."""
    assert turn_across(24) < 0.65 * turn_across(12)


def test_a_loop_of_creases_is_a_soap_film() -> None:
    """Over a bent rim with nothing else: H = 0, although spheres and saddles vary as little."""
    disc = creased.lid(6)
    top = (disc.side[disc.triangles] == 0).all(axis=1) & (disc.vertices[disc.triangles][:, :, 2] == 0).all(axis=1)
    triangles = disc.triangles[top]
    vertices = disc.vertices[: triangles.max() + 1].copy()
    rim = disc.curve
    angle = np.arctan2(vertices[rim, 1], vertices[rim, 0])
    vertices[rim, 2] = 0.1 * np.cos(2 * angle)
    result = fairing.fair(vertices, triangles, fixed=rim, creases=rim)
    film = fairing.fair(vertices, triangles, fixed=rim, equation="soap_film")
    assert result.converged
    assert result.equation == "soap_film"
    assert np.abs(result.vertices - film.vertices).max() < 1e-3
    assert 0.05 < np.ptp(result.vertices[:, 2]) < 0.21


def test_slopes_have_to_be_those_of_fixed_vertices() -> None:
    patch = creased.box_edge(4)
    given = {"fixed": patch.fixed, "fixed_normals": patch.normals[patch.fixed]}
    with pytest.raises(ValueError, match=f"creases names vertex {patch.free[0]}, which is not fixed"):
        fairing.fair(patch.vertices, patch.triangles, **given, creases=patch.free[:1])
    with pytest.raises(ValueError, match="is named by creases and by smooth_curves"):
        fairing.fair(patch.vertices, patch.triangles, **given, creases=patch.curve[1:2], smooth_curves=patch.curve[1:2])
    with pytest.raises(fairing.MeshError, match="smooth_curves names vertex 999999") as reported:
        fairing.fair(patch.vertices, patch.triangles, **given, smooth_curves=[999999])
    assert reported.value.code == "INDEX_RANGE"
    with pytest.raises(ValueError, match="creases: not accepted by method 'paper'"):
        fairing.fair(patch.vertices, patch.triangles, **given, creases=patch.curve, method="paper")


def test_the_interior_given_does_not_matter() -> None:
    patch = creased.lid(5)
    first, second = (
        fairing.fair(
            patch.noisy(0.3, seed), patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals[patch.fixed],
            creases=patch.curve,
        ).vertices
        for seed in (1, 2)
    )  # fmt: skip
    assert np.array_equal(first, second)


def test_fits_beside_a_crease_look_at_their_own_side() -> None:
    """Normals beside a box edge that goes on outside: exact. An edge that bends too little to be hard must be named."""
    box = creased.box_edge(8)
    rows = np.flatnonzero(box.vertices[:, 1] < 1e-9)
    beside = rows[(np.abs(box.vertices[rows]).sum(axis=1) > 1e-9) & (np.abs(box.vertices[rows]).sum(axis=1) < 0.3)]
    edges = np.column_stack([box.curve[:-1], box.curve[1:]])
    order = np.argsort(box.vertices[box.curve, 1])
    edges = np.column_stack([box.curve[order][:-1], box.curve[order][1:]])
    found = fairing.surrounding_normals(box.vertices, box.triangles, beside).normals
    assert np.abs(found - box.normals[beside]).max() < 1e-9
    weak = np.column_stack([box.vertices[:, 0] - box.vertices[:, 2], box.vertices[:, 1], 0.36 * box.vertices[:, 2]])
    expected = np.where((weak[beside, 0] < 0)[:, None], [0.0, 0.0, 1.0], np.array([0.36, 0.0, 1.0]) / np.hypot(0.36, 1))
    broken = fairing.surrounding_normals(weak, box.triangles, beside, creases=edges).normals
    whole = fairing.surrounding_normals(weak, box.triangles, beside).normals
    assert np.abs(broken - expected).max() < 1e-9
    assert np.abs(whole - expected).max() > 0.05


def within(patch: Creased, near: np.ndarray) -> dict[str, np.ndarray]:  # type: ignore[type-arg]
    """The triangles chosen as a patch, its surroundings, and what holds it."""
    inside, outside = patch.triangles[near], patch.triangles[~near]
    used = np.unique(inside)
    fixed = np.union1d(np.intersect1d(used, patch.fixed), np.intersect1d(used, outside))
    return {
        "triangles": inside, "fixed": fixed, "fixed_normals": patch.normals[fixed], "outside": outside,
        "creases": np.intersect1d(patch.curve, used),
    }  # fmt: skip


def test_a_fitted_boundary_does_not_follow_creases_outside() -> None:
    """Refused where a crease runs into the boundary, beyond which triangles stand; the rim of a lid is whole inside."""
    box = creased.box_edge(8)
    middle = within(box, np.abs(box.vertices[box.triangles].mean(axis=1)[:, 1] - 0.5) < 0.3)
    with pytest.raises(ValueError, match="outline: 'mended' would round creases outside; 3 of `creases` lie on"):
        fairing.fair(box.noisy(0.1), outline="mended", **middle)
    lid = creased.lid(6)
    upper = within(lid, lid.vertices[lid.triangles].mean(axis=1)[:, 2] > -0.45)
    given, fitted = (fairing.fair(lid.noisy(0.04), outline=how, **upper) for how in ("given", "mended"))
    assert given.converged
    assert fitted.converged
    assert len(fitted.moved) > 0
    assert lid.error(fitted.vertices) < 0.9 * lid.error(given.vertices)


# Fixed curves inside a mesh cut it: one H per side. Pins hold a position, not a normal.


def test_sphere_from_its_equator() -> None:
    """A closed mesh with one fixed circle: two hemispheres, each as alone.

    Without the cut a tilt that is odd across the circle cancels in H: off by 4e-3.
    """
    vertices, triangles, equator = bad_inputs.closed_ball(500)
    start = shapes.membrane(vertices, triangles, equator)
    result = fairing.fair(start, triangles, fixed=equator, fixed_normals=vertices[equator], tolerance=1e-10)
    assert result.converged
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 2e-6
    assert np.abs(result.mean_curvature + 1).max() < 1e-4
    assert (np.linalg.norm(result.vertices - start, axis=1) > 0.5).any()


def test_pins_hold_their_position_without_a_dent() -> None:
    """On the exact surface a pin changes nothing; its normal is ignored, with a warning."""
    patch = shapes.cap(500)
    pins = patch.free[[3, 200]]
    fixed = np.concatenate([patch.fixed, pins])
    normals = np.vstack([patch.fixed_normals, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
    result = fairing.fair(patch.vertices, patch.triangles, fixed=fixed, fixed_normals=normals, tolerance=1e-10)
    assert np.array_equal(result.vertices[pins], patch.vertices[pins])
    assert patch.error(result.vertices) < 1e-5
    warning = next(w for w in result.warnings if w.code == "PIN_NORMAL_IGNORED")
    assert set(np.ravel(warning.elements)) == set(pins)
    assert (result.boundary_angle[-2:] == 0).all()
