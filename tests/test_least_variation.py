"""equation="least_variation": the surface whose normal curvatures vary least."""

from __future__ import annotations

import numpy as np
import pytest

import fairing
import joints
import measures
import profiles
import shapes
import tubes
from joints import Arm, flat_arm
from shapes import Patch, Style
from tubes import radii


def faired(patch: Patch, **options: object) -> fairing.FairResult:
    """A patch from its outline alone."""
    return fairing.fair(
        shapes.start_from_nothing(patch), patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        equation="least_variation", **options,
    )  # type: ignore[arg-type]  # fmt: skip


@pytest.mark.parametrize("family", ["hemisphere", "short_cylinder", "cylinder", "cylinder_patch", "plane"])
def test_surfaces_without_variation_are_exact_on_irregular_meshes(family: str) -> None:
    patch = shapes.FAMILIES[family](400, Style(jitter=0.8, seed=2))
    result = faired(patch)
    assert result.converged
    assert patch.error(result.vertices) < 1e-6


@pytest.mark.parametrize(("length", "lean"), [(3.0, 10.0), (5.0, 5.0), (5.0, -10.0), (10.0, 10.0), (10.0, -10.0)])
def test_pipes_with_leaning_ends_keep_their_radius(length: float, lean: float) -> None:
    result = tubes.pipe(length, lean, seed=1).faired()
    assert result.converged
    assert not result.warnings
    assert 0.8 < radii(result).min() <= radii(result).max() < 1.2


def test_the_error_against_the_profile_of_one_dimension_falls_with_the_mesh() -> None:
    exact = profiles.least(profiles.Ends(1.0, 1.0, 5.0, 10.0)).r.min()

    def error(around: int) -> float:
        """The mean of three meshes."""
        pipes = [tubes.pipe(5.0, 10.0, around=around, seed=seed).faired() for seed in (1, 2, 3)]
        return float(np.mean([abs(radii(result).min() - exact) for result in pipes]))

    coarse, fine = error(12), error(32)  # 4.0e-3 and 4e-4; inside, fine ones are solved on 24 edges around
    assert fine < 2e-3
    assert fine < 0.5 * coarse


def test_elbows_are_almost_tori() -> None:
    for bend in (2.0, 3.0):
        result = tubes.elbow(bend, 90.0, seed=2).faired()
        assert result.converged
        assert not result.warnings
        assert tubes.off_torus(result.vertices, bend) < 0.05


def test_a_taper_has_no_bulge() -> None:
    result = tubes.pipe(5.0, radii=(1.0, 0.5), seed=4).faired()
    assert result.converged
    assert radii(result).max() < 1.0 + 1e-9
    assert radii(result).min() > 0.5 - 1e-9


def test_elbows_of_irregular_meshes_agree() -> None:
    """What the chords of the vertices' own triangles differ by is left out: up to 0.4 % of D."""
    for bend, degrees in ((2.0, 90.0), (3.0, 120.0)):
        made = [tubes.elbow(bend, degrees, seed=seed) for seed in (1, 2)]
        first, second = (tube.faired().vertices for tube in made)
        assert tubes.apart(made[0], first, second, bend) < 0.003 * made[0].diameter


JOINTS = {
    "unequal": [flat_arm(0), flat_arm(120, 0.7), flat_arm(240, 0.5)],
    "T": [flat_arm(0), flat_arm(180), flat_arm(90, 0.5, 2.5)],
    "Y": [flat_arm(180), flat_arm(35, 0.8, 4.0), flat_arm(-35, 0.5, 4.0)],
    "corner": [Arm((1, 0, 0)), Arm((0, 1, 0), 0.7), Arm((0, 0, 1), 0.5)],
    "leaning": [flat_arm(0, 1.0, 3.0, 8.0), flat_arm(120, 0.7, 3.0, -8.0), flat_arm(240, 0.5, 3.0, 5.0)],
}


@pytest.mark.parametrize("name", JOINTS)
def test_tubes_of_unequal_radii_are_joined(name: str) -> None:
    joint = joints.joint(JOINTS[name], seed=1)
    result = joint.faired()
    assert result.converged
    assert {warning.code for warning in result.warnings} <= {"SHARP_BOUNDARY"}  # arms of twelve edges around
    assert len(fairing.self_intersections(result.vertices, joint.triangles)) == 0


def test_joints_of_irregular_meshes_agree() -> None:
    made = [joints.joint(JOINTS["unequal"], around=36, seed=seed) for seed in (1, 2)]
    first, second = ((tube.faired().vertices, tube.triangles) for tube in made)
    assert measures.two_sided_distance(first, second) < 0.003 * made[0].diameter


def test_two_arms_in_line_are_a_cylinder() -> None:
    tube = joints.joint([flat_arm(0), flat_arm(180)], seed=1)
    result = tube.faired()
    assert result.converged
    assert np.abs(np.hypot(result.vertices[:, 1], result.vertices[:, 2]) - 1).max() < 1e-6


def test_the_interior_given_is_not_looked_at() -> None:
    tube = tubes.pipe(4.0, 5.0, seed=3)
    first = tube.faired().vertices
    for options in ({"seed": 1}, {"seed": 2}):
        assert (tube.faired(**options).vertices == first).all()


def test_moved_turned_and_scaled_outlines_give_the_same_surface() -> None:
    """As nearly as two meshes: roundoff decides some of the engine's own flips and collapses."""
    tube = tubes.elbow(3.0, 60.0, seed=2)
    turn, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    moved = tubes.Tube(7 * tube.vertices @ turn.T + 3, tube.triangles, tube.fixed, tube.normals @ turn.T)
    back = (moved.faired().vertices - 3) @ turn / 7
    assert np.abs(back - tube.faired().vertices).max() < 2e-3 * tube.diameter


def test_the_published_method_does_not_have_it() -> None:
    with pytest.raises(ValueError, match="least_variation"):
        tubes.pipe(3.0).faired(method="paper")


def test_an_outline_that_makes_no_sense_is_reported_not_refused() -> None:
    """Normals that point to and fro on a flat tube of seven columns: the energy of coarse meshes is NaN there."""
    tube = tubes.pipe(2.0, seed=3, around=7)
    flat = np.array([1.0, 0.05, 1.0])
    normals = tube.normals / flat * np.where(np.arange(len(tube.fixed)) % 2 == 0, 1, -1)[:, None]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    result = tubes.Tube(tube.vertices * flat, tube.triangles, tube.fixed, normals).faired()
    assert not result.converged
    assert np.isfinite(result.vertices).all()


def test_the_fill_and_the_placement_share_a_factor() -> None:
    stages: list[str] = []
    faired(shapes.cylinder(300, Style(seed=1)), threads=1, progress=lambda _, stage: stages.append(stage) is None)
    assert stages.count("the inner-fairness weights") == 1
