"""`fairing.hierarchy`: levels of a progressive mesh by half-edge collapses (§7.4)."""

import numpy as np
import pytest

import blend
import fairing
import measures
import shapes
from test_fixed_curves import make_capsule


@pytest.mark.parametrize("make", ["disk", "blend"])
def test_every_level_has_the_topology_and_the_outline_of_the_mesh(make: str) -> None:
    patch = shapes.cap(2000) if make == "disk" else blend.cylinder_blend(2000)
    for vertices, triangles in fairing.hierarchy(patch.vertices, patch.triangles):
        assert np.isin(patch.fixed, vertices).all()
        assert np.array_equal(np.unique(triangles), vertices)
        assert measures.is_oriented_manifold(triangles)
        assert measures.euler_number(triangles) == measures.euler_number(patch.triangles)


def test_fixed_curves_inside_the_mesh_stay() -> None:
    capsule = make_capsule(500)
    fixed = np.concatenate([capsule.rim, capsule.circle])
    base_vertices, base = fairing.hierarchy(capsule.vertices, capsule.triangles, fixed=fixed)[0]
    assert len(base_vertices) < 0.6 * len(capsule.vertices)
    assert np.isin(fixed, base_vertices).all()
    ends = {tuple(e) for e in measures.edges(base).tolist()}
    on_circle = measures.edges(capsule.triangles)
    on_circle = on_circle[np.isin(on_circle, capsule.circle).all(axis=1)]
    assert {tuple(e) for e in on_circle.tolist()} <= ends
