"""`bulge`: a load by each component's own outline, 8 bulge / a³; and which triangles form a component."""

from typing import Any

import numpy as np
import pytest

import fairing
import shapes
from curves import FloatArray
from shapes import Patch

TIGHT = 1e-10


def solved(patch: Patch, scale: float = 1.0, **options: Any) -> fairing.FairResult:
    settings: dict[str, Any] = {"equation": "constant", "tolerance": TIGHT, **options}
    return fairing.fair(
        scale * patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, **settings
    )


def radius(points: FloatArray) -> float:
    """Root mean square distance from the centroid."""
    return float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))


@pytest.mark.parametrize("scale", [1.0, 1e-3, 250.0])
@pytest.mark.parametrize("method", ["global", "paper"])
def test_it_is_the_load_of_the_outlines_radius(scale: float, method: str) -> None:
    patch = shapes.cap(150, half_angle=60.0)
    load = 8 * 0.15 / radius(scale * patch.vertices[patch.fixed]) ** 3
    by_hand, measured = solved(patch, scale, load=load, method=method), solved(patch, scale, bulge=0.15, method=method)
    assert measured.converged
    assert np.abs(measured.vertices - by_hand.vertices).max() < 1e-9 * scale
    assert np.abs(measured.vertices - solved(patch, scale, method=method).vertices).max() > 1e-2 * scale


def test_components_of_different_size_are_lifted_by_the_same_share() -> None:
    """Two flat discs, one ten times as large, side by side: the height is the same share of the radius."""
    disc = shapes.cap(200, half_angle=0.01)
    count, sizes = len(disc.vertices), (1.0, 10.0)
    unit = (disc.vertices - disc.vertices[disc.fixed].mean(axis=0)) / radius(disc.vertices[disc.fixed])
    both = fairing.fair(
        np.vstack([size * unit + [30.0 * size, 0.0, 0.0] for size in sizes]),
        np.vstack([disc.triangles, disc.triangles + count]),
        fixed=np.concatenate([disc.fixed, disc.fixed + count]),
        fixed_normals=np.vstack([disc.fixed_normals, disc.fixed_normals]),
        equation="constant", bulge=0.5, tolerance=TIGHT,
    )  # fmt: skip
    small, large = (
        (both.vertices[k * count : (k + 1) * count] - [30.0 * size, 0.0, 0.0]) / size for k, size in enumerate(sizes)
    )
    assert both.converged
    assert np.abs(small - large).max() < 1e-8
    heights = (small - unit) @ disc.fixed_normals.mean(axis=0)
    # The biharmonic plate would be lifted by bulge / 4; what is lifted that far bends a little less or more.
    assert heights.max() == pytest.approx(0.5 / 4, rel=0.1)
