"""`Boundary.continuity`: position, tangent plane and curvature met on parts of the boundary."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import curves
import fairing
import shapes
from domains import Domain, Style
from rough_sphere import rough_sphere
from surfaces import Revolution

Mask = Callable[[Any], Any]


def faired(patch: shapes.Patch, kinds: Any, **more: Any) -> fairing.FairResult:
    """From a membrane, with the exact normals where they count and wrong ones elsewhere."""
    normals = patch.fixed_normals.copy()
    normals[np.asarray(kinds) == "G0"] = [0.6, 0.0, 0.8]
    held = fairing.Boundary(patch.fixed, normals, continuity=kinds, **more)
    return fairing.fair(shapes.start_from_nothing(patch), patch.triangles, held)


def quarter(n_free: int, style: Style) -> shapes.Patch:
    """Of a cylinder of radius 1, its straight sides along z."""
    return shapes.on_domain(
        Domain(Revolution(curves.Line(-1.0, 1.0, 1.0), -1), "rectangle", 0.0, np.pi / 2), n_free, style
    )


CLOSED: dict[str, tuple[Callable[..., shapes.Patch], Mask]] = {
    "hemisphere, half of its rim": (shapes.cap, lambda p: p[:, 0] < 0),
    "hemisphere, nearly all of its rim": (shapes.cap, lambda p: p[:, 0] < 0.8),
    "cylinder's part, a straight side": (
        lambda n, style: shapes.cylinder(n, style, shape="rectangle"), lambda p: p[:, 0] < p[:, 0].min() + 1e-6,
    ),
    "cylinder's quarter, all but a straight side": (quarter, lambda p: p[:, 1] > 1e-6),
    "tube, one end": (shapes.cylinder, lambda p: p[:, 2] < p[:, 2].min() + 1e-6),
    "flat strip, one side": (
        lambda n, style: shapes.plane(n, style, shape="rectangle"), lambda p: p[:, 2] < p[:, 2].min() + 1e-6,
    ),
}  # fmt: skip


@pytest.mark.parametrize("seed", [3, 4])
@pytest.mark.parametrize("name", CLOSED)
def test_position_on_a_part_and_tangent_on_the_rest_keep_spheres_cylinders_and_planes(name: str, seed: int) -> None:
    """They meet the natural conditions at a free slope, and are met exactly."""
    make, where = CLOSED[name]
    patch = make(400, Style(jitter=0.6, seed=seed))
    kinds = np.where(where(patch.vertices[patch.fixed]), "G0", "G1")
    assert 0 < (kinds == "G0").sum() < len(kinds)
    result = faired(patch, kinds)
    assert result.converged and result.equation == "least_variation"
    assert patch.error(result.vertices) < 1e-9


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
@pytest.mark.parametrize("seed", range(4))
def test_a_ball_comes_back_over_a_jagged_boundary(seed: int, share: float) -> None:
    """What the slopes given ask for is carried on to the others at the start: a disc's slopes lead elsewhere."""
    ball = rough_sphere(900, noise=0.0, seed=seed, swelling=0.0)
    places = ball.exact[ball.boundary]
    kinds = np.where(places[:, 0] < np.quantile(places[:, 0], share), "G0", "G1")
    result = fairing.fair(ball.exact, ball.inside, fairing.Boundary(ball.boundary, places, continuity=kinds))
    assert result.converged and result.equation == "least_variation"
    assert np.abs(ball.heights(result.vertices, ball.free)).max() < 1e-6


def test_a_part_that_is_tangent_as_asked_is_no_reason_to_warn() -> None:
    """Where it is asked for and not known it is."""
    patch = shapes.torus(500)
    curvatures = patch.mean_curvature[patch.fixed]
    x = patch.vertices[patch.fixed][:, 0]
    kinds = np.where(x <= np.median(x), "G2", "G1")
    result = faired(patch, kinds, curvatures=curvatures)
    assert result.continuity == "G2" and not result.warnings
    asked = np.flatnonzero(kinds == "G2")
    unknown = asked[np.argsort(x[asked])[: len(asked) // 2]]
    curvatures[unknown] = np.nan
    (warning,) = faired(patch, kinds, curvatures=curvatures).warnings
    assert warning.code == "G2_NOT_MET"
    assert set(patch.fixed[unknown]) <= set(warning.elements) < set(patch.fixed[asked])  # with arcs too short for waves


def test_what_contradicts_is_refused_with_a_word_on_what_is_needed() -> None:
    patch = shapes.cap(100)
    count = len(patch.fixed)
    mixed = ["G0"] * (count - 1) + ["G2"]
    wrong: list[tuple[Any, str]] = [
        (["G1"] * (count - 1), "shape"), (["G3"] * count, "G3"), (mixed, "G0.*G2"), ("G1", "shape"),
    ]  # fmt: skip
    for kinds, word in wrong:
        with pytest.raises(ValueError, match=word):
            fairing.fair(patch.vertices, patch.triangles, fairing.Boundary(patch.fixed, None, continuity=kinds))
    with pytest.raises(ValueError, match="vertices"):
        fairing.fair(patch.vertices, patch.triangles, fairing.Boundary(continuity=["G1"] * count))
    curved = fairing.Boundary(
        patch.fixed, patch.fixed_normals, continuity=["G1", "G2"] * (count // 2) + ["G1"] * (count % 2)
    )
    with pytest.raises(ValueError, match="curvatures"):
        fairing.remesh(patch.vertices, patch.triangles, curved)
