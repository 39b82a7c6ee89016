"""*Tension*: how far in a surface carries the slopes of the selection's boundary."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

import meshes
from extension import give_options, module
from test_position_group import put


def cap() -> tuple[bpy.types.Object, meshes.Mask, meshes.Mask]:
    """A ball of radius 1, its upper third selected, and the free vertices there, which are rough."""
    obj = meshes.sphere(64)
    faces = meshes.faces_where(obj, lambda c: c.z > 0.35)
    free = meshes.free_vertices(obj, faces)
    points = meshes.positions(obj)
    points[free] *= 1.0 + 0.01 * np.random.default_rng(3).normal(size=(free.sum(), 1))
    meshes.move(obj, points)
    return obj, faces, free


def faired(weights: float | None = None, **options: object) -> tuple[meshes.Floats, meshes.Floats]:
    """How high above the ball the free vertices end, and where; weights: of the vertices with x > 0 in the group."""
    obj, faces, free = cap()
    if weights is not None:
        put(obj, meshes.positions(obj)[:, 0] > 0.0, weights)
    assert meshes.fair(obj, faces, **options) == {"FINISHED"}
    points = meshes.positions(obj)[free]
    return np.linalg.norm(points, axis=1) - 1.0, points


def test_the_cap_is_fuller_with_more_of_it_and_flatter_with_less() -> None:
    low, ball, high = (faired(tension=tension)[0] for tension in (0.5, 1.0, 2.0))
    assert np.abs(ball).max() < 1e-3
    assert low.mean() < -0.05 and high.mean() > 0.05
    assert (meshes.report().verdict, meshes.report().warnings) == ("GOOD", "")


def test_one_is_what_it_was() -> None:
    np.testing.assert_array_equal(faired(tension=1.0)[1], faired()[1])


def test_it_acts_where_the_boundary_is_in_the_group_by_the_weights() -> None:
    """Half the weight is the square root, and none leaves the ball."""
    everywhere, _ = faired(tension=2.0)
    side, points = faired(1.0, tension=2.0, tension_group="Loose")
    right, left = points[:, 0] > 0.4, points[:, 0] < -0.4
    assert side[right].mean() > 2.0 * side[left].mean() and side[right].mean() > 0.4 * everywhere.mean()
    half, _ = faired(0.5, tension=4.0, tension_group="Loose")
    np.testing.assert_allclose(half, side, atol=1e-6)
    none, _ = faired(0.0, tension=2.0, tension_group="Loose")
    assert np.abs(none).max() < 1e-3


def test_a_new_mesh_has_it_too() -> None:
    obj, faces, _ = cap()
    assert meshes.fair(obj, faces, tension=2.0, remesh=True) == {"FINISHED"}
    assert (np.linalg.norm(meshes.positions(obj), axis=1) - 1.0).max() > 0.05


@pytest.mark.parametrize(
    "options",
    [
        {"continuity": "G2"}, {"continuity": "G0"}, {"shape": "LEAST_VARIATION"}, {"bulge": 0.5}, {"multigrid": True},
        {"position_group": "Loose"}, {"curvature_group": "Loose"}, {"tension_group": "Missing"}, {"falloff": 0.1},
    ],
)  # fmt: skip
def test_what_contradicts_is_refused_and_nothing_changes(options: dict[str, object]) -> None:
    obj, faces, free = cap()
    put(obj, ~free)
    before = meshes.in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match="Missing" if "tension_group" in options else "Tension"):
        meshes.fair(obj, faces, tension=2.0, **options)
    assert meshes.contents(obj) == before


def test_where_it_can_not_be_had_the_report_says_so() -> None:
    """A lone pinned vertex has no slope."""
    obj, faces, free = cap()
    top = np.zeros(len(free), dtype=bool)
    top[meshes.positions(obj)[:, 2].argmax()] = True
    put(obj, top)
    assert meshes.fair(obj, faces, tension=2.0, pin_group="Loose") == {"FINISHED"}
    assert "no slope to carry" in meshes.report().warnings


def test_it_is_shown_where_it_counts_or_is_set() -> None:
    shown = {option.name: option.shown for option in module("core.fair_options").FAIR}

    class Stand:
        pass

    for chosen, tension, group in (
        ({}, True, False), ({"tension": 2.0}, True, True), ({"continuity": "G2"}, False, False),
        ({"position_group": "A"}, False, False), ({"continuity": "G2", "tension": 2.0}, True, True),
    ):  # fmt: skip
        stand = give_options(Stand(), **chosen)
        assert (shown["tension"](stand), shown["tension_group"](stand)) == (tension, group)
