"""Islands are solved each on its own: the same alone and together."""

import numpy as np

import fairing
import shapes
from bad_inputs import ball_of_meridians, closed_ball
from meshing import IntArray
from shapes import Patch, Style


def alone(patch: Patch, shift: float) -> fairing.FairResult:
    return fairing.fair(
        patch.vertices + shift, patch.triangles,
        fixed=patch.fixed, fixed_normals=patch.fixed_normals, tolerance=1e-10,
    )  # fmt: skip


def test_islands_together_are_the_islands_alone() -> None:
    patches = [shapes.cap(300), shapes.catenoid(400), shapes.clothoid(200, Style(seed=3))]
    shifts = [0.0, 4.0, 11.0]
    offsets = np.cumsum([0] + [len(patch.vertices) for patch in patches])
    together = fairing.fair(
        np.vstack([patch.vertices + s for patch, s in zip(patches, shifts, strict=True)]),
        np.vstack([patch.triangles + o for patch, o in zip(patches, offsets[:-1], strict=True)]),
        fixed=np.concatenate([p.fixed + o for p, o in zip(patches, offsets[:-1], strict=True)]),
        fixed_normals=np.vstack([patch.fixed_normals for patch in patches]),
        tolerance=1e-10,
    )
    results = [alone(patch, shift) for patch, shift in zip(patches, shifts, strict=True)]
    expected = np.vstack([result.vertices for result in results])
    assert np.abs(together.vertices - expected).max() < 1e-9
    assert together.iterations == max(result.iterations for result in results)
    assert together.converged
    assert together.residual == max(result.residual for result in results)


def collapsing(fixed: IntArray) -> fairing.FairResult:
    """A closed sphere that is held by a few of its vertices only."""
    vertices, triangles, _ = closed_ball()
    return fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=vertices[fixed])


def test_a_closed_surface_on_a_face_or_two_points_does_not_count_as_solved() -> None:
    """All of it would lie on that face, inside out, or on the line: the equation holds there, the surface is none."""
    _, triangles, _ = closed_ball()
    edge = np.sort(triangles[0])[:2]
    far = np.array([0, len(closed_ball()[0]) - 1])
    for fixed in (edge, far, np.sort(triangles[0])):
        result = collapsing(fixed)
        codes = [warning.code for warning in result.warnings]
        if "NO_SOLUTION" in codes:  # on Windows another surface stands in over the face, and it is a whole one
            radii = np.linalg.norm(result.vertices, axis=1)
            assert result.equation != "harmonic"
            assert radii.min() > 0.7
            continue
        assert not result.converged, fixed
        assert result.termination == "stalled"
        (text,) = (w.message for w in result.warnings if w.code == "NOT_CONVERGED")
        assert "collapsed" in text or "from behind" in text or "best that were found" in text


def test_a_sphere_that_covers_one_face_from_behind_does_not_count_as_solved() -> None:
    """All but one quad is free, and comes to lie on it, inside out."""
    vertices, triangles = ball_of_meridians(12, 8)
    kept = triangles[:2]
    fixed = np.unique(kept)
    normals = fairing.surrounding_normals(vertices, kept, fixed).normals
    result = fairing.fair(vertices, triangles[2:], fixed=fixed, fixed_normals=normals)
    assert result.boundary_angle.min() > 150
    assert not result.converged
    assert result.termination == "stalled"
    (warning,) = (w for w in result.warnings if w.code == "NOT_CONVERGED")
    assert "from behind at 4 of 4 vertices" in warning.message
    assert warning.figures == {"from_behind": 4, "outline_vertices": 4, "free_vertices": len(warning.elements)}
