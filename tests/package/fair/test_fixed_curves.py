"""Fixed curves inside a mesh cut it: one H per side. Pins hold a position, not a normal."""

from dataclasses import dataclass

import numpy as np

import bad_inputs
import fairing
import shapes
from curves import FloatArray
from meshing import IntArray


@dataclass(frozen=True)
class Capsule:
    """A unit hemisphere on a unit cylinder of length 1, joined at the circle z = 0."""

    vertices: FloatArray
    triangles: IntArray
    rim: IntArray
    circle: IntArray
    above: IntArray
    below: IntArray


def make_capsule(n_free: int) -> Capsule:
    cap = shapes.cap(n_free)
    tube = next(
        tube
        for extra in range(-n_free // 4, n_free // 2)
        if len((tube := shapes.cylinder(n_free + extra, length=1.0)).fixed) == 2 * len(cap.fixed)
    )
    top = tube.fixed[tube.vertices[tube.fixed, 2] > 0]
    rim = tube.fixed[tube.vertices[tube.fixed, 2] < 0]
    start = np.arctan2(tube.vertices[top[0], 1], tube.vertices[top[0], 0])
    spin = np.array([[np.cos(start), -np.sin(start)], [np.sin(start), np.cos(start)]])
    lower = tube.vertices - np.array([0.0, 0.0, 0.5])
    lower[:, :2] = lower[:, :2] @ spin
    index = np.full(len(lower), -1)
    rest = np.concatenate([tube.free, rim])
    index[rest] = len(cap.vertices) + np.arange(len(rest))
    index[top] = cap.fixed
    assert np.abs(lower[top] - cap.vertices[cap.fixed]).max() < 1e-9
    return Capsule(
        np.vstack([cap.vertices, lower[rest]]), np.vstack([cap.triangles, index[tube.triangles]]),
        index[rim], cap.fixed, cap.free, index[tube.free],
    )  # fmt: skip


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


def test_each_side_of_a_circle_has_its_own_curvature() -> None:
    """Capsule: H = −1 above and −1/2 below, their mean on the circle."""
    capsule = make_capsule(500)
    fixed = np.concatenate([capsule.rim, capsule.circle])
    normals = capsule.vertices[fixed] * np.array([1.0, 1.0, 0.0])
    start = shapes.membrane(capsule.vertices, capsule.triangles, fixed)
    result = fairing.fair(start, capsule.triangles, fixed=fixed, fixed_normals=normals, tolerance=1e-10)
    assert result.converged
    sphere = np.linalg.norm(result.vertices[capsule.above], axis=1)
    cylinder = np.linalg.norm(result.vertices[capsule.below, :2], axis=1)
    assert np.abs(sphere - 1).max() < 4e-6
    assert np.abs(cylinder - 1).max() < 2e-5
    assert np.abs(result.mean_curvature[capsule.above] + 1).max() < 1e-3
    assert np.abs(result.mean_curvature[capsule.below] + 0.5).max() < 1e-2
    assert np.abs(result.mean_curvature[capsule.circle] + 0.75).max() < 1e-2
    assert result.boundary_angle.max() < 0.3


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
