"""Large patches begin on coarser levels of their own connectivity: faster, and the same surface."""

import numpy as np
import pytest

import fairing
import shapes
import solids
from shapes import Patch, Style
from solving import fair_patch

PATCHES = {
    "hemisphere": lambda: shapes.cap(5000),
    "catenoid": lambda: shapes.catenoid(5000),
    "pipe": lambda: shapes.cylinder(4000, Style(seed=2)),
    "clothoid cylinder": lambda: shapes.clothoid(4000),
}


def faired(patch: Patch) -> fairing.FairResult:
    """With uniform weights, as it comes."""
    return fairing.fair(patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)


@pytest.mark.parametrize("name", PATCHES)
def test_levels_change_the_way_and_not_the_surface(name: str) -> None:
    """Both solve one discrete equation to 1e-10, so they end within some 1e-9 D of each other."""
    patch: Patch = PATCHES[name]()
    nested = fair_patch(patch, tolerance=1e-10)
    plain = fair_patch(patch, tolerance=1e-10, levels=1)
    assert nested.converged
    assert plain.converged
    assert len(nested.levels) > 1
    assert list(nested.levels) == sorted(nested.levels)
    assert nested.levels[-1] == len(patch.vertices)
    assert plain.levels == (len(patch.vertices),)
    assert np.abs(nested.vertices - plain.vertices).max() <= 1e-8 * patch.diameter


@pytest.mark.parametrize("seed", range(6))
def test_deep_caps_of_few_vertices_are_spheres(seed: int) -> None:
    """A coarse level of some hundred vertices has no surface there."""
    cap = shapes.cap(1300, Style(seed=seed), half_angle=130.0)
    result = faired(cap)
    assert result.converged
    assert cap.error(result.vertices) < 1e-5


def test_the_split_operator_leads_to_the_same_sphere() -> None:
    """Beyond 15,000 free vertices K is inverted to parts in a thousand: the iteration ends where the equation does."""
    patch = shapes.cap(18_000)
    result = fair_patch(patch, tolerance=1e-11)
    assert result.converged
    assert len(result.levels) > 1
    assert result.iterations <= 14
    assert patch.error(result.vertices) <= 1e-8
    again = fair_patch(patch, tolerance=1e-11, threads=1)
    assert np.array_equal(again.vertices, result.vertices)


@pytest.mark.parametrize("quads", [30, 44, 60])
def test_extraordinary_vertices_are_passed(quads: int) -> None:
    """Next to a cube's corners vertices move over several edges from one level to the next, within the surface."""
    vertices, triangles, fixed = solids.cube_cap(quads)
    start = np.zeros_like(vertices)
    start[fixed] = vertices[fixed]
    result = fairing.fair(start, triangles, fixed=fixed, fixed_normals=vertices[fixed], tolerance=1e-10)
    assert result.converged
    assert len(result.levels) > 1
    assert result.iterations <= 16
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max() <= 1e-8
